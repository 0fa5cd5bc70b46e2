#pragma once
// Thermal growth of a free ring.

namespace rotordrop {

/// Radial growth of a free annulus a < r < b whose temperature rise runs linearly from T_a to T_b:
///   u(r) = alpha r / [3 (a + b)] * [T_a (2a + b) + T_b (2b + a)]   at r = a or r = b,
/// i.e. alpha r times the volume-mean rise (generalised plane stress; free rings). Under plane strain it is (1 + nu) times that.
/// Source: Neisi 2019, eqs. (26), (27), with the lost factor 1/(a + b) restored.
/// The result is linear in the rises, so it is held as its two coefficients [m/K].
struct RingGrowth {
  double per_rise_inside;   ///< du/dT_a [m/K]
  double per_rise_outside;  ///< du/dT_b [m/K]
  [[nodiscard]] double at(double rise_inside, double rise_outside) const {
    return per_rise_inside * rise_inside + per_rise_outside * rise_outside;
  }
};

/// @param expansion   alpha [1/K]; @param a, b inner and outer radius [m], 0 < a < b
/// @param r           radius at which the growth is wanted, a or b [m]
/// @param constraint  1 for a free ring, 1 + nu for plane strain
RingGrowth ring_growth(double expansion, double a, double b, double r, double constraint = 1.);

/// Radial growth of a spinning ring a < r < b, thin along its axis, per square of its speed [m s^2]:
///   u = rho r / (4 E) [(3 + nu) other^2 + (1 - nu) r^2]   at r = a (other = b) or r = b (other = a).
/// Source: Timoshenko & Goodier, Theory of Elasticity, rotating disk with a hole (plane stress).
/// @param r  a or b [m]
double spinning_ring_growth(double youngs_modulus, double poisson_ratio, double density, double a, double b, double r);

/// By how much the bore of a ring a < r < b closes per interference with the ring b < r < c around it (by radius), same material, equal
/// width, plane stress (Lame):
///   2 a b / (b^2 - a^2) / [(b^2 + a^2)/(b^2 - a^2) + (c^2 + b^2)/(c^2 - b^2)].
double bore_closure(double a, double b, double c);

}  // namespace rotordrop
