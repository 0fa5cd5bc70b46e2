#include "laws/bearing_friction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rotordrop {

double load_torque(double load, double z, double y, double static_rating, double pitch_diameter) {
  if (!(load > 0.)) return 0. * load;  // keeps NaN
  return z * std::pow(load / static_rating, y) * load * pitch_diameter;
}

double equivalent_friction_load(double radial_load, double axial_load, double cot_contact_angle) {
  return std::max(radial_load, 0.9 * axial_load * cot_contact_angle - 0.1 * radial_load);
}

double drag_torque(double viscosity, double ring_speed, double pitch_diameter, double f2) {
  const double nu = viscosity * 1e6;                                // cSt
  const double N = std::fabs(ring_speed) * 30. / std::numbers::pi;  // rpm
  const double d_m = pitch_diameter * 1e3;                          // mm
  const double root = std::cbrt(nu * N);
  const double M_v = f2 * d_m * d_m * d_m * (nu * N > 2000. ? 1e-7 * root * root : 160e-7);  // N mm
  return M_v * 1e-3;
}

double spin_moment(double friction_coefficient, double load, double semi_major_axis, double elliptic_integral) {
  return 3. * friction_coefficient * load * semi_major_axis * elliptic_integral / 8.;
}

}  // namespace rotordrop
