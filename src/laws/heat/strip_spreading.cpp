#include "laws/heat/strip_spreading.h"

#include <cmath>
#include <numbers>

namespace rotordrop {

double strip_spreading(double width, double thickness, const std::vector<double>& middles, double half_width,
                       double conductivity, const SlabBehind& behind) {
  // Terms fall as n^-3 once l a > 1: 200 W/a of them leave some 1e-7 of the sum.
  const int n_terms = static_cast<int>(std::ceil(200. * width / half_width));
  double sum = 0.;
  for (int n = 1; n <= n_terms; ++n) {
    const double l = n * std::numbers::pi / width;
    double c = 0.;
    for (const double x : middles) c += std::cos(l * x);
    c /= static_cast<double>(middles.size());
    const double spread = c * std::sin(l * half_width) / (l * half_width);
    const double t = std::tanh(l * thickness);
    const double y =
        behind.thickness > 0. ? 1. / (conductivity * l * behind.resistance + 1. / std::tanh(l * behind.thickness)) : 0.;
    sum += spread * spread * (1. + y * t) / ((y + t) * l);
  }
  return 2. * sum / (conductivity * width);
}

}  // namespace rotordrop
