#pragma once
// Rotor surface against inner-ring bore: normal and friction law. Inlined: called once per bearing and right-hand side.
#include <array>
#include <cmath>
#include <vector>

#include "base/real.h"
#include "base/table_value.h"

namespace rotordrop {

/// F = K delta^n (1 + 1.5 lambda delta'), never negative. Source: Hunt & Crossley (1975); Neisi 2019 eq. (7), corrected.
template <class Real>
struct HuntCrossleyOf {
  Real K = 0;       ///< stiffness [N/m^n], > 0
  Real n = 1;       ///< exponent, >= 1; 10/9 for a journal in a bore
  Real lambda = 0;  ///< damping [s/m], >= 0; for small impact speed v the restitution is 1 - lambda v

  /// Elastic part K delta^n [N]; 0 without penetration.
  [[nodiscard]] Real elastic(const Real& delta) const { return elastic(delta, n); }
  /// @param exponent  n, as a number or with what its powers need
  template <class Exponent>
  [[nodiscard]] Real elastic(const Real& delta, const Exponent& exponent) const {
    return K * pow(larger(delta, Real(0.)), exponent);
  }
  /// Whole force from its elastic part [N]. A separating rotor must not be pulled back: clamp at zero.
  [[nodiscard]] Real total(const Real& elastic_force, const Real& delta_rate) const {
    // Unlike fmax, this lets a force that is not a number go on and be found.
    return larger(elastic_force * (1. + 1.5 * lambda * delta_rate), Real(0.));
  }
  /// Stored energy K delta^(n+1)/(n+1) [J].
  [[nodiscard]] Real energy(const Real& delta) const { return elastic(delta) * larger(delta, Real(0.)) / (n + 1.); }
};
using HuntCrossley = HuntCrossleyOf<double>;

/// The numbers of CoulombFriction, and its law without tables.
template <class Real>
struct CoulombNumbers {
  Real mu = 0;                    ///< dynamic friction coefficient, >= 0
  Real regularisation_speed = 1;  ///< v_reg [m/s], > 0
  Real static_mu = 0;             ///< mu_s; used with has_stribeck
  Real stribeck_speed = 1;        ///< v_s [m/s], > 0

  /// Coefficient without tables and without the passage through zero.
  [[nodiscard]] Real largest(bool has_stribeck, const Real& slip_speed_squared) const {
    if (!has_stribeck) return mu;
    return mu + (static_mu - mu) * exp(-slip_speed_squared / (stribeck_speed * stribeck_speed));
  }
  /// What a coefficient without the passage through zero is with it, over slip speed [s/m].
  [[nodiscard]] Real regularised(const Real& coefficient, const Real& slip_speed_squared) const {
    return coefficient / sqrt(slip_speed_squared + regularisation_speed * regularisation_speed);
  }
};
/// Coulomb friction, eq. (10) of Neisi 2019, regularised: mu(v) = mu v / sqrt(v^2 + v_reg^2), with an optional higher (or lower) value near
/// rest (Stribeck): mu = mu_d + (mu_s - mu_d) exp(-(v / v_s)^2); or mu from a table over slip speed. A table over temperature is a factor.
struct CoulombFriction {
  double mu = 0;                    ///< dynamic friction coefficient, >= 0
  double regularisation_speed = 1;  ///< v_reg [m/s], > 0
  double static_mu = 0;             ///< mu_s; used if has_stribeck
  double stribeck_speed = 1;        ///< v_s [m/s], > 0
  bool has_stribeck = false;
  bool has_tables = false;                                   ///< one of those below is not empty
  std::vector<std::array<double, 2>> over_speed = {};        ///< mu over slip speed [m/s]; instead of mu and static_mu
  std::vector<std::array<double, 2>> over_temperature = {};  ///< factor on mu over the ring's temperature [K]

  /// Coefficient without the passage through zero.
  /// @param temperature  of the ring [K]; needed for a table over it only
  [[nodiscard]] double largest(double slip_speed_squared, double temperature = 0.) const {
    double m = numbers().largest(has_stribeck, slip_speed_squared);
    if (has_tables) m = from_tables(m, slip_speed_squared, temperature);
    return m;
  }
  /// Coefficient over slip speed [s/m]: times a slip speed, or a vector of it, the signed coefficient.
  [[nodiscard]] double per_speed(double slip_speed_squared, double temperature = 0.) const {
    return numbers().regularised(largest(slip_speed_squared, temperature), slip_speed_squared);
  }
  /// Signed coefficient at a slip speed [m/s].
  [[nodiscard]] double coefficient(double slip_speed) const { return per_speed(slip_speed * slip_speed) * slip_speed; }

  [[nodiscard]] CoulombNumbers<double> numbers() const { return {mu, regularisation_speed, static_mu, stribeck_speed}; }
  [[nodiscard]] double from_tables(double m, double slip_speed_squared, double temperature) const {
    if (!over_speed.empty()) m = table_value(over_speed, std::sqrt(slip_speed_squared));
    if (!over_temperature.empty()) m *= table_value(over_temperature, temperature);
    return m;
  }
};

}  // namespace rotordrop
