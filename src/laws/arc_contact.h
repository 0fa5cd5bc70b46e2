#pragma once
// Rotor in a bent bore: the force K delta^n of a point of contact, spread over the arc where the surfaces overlap.
#include <array>
#include <cmath>

namespace rotordrop {

/// Elastic force per angle [N/rad] over the local overlap delta of rotor and bore,
///   f = delta^(n - 1/2) (f_0 + f_1 delta + f_2 delta^2 + f_3 delta^3),
/// such that a circular journal in a circular bore with the radial gap c, delta(theta) = e cos theta - c, feels K (e - c)^n:
/// the integral of w = int f d(delta) over the arc, 2 int w(delta_0 - y) dy / sqrt(y (2 e - y)), is K delta_0^(n+1) / (n + 1), order by order
/// in delta_0 / c. Four orders leave 3e-5 of the force at delta_0 = c / 8.
/// Valid:  gaps near c (the force at a given delta_0 goes with the square root of c over the gap: a closer bore is wider contact), overlaps below c / 2.
class ArcContact {
 public:
  static constexpr int n_orders = 4;
  ArcContact() = default;
  /// @param K, n  of the point law [N/m^n]
  /// @param gap   c [m], > 0
  ArcContact(double K, double n, double gap);

  [[nodiscard]] double exponent() const { return exponent_; }
  [[nodiscard]] const std::array<double, n_orders>& factors() const { return factor_; }
  /// f [N/rad]; 0 without overlap.
  [[nodiscard]] double force(double delta) const {
    return delta > 0. ? std::pow(delta, exponent_) * polynomial(delta) : 0.;
  }
  /// df/d(delta) [N/(m rad)]; 0 without overlap.
  [[nodiscard]] double stiffness(double delta) const;
  /// Factors w_k of w = delta^(exponent + 1) (w_0 + w_1 delta + w_2 delta^2 + w_3 delta^3).
  [[nodiscard]] std::array<double, n_orders> energy_factors() const {
    std::array<double, n_orders> w{};
    for (std::size_t k = 0; k < w.size(); ++k) w[k] = factor_[k] / (exponent_ + static_cast<double>(k) + 1.);
    return w;
  }
  /// w [J/rad]
  [[nodiscard]] double energy(double delta) const;

 private:
  [[nodiscard]] double polynomial(double delta) const {
    return factor_[0] + delta * (factor_[1] + delta * (factor_[2] + delta * factor_[3]));
  }
  double exponent_ = 0.5;
  std::array<double, n_orders> factor_{};
};

}  // namespace rotordrop
