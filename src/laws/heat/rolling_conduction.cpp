#include "laws/heat/rolling_conduction.h"

#include <algorithm>
#include <boost/math/special_functions/ellint_1.hpp>
#include <cmath>
#include <numbers>

namespace rotordrop {
namespace {

using std::numbers::pi;

// 2 sqrt(2/pi) times the integral of (1 - s^2)^(1/4) from -1 to 1, sqrt(pi) Gamma(5/4) / Gamma(7/4).
const double rolling_factor = 2. * std::sqrt(2. / pi) * std::sqrt(pi) * std::tgamma(1.25) / std::tgamma(1.75);

}  // namespace

SpotConduction spot_conduction(const ConductingBody& body, double axis_factor, double ellipticity) {
  const double modulus = std::sqrt(std::max(1. - 1. / (ellipticity * ellipticity), 0.));
  const double per_axis = rolling_factor * axis_factor;
  return {2. * pi * body.conductivity * axis_factor / boost::math::ellint_1(modulus),
          per_axis * per_axis * body.conductivity * body.volumetric_capacity * axis_factor / ellipticity};
}

ContactConduction contact_conduction(const ConductingBody& race, const ConductingBody& ball, double axis_factor,
                                     double ellipticity, double film_thickness, double film_conductivity) {
  const double area = pi * axis_factor * axis_factor / ellipticity;
  return {spot_conduction(race, axis_factor, ellipticity), spot_conduction(ball, axis_factor, ellipticity),
          film_thickness > 0. ? film_conductivity * area / film_thickness : 0.};
}

double repeating_track_conductance(double conductivity, double ball_radius, double half_width) {
  return 2. * pi * pi * conductivity * ball_radius / (std::log(ball_radius / half_width) + 0.43);
}

double wandering_track_conductance(double conductivity, double ball_radius) {
  return 20. * pi * conductivity * ball_radius;
}

}  // namespace rotordrop
