#pragma once
// Hertz point contact of ball and raceway.

namespace rotordrop {

struct ElasticMaterial {
  double youngs_modulus;  ///< E [Pa], > 0
  double poisson_ratio;   ///< nu [-]
};

/// E' = 2 / [(1 - nu1^2)/E1 + (1 - nu2^2)/E2] [Pa] (Hamrock & Dowson 1981).
double effective_modulus(const ElasticMaterial& first, const ElasticMaterial& second);

/// A ball in a race: curvature radii [m] in the rolling direction (x) and across the groove (y).
struct ContactGeometry {
  double R_x;  ///< 1/R_x = 2/d -+ 1/r_race, + for the inner race
  double R_y;  ///< 1/R_y = 2/d - 1/(f d)
};

/// @param ball_diameter  d [m]
/// @param race_radius    radius of the race [m]: d_m/2 - (d/2) cos phi_0 inside, d_m/2 + (d/2) cos phi_0 outside
/// @param conformity     f = groove radius / ball diameter, > 0.5
ContactGeometry inner_race_contact(double ball_diameter, double race_radius, double conformity);
ContactGeometry outer_race_contact(double ball_diameter, double race_radius, double conformity);

/// How the elliptic integrals of a contact are found.
enum class EllipticIntegrals {
  brewe_hamrock,  ///< fits: k = 1.0339 (Ry/Rx)^0.636, E = 1.0003 + 0.5968 Rx/Ry, F = 1.5277 + 0.6023 ln(Ry/Rx)
  exact           ///< complete elliptic integrals, ellipticity from the curvature difference
};

struct ContactEllipse {
  double k;  ///< ellipticity, semi-major over semi-minor axis, >= 1
  double E;  ///< complete elliptic integral of the second kind of sqrt(1 - 1/k^2)
  double F;  ///< complete elliptic integral of the first kind
};
/// Valid for R_y >= R_x (every ball in a groove).
ContactEllipse contact_ellipse(const ContactGeometry& geometry, EllipticIntegrals method);

/// Load-deflection constant K of Q = K delta^(3/2) [N/m^1.5]: K = pi k E' sqrt(2 E R / (9 F^3)), 1/R = 1/R_x + 1/R_y.
/// Source: Brewe & Hamrock (1977); Hamrock & Dowson (1981).
double hertz_stiffness(const ContactGeometry& geometry, double effective_modulus, EllipticIntegrals method);

/// Semi-major axis a [m] of the contact ellipse at load Q is this times Q^(1/3): a = (6 k^2 E R Q / (pi E'))^(1/3),
/// half of Hamrock & Dowson's diameter.
double semi_major_axis_factor(const ContactGeometry& geometry, double effective_modulus, EllipticIntegrals method);

/// Half width b [m] of the contact of two parallel cylinders: b = sqrt(8 w R / (pi E')), w [N/m], 1/R = 1/r_1 +- 1/r_2, - for a shaft in a bore.
/// Source: Johnson, Contact Mechanics (1985), eq. (4.43). Valid: b far below both radii, long cylinders.
double line_contact_half_width(double load_per_length, double combined_radius, double effective_modulus);

/// Inner and outer contact in series: (K_i^(-2/3) + K_o^(-2/3))^(-3/2).
double stiffness_in_series(double inner, double outer);

}  // namespace rotordrop
