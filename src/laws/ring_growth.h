#pragma once
// Thermal growth of a free ring.

namespace rotordrop {

/// Growth of a length r of a free annulus a < r < b whose temperature rise runs linearly from T_a to T_b:
///   u(r) = alpha r / [3 (a + b)] * [T_a (2a + b) + T_b (2b + a)],
/// i.e. alpha r times the volume-mean rise: exact for the radii r = a and r = b and for a width (generalised plane stress; free rings),
/// the mean growth for radii between. Under plane strain it is (1 + nu) times that.
/// Source: Neisi 2019, eqs. (26) and (27), with the lost factor 1/(a + b) restored.
/// The result is linear in the rises, so it is held as its two coefficients [m/K].
struct RingGrowth {
  double per_rise_inside;   ///< du/dT_a [m/K]
  double per_rise_outside;  ///< du/dT_b [m/K]
  [[nodiscard]] double at(double rise_inside, double rise_outside) const {
    return per_rise_inside * rise_inside + per_rise_outside * rise_outside;
  }
};

/// @param expansion   alpha [1/K]; @param a, b inner and outer radius [m], 0 < a < b
/// @param r           radius or width whose growth is wanted [m]
/// @param constraint  1 for a free ring, 1 + nu for plane strain
RingGrowth ring_growth(double expansion, double a, double b, double r, double constraint = 1.);

/// Radial growth of a spinning ring at a <= r <= b, thin along its axis, per square of its speed [m s^2]:
///   u = rho r / (8 E) {(3 + nu) [(1 - nu) (a^2 + b^2) + (1 + nu) a^2 b^2 / r^2] - (1 - nu^2) r^2}.
/// Source: Timoshenko & Goodier, Theory of Elasticity, rotating disk with a hole (plane stress).
double spinning_ring_growth(double youngs_modulus, double poisson_ratio, double density, double a, double b, double r);

/// Mean axial strain of that ring per square of its speed [s^2]: it becomes narrower, as Poisson's ratio has it.
///   eps_x = -nu / E mean(sigma_r + sigma_theta) = -nu rho (a^2 + b^2) / (2 E)
double spinning_ring_strain(double youngs_modulus, double poisson_ratio, double density, double a, double b);

/// By how much the bore of a ring a < r < b closes per interference with the ring b < r < c around it (by radius), same material, equal
/// width, plane stress (Lame):
///   2 a b / (b^2 - a^2) / [(b^2 + a^2)/(b^2 - a^2) + (c^2 + b^2)/(c^2 - b^2)].
double bore_closure(double a, double b, double c);

}  // namespace rotordrop
