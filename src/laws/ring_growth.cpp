#include "laws/ring_growth.h"

namespace rotordrop {

RingGrowth ring_growth(double expansion, double a, double b, double r, double constraint) {
  const double factor = constraint * expansion * r / (3. * (a + b));
  return {factor * (2. * a + b), factor * (2. * b + a)};
}

double spinning_ring_growth(double E, double nu, double rho, double a, double b, double r) {
  const double other = r == a ? b : a;
  return rho * r / (4. * E) * ((3. + nu) * other * other + (1. - nu) * r * r);
}

double bore_closure(double a, double b, double c) {
  const auto slimness = [](double inside, double outside) {
    return (outside * outside + inside * inside) / (outside * outside - inside * inside);
  };
  return 2. * a * b / (b * b - a * a) / (slimness(a, b) + slimness(b, c));
}

}  // namespace rotordrop
