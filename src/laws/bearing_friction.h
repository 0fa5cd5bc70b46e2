#pragma once
// Friction torque inside the ball bearing (Palmgren).
#include <numbers>

#include "base/real.h"

namespace rotordrop {

/// The two loads in the friction torque of one row.
template <class Real>
struct FrictionLoadsOf {
  Real torque = 0;             ///< P1, multiplied by f1 d_m [N]
  Real static_equivalent = 0;  ///< P0, in f1 = z (P0/C0)^y [N]
};
using FrictionLoads = FrictionLoadsOf<double>;

/// Factors of a row's radial and axial load in P0 and P1.
template <class Real>
struct FrictionLoadFactorsOf {
  Real static_radial = 0.6;  ///< X0 in P0 = max(F_r, X0 F_r + Y0 F_a)
  Real static_axial = 0.5;   ///< Y0
  Real torque_axial = 3.;    ///< in P1 = max(F_r, this F_a - 0.1 F_r)

  /// @param radial_load, axial_load  of one row, preload included [N], >= 0
  [[nodiscard]] FrictionLoadsOf<Real> loads(const Real& radial_load, const Real& axial_load) const {
    return {larger(radial_load, torque_axial * axial_load - 0.1 * radial_load),
            larger(radial_load, static_radial * radial_load + static_axial * axial_load)};
  }
};
using FrictionLoadFactors = FrictionLoadFactorsOf<double>;

/// Factors of one row. Deep groove (angle 0): X0 = 0.6, Y0 = 0.5 and P1 = max(F_r, 3 F_a - 0.1 F_r). Angular contact: X0 = 0.5, Y0 by the
/// table over the contact angle, straight lines between, and P1 = max(F_r, 0.9 F_a cot phi - 0.1 F_r).
/// Source: ISO 76:2006, table 2 (X0, Y0, single row); Harris & Kotzalas, Essential Concepts of Bearing Technology (P1), after Palmgren.
/// Valid:  contact angles 5 to 45 deg. An angle between 0 and 5 deg counts as 5 deg; beyond 45 deg Y0 stays that of 45 deg.
/// @param contact_angle  nominal [rad], >= 0
FrictionLoadFactors friction_load_factors(double contact_angle);

/// Load-dependent friction torque M_L = f1 P1 d_m with f1 = z (P0/C0)^y [N m].
/// Source: Neisi, Heikkinen & Sopanen (2019), eq. (21), after Palmgren.
/// @param loads           P1 and P0 [N], >= 0
/// @param static_rating   C0 of what carries the load [N], > 0
/// @param y               as a number or with what its powers need
/// @param pitch_diameter  d_m [m]
template <class Real, class Exponent>
Real load_torque(const FrictionLoadsOf<Real>& loads, const Real& z, const Exponent& y, const Real& static_rating,
                 const Real& pitch_diameter) {
  return z * pow(loads.static_equivalent / static_rating, y) * loads.torque * pitch_diameter;
}

/// Friction torque of an unloaded ball bearing from lubricant or air drag [N m], >= 0.
///
///   M_v = 1e-7 f2 (nu N)^(2/3) d_m^3   for nu N > 2000
///   M_v = 160e-7 f2 d_m^3              otherwise
///
/// with nu [cSt], N [rpm], d_m [mm], M_v [N mm]: the formula is empirical and unit-bound, so we convert here and only here.
/// Source: Neisi, Heikkinen & Sopanen (2019), eq. (22), after Palmgren.
/// Valid:  moderate speed, oil near 0.9 specific gravity. In dry touchdown bearings it is an order of magnitude only.
///
/// @param viscosity       kinematic viscosity [m^2/s], > 0
/// @param ring_speed      inner-ring speed [rad/s], any sign
/// @param pitch_diameter  [m], > 0
template <class Real>
Real drag_torque(const Real& viscosity, const Real& ring_speed, const Real& pitch_diameter, const Real& f2) {
  const Real nu = viscosity * 1e6;                          // cSt
  const Real N = abs(ring_speed) * 30. / std::numbers::pi;  // rpm
  const Real d_m = pitch_diameter * 1e3;                    // mm
  const Real root = cbrt(nu * N);
  const Real M_v = f2 * d_m * d_m * d_m * select(nu * N > 2000., 1e-7 * root * root, Real(160e-7));  // N mm
  return M_v * 1e-3;
}

/// Spin moment of one ball in one race, M_s = 3 mu F a E / 8 [N m].
/// Source: Neisi 2019, eq. (23), after Poritsky et al. (1947).
/// @param load             F [N]; @param semi_major_axis a [m]; @param elliptic_integral E, second kind
template <class Real>
Real spin_moment(const Real& friction_coefficient, const Real& load, const Real& semi_major_axis,
                 const Real& elliptic_integral) {
  return 3. * friction_coefficient * load * semi_major_axis * elliptic_integral / 8.;
}

}  // namespace rotordrop
