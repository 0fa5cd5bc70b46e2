#include "laws/bearing_growth.h"

#include <cmath>

namespace rotordrop {

RaceSurfaces contact_point_surfaces(double d, double d_m, double phi, double width) {
  const double projected = 0.5 * d * std::cos(phi);
  return {0.5 * d_m - projected, 0.5 * d_m + projected, width};
}

GrowthPerRise growth_per_rise(const GrowthDimensions& d, double constraint) {
  // Per mean rise: eqs. (26) and (27) of Neisi 2019 take the mean of a ring, eq. (25) is the ball's.
  const double alpha = constraint * d.ring_expansion;
  return {.bore = alpha * d.bore_radius,
          .inner_race = alpha * d.races.inner,
          .outer_race = alpha * d.races.outer,
          .shaft = d.shaft_expansion * d.shaft_radius,
          .ball = d.ball_expansion * d.ball_radius,
          .inner_width = alpha * d.races.width,
          .outer_width = alpha * d.races.width,
          .is_housed = d.is_housed};
}

}  // namespace rotordrop
