#include "laws/heat/heat_flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rotordrop {

double housing_convection(double rise) { return rise > 0. ? 23. * std::sqrt(std::sqrt(rise)) : 0.; }

double elliptic_constriction(double a, double first_kind, double k_1, double k_2) {
  return first_kind / (2. * std::numbers::pi * a) * (1. / k_1 + 1. / k_2);
}

double JaegerShare::to_ring(double rotor_surface_speed, double ring_surface_speed) const {
  const double slowest = band_length / contact_duration;  // a surface at rest is heated for the contact's duration
  const double v_rotor = std::max(std::fabs(rotor_surface_speed), slowest);
  const double v_ring = std::max(std::fabs(ring_surface_speed), slowest);
  return 1. / (1. + effusivity_ratio * std::sqrt(v_rotor / v_ring));
}

}  // namespace rotordrop
