#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/aligned_numbers.h"
#include "base/wide_vectors.h"
#include "integrate/embedded_tableau.h"
#include "integrate/integration_parameters.h"
#include "model/oscillator.h"

namespace rotordrop {

/// All that are underdamped if one of them is above integration.exponential_above and the method is one that integrates them by exponentials; else none.
[[nodiscard]] std::vector<Oscillator> fast_oscillators(std::vector<Oscillator> all,
                                                       const IntegrationParameters& parameters);

/// Stages of an explicit method for oscillators that are too fast for its steps: their free motion by exponentials, exactly, and of the method's stages
/// what else acts on them. Their frequencies then bound no step.
///
/// With w = v - conj(lambda) q, lambda = -c/2 + i omega_d, an oscillator is one complex number, w' = lambda w + N. A stage at c_i of a step h is
///   w_i = exp(c_i z) w + h sum_j W_ij N_j,  z = lambda h,
/// whose weights integrate exactly
///   sum_j W_ij p(c_j) = integral_0^c_i exp((c_i - s) z) p(s) ds
/// for all polynomials p of as many coefficients as EmbeddedTableau::fitted has rates j; rates besides those count a_ij exp((c_i - c_j) z). For z = 0 these
/// are the method's own weights, since no stage has more fitted rates than its order gives exactly.
/// Source: exponential Runge-Kutta methods, Hochbruck & Ostermann, Acta Numerica 19 (2010) 209-286, sections 2.3 and 2.5.
class ExponentialStages {
 public:
  /// @param method       fitted to each step (fit_to_step()) before begin(); must outlive this
  /// @param oscillators  those that are fast (fast_oscillators())
  /// @param scale        of all states [n_states]
  ExponentialStages(const EmbeddedTableau& method, std::vector<Oscillator> oscillators, std::span<const double> scale);

  [[nodiscard]] bool empty() const { return kinds_.omega.empty(); }
  /// How many states the oscillators are.
  [[nodiscard]] std::size_t n_states() const;

  /// States and rates at the starts of a step and of the one before it.
  struct Start {
    std::span<const double> state, rates, state_before, rates_before;
  };
  /// Before the stages of a step.
  /// @param step, before  [s]; before = 0: there is none
  void begin(double step, double before, const Start& start);
  /// Whether an oscillator turns by more than half a radian in the step, where rounding in its weights is small; else all are left to the method.
  [[nodiscard]] bool is_active() const { return first_active_ < n_kinds_; }
  /// Writes oscillators that are too fast into a stage's state.
  void place(int stage, std::span<double> y);
  /// Takes what else acts on them at the stage that was placed last, from its rates [n_states].
  void take(int stage, std::span<const double> rates);
  /// Sum of the squares of their errors over what is allowed, by the method's error weights, less where an oscillator turns in a step.
  [[nodiscard]] double squared_error(double tolerance) const;
  /// Makes the scales of those that are too fast infinite in a list by which the method controls its own errors, and restores those of the others.
  void hide(std::span<double> scale) const;
  /// Writes their states within the last step, at a part theta of it.
  void interpolate(double theta, std::span<double> y) const;

 private:
  struct Kernels;
  struct Complexes {
    AlignedNumbers re, im;
    explicit Complexes(std::size_t n = 0) : re(n), im(n) {}
  };
  /// Oscillators of one frequency and damping, slowest first, filled up to whole vectors.
  struct Kinds {
    AlignedNumbers omega, omega_squared, damping_rate;  // [n_kinds]
    AlignedNumbers half_damping, omega_damped, inverse_omega_damped;
  };
  /// Oscillators that follow each other in the state vector as in a plane.
  struct Run {
    std::size_t coordinate, velocity;  // of the first, in the state vector
    std::size_t at, size;              // of the first, among the kinds
  };
  /// One oscillator of each kind that has so many.
  struct Plane {
    std::vector<Run> runs;
    AlignedNumbers coordinate_scale, velocity_scale;
    AlignedNumbers coordinate, velocity;  // of the stage that was placed last
    Complexes start;                      // w at the step's start
    std::vector<AlignedNumbers> rest;     // [stage] N
  };
  /// How a stage's weights are found.
  struct Fit {
    double node = 0;
    std::size_t n_fitted = 0, n_others = 0;
    std::array<std::size_t, most_stages> fitted{}, others{};
    std::array<double, most_stages> other_weight{}, other_node{};
    std::array<std::array<double, most_stages>, most_stages>
        polynomial{};  // [fitted][power] which is 1 at one of them and 0 at the others
  };
  /// z of a step, 1 / z, and room for integrals of powers times exponentials.
  struct Exponents {
    Complexes z, inverse;
    std::vector<Complexes> integrals;  // [power]
  };
  struct Weights {
    Complexes exponential;
    std::vector<Complexes> of_rate;  // [stage]
  };
  [[nodiscard]] Fit fit_of(int stage, double node, std::span<const double> own_weights) const;
  template <class Do>
  static void for_runs(const Plane& plane, std::size_t from, Do&& what);
  void gather(Plane& plane, std::span<const double> state) const;
  void take(Plane& plane, int stage, std::span<const double> rates) const;
  void combine(const Plane& plane, const Weights& weights, const Fit& fit, double* coordinate, double* velocity) const;
  void write(const Plane& plane, const double* coordinate, const double* velocity, std::span<double> y) const;

  Kinds kinds_;
  std::vector<Plane> planes_;
  const EmbeddedTableau& method_;
  double step_ = 0, ratio_ = 0;
  std::size_t n_kinds_ = 0;
  std::size_t first_active_ = 0, first_vector_ = 0;  // from it on kinds are active; the vector in which it is
  std::array<Fit, most_stages> fits_{};
  std::vector<Weights> weights_;  // [stage]
  mutable Exponents exponents_;
  mutable Weights within_;                                      // of interpolate()
  mutable AlignedNumbers within_coordinate_, within_velocity_;  // of one plane
};

}  // namespace rotordrop
