#include "laws/fatigue/rating_estimates.h"

#include <cmath>

namespace rotordrop {

RatingEstimates estimated_ratings(int rows, int balls_per_row, double ball_diameter, double contact_angle) {
  constexpr double f0 = 15., f_c = 55.;
  const double i = rows, Z = balls_per_row, D = ball_diameter * 1e3, cosine = std::cos(contact_angle);
  const double size = D <= 25.4 ? std::pow(D, 1.8) : 3.647 * std::pow(D, 1.4);
  return {f0 * i * Z * D * D * cosine, 1.3 * f_c * std::pow(i * cosine, 0.7) * std::pow(Z, 2. / 3.) * size};
}

}  // namespace rotordrop
