#include "laws/windage.h"

#include <algorithm>
#include <cmath>

namespace rotordrop {

double free_cylinder_coefficient(double reynolds) {
  const double laminar = 4. / reynolds;
  if (reynolds < 50.) return laminar;
  // x = 1/sqrt(C) = -0.6 + 4.07 log10(Re / x): Newton's method; the function is monotonic in x.
  const double per_log = 4.07 / std::log(10.);
  double x = 0.5 * per_log * std::log(reynolds);
  for (int i = 0; i < 50; ++i) {
    const double step = (x + 0.6 - per_log * std::log(reynolds / x)) / (1. + per_log / x);
    x -= step;
    if (std::fabs(step) < 1e-14 * x) break;
  }
  return std::max(laminar, 1. / (x * x));
}

double enclosed_cylinder_coefficient(double reynolds, double gap_over_radius) {
  const double by_gap = std::pow(gap_over_radius, 0.3);
  if (reynolds < 64.) return 5. * by_gap / reynolds;
  if (reynolds < 500.) return by_gap / std::pow(reynolds, 0.6);
  if (reynolds < 1e4) return 0.515 * by_gap / std::sqrt(reynolds);
  return 0.0325 * by_gap / std::pow(reynolds, 0.2);
}

double disc_face_coefficient(double reynolds) {
  return reynolds < 3e5 ? 1.935 / std::sqrt(reynolds) : 0.073 / std::pow(reynolds, 0.2);
}

}  // namespace rotordrop
