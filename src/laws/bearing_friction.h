#pragma once
// Friction torque inside the ball bearing (Palmgren).

namespace rotordrop {

/// Load-dependent friction torque M_L = f1 P d_m with f1 = z (P0/C0)^y [N m].
/// Source: Neisi, Heikkinen & Sopanen (2019), eq. (21), after Palmgren. Here P = P0.
/// @param load            P [N], >= 0
/// @param static_rating   C0 of all rows together [N], > 0
/// @param pitch_diameter  d_m [m]
double load_torque(double load, double z, double y, double static_rating, double pitch_diameter);

/// Equivalent load of one row for the friction torque: max(F_r, 0.9 F_a cot phi - 0.1 F_r) [N], F_a with preload.
double equivalent_friction_load(double radial_load, double axial_load, double cot_contact_angle);

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
double drag_torque(double viscosity, double ring_speed, double pitch_diameter, double f2);

/// Spin moment of one ball in one race, M_s = 3 mu F a E / 8 [N m].
/// Source: Neisi 2019, eq. (23), after Poritsky et al. (1947).
/// @param load             F [N]; @param semi_major_axis a [m]; @param elliptic_integral E, second kind
double spin_moment(double friction_coefficient, double load, double semi_major_axis, double elliptic_integral);

}  // namespace rotordrop
