#include "laws/ring_growth.h"

namespace rotordrop {

RingGrowth ring_growth(double expansion, double a, double b, double r, double constraint) {
  const double factor = constraint * expansion * r / (3. * (a + b));
  return {factor * (2. * a + b), factor * (2. * b + a)};
}

double spinning_ring_growth(double E, double nu, double rho, double a, double b, double r) {
  const double a2 = a * a, b2 = b * b, r2 = r * r;
  return rho * r / (8. * E) * ((3. + nu) * ((1. - nu) * (a2 + b2) + (1. + nu) * a2 * b2 / r2) - (1. - nu * nu) * r2);
}

double spinning_ring_strain(double E, double nu, double rho, double a, double b) {
  return -nu * rho * (a * a + b * b) / (2. * E);
}

double bore_closure(double a, double b, double c) {
  const auto slimness = [](double inside, double outside) {
    return (outside * outside + inside * inside) / (outside * outside - inside * inside);
  };
  return 2. * a * b / (b * b - a * a) / (slimness(a, b) + slimness(b, c));
}

}  // namespace rotordrop
