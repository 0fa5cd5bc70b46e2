#pragma once
// Explicit embedded Runge-Kutta methods as numbers.
#include <array>
#include <cstddef>

namespace rotordrop {

inline constexpr int most_stages = 7, most_powers = 4;

/// y_i = y + h sum_j a_ij k_j, k_i = f(t + c_i h, y_i); the last stage is the new state. Error: h sum_i e_i k_i.
/// Interpolant: y + h sum_i k_i sum_p polynomial_ip theta^p, p = 1, 2, ...
struct EmbeddedTableau {
  int n_stages, order, powers;
  std::array<double, most_stages> c;
  std::array<std::array<double, most_stages>, most_stages> a;
  std::array<double, most_stages> e;
  std::array<std::array<double, most_powers>, most_stages> polynomial{};
  int start = 0;  ///< the stage at the step's start; one before it is the same of the step before
  /// Of the step's control; Hairer, Norsett & Wanner have 0.04 to 0.08, Gustafsson 0.4 over the order. With 0.06 hardly any step of a rotor with all
  /// its modes is rejected, whose steps stability bounds; with 0.04 every seventh was. 0.08 costs the pair of order five 8 % more right-hand sides of the
  /// reference drop; the two-step method rejects every eighth step of it with 0.06 and every nineteenth with 0.1, for the same errors and cost.
  double control_beta = 0.06;

  /// What a stage's rate counts in the interpolant at a part of the step.
  [[nodiscard]] double weight(std::size_t stage, double theta) const {
    double value = 0.;
    for (int p = powers; p-- > 0;) value = theta * (value + polynomial[stage][static_cast<std::size_t>(p)]);
    return value;
  }
};

/// Whether its steps see the rate at the start of the one before.
constexpr bool sees_past(const EmbeddedTableau& method) { return method.start > 0; }

/// The interpolant that has the states and rates of the step's ends: Hermite's cubic.
constexpr void interpolate_by_hermite(EmbeddedTableau& method) {
  const auto n = static_cast<std::size_t>(method.n_stages);
  for (std::size_t i = 0; i < n; ++i) {
    const double weight = method.a[n - 1][i], first = i == static_cast<std::size_t>(method.start) ? 1. : 0.,
                 last = i == n - 1 ? 1. : 0.;
    method.polynomial[i] = {first, 3. * weight - 2. * first - last, first + last - 2. * weight};
  }
}

}  // namespace rotordrop
