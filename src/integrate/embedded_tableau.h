#pragma once
// Explicit embedded Runge-Kutta methods as numbers.
#include <array>
#include <cstddef>

namespace rotordrop {

inline constexpr int most_stages = 7, most_powers = 4;

/// y_i = y + h sum_j a_ij k_j, k_i = f(t + c_i h, y_i); the last stage is the new state. Error: h sum_i e_i k_i.
/// Interpolant: y + h sum_i k_i sum_p polynomial_ip theta^p, p = 1 ... powers; without powers the cubic that has the states and rates of the step's ends
/// (Hermite's).
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
  /// Of each stage: rates (bit j) whose weights are fitted to exact integrals where oscillators are integrated by exponentials (ExponentialStages).
  std::array<unsigned, most_stages> fitted{};

  /// What a stage's rate counts in the interpolant at a part of the step.
  [[nodiscard]] double weight(std::size_t stage, double theta) const {
    const auto last = static_cast<std::size_t>(n_stages) - 1;
    double value = 0.;
    if (powers == 0) {
      value = theta * theta * (3. - 2. * theta) * a[last][stage];
      if (stage == static_cast<std::size_t>(start)) value += theta * (1. - theta) * (1. - theta);
      if (stage == last) value -= theta * theta * (1. - theta);
      return value;
    }
    for (int p = powers; p-- > 0;) value = theta * (value + polynomial[stage][static_cast<std::size_t>(p)]);
    return value;
  }
};

/// Whether its steps see the rate at the start of the one before.
constexpr bool sees_past(const EmbeddedTableau& method) { return method.start > 0; }

}  // namespace rotordrop
