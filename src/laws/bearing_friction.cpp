#include "laws/bearing_friction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace rotordrop {

FrictionLoads FrictionLoadFactors::loads(double radial_load, double axial_load) const {
  return {std::max(radial_load, torque_axial * axial_load - 0.1 * radial_load),
          std::max(radial_load, static_radial * radial_load + static_axial * axial_load)};
}

FrictionLoadFactors friction_load_factors(double contact_angle) {
  if (contact_angle == 0.) return {};
  constexpr std::array<double, 9> Y_0 = {0.52, 0.50, 0.46, 0.42, 0.38, 0.33, 0.29, 0.26, 0.22};  // 5, 10 ... 45 deg
  constexpr double spacing = 5. * std::numbers::pi / 180.;
  const double phi = std::max(contact_angle, spacing);
  const double at = std::min(phi / spacing - 1., static_cast<double>(Y_0.size() - 1));
  const auto below = std::min(static_cast<std::size_t>(at), Y_0.size() - 2);
  const double part = at - static_cast<double>(below);
  return {0.5, Y_0[below] + part * (Y_0[below + 1] - Y_0[below]), 0.9 / std::tan(phi)};
}

double load_torque(const FrictionLoads& loads, double z, double y, double static_rating, double pitch_diameter) {
  if (!(loads.torque > 0.)) return 0. * loads.torque;  // keeps NaN
  const double ratio = loads.static_equivalent / static_rating;
  // Deep-groove bearings have the exponent 0.5 or 0.55.
  return z * (y == 0.5 ? std::sqrt(ratio) : std::pow(ratio, y)) * loads.torque * pitch_diameter;
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
