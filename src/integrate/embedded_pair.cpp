// Explicit embedded Runge-Kutta methods of our own: first same as last, quadratures outside the stages and the error control, free interpolant,
// and a last stage that the caller may evaluate together with whatever else it wants to know of the step's end.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/aligned_numbers.h"
#include "base/errors.h"
#include "base/wide_vectors.h"
#include "integrate/exponential_stages.h"
#include "integrate/failures.h"
#include "integrate/integrator.h"
#include "integrate/methods.h"
#include "integrate/pairs.h"
#include "model/instants.h"

namespace rotordrop {
namespace {

template <class List>
auto& at(List& list, int i) {
  return list[static_cast<std::size_t>(i)];
}

/// out = y + sum_j factor_j k_j on the entries [from, to), of as many k as this was compiled for.
template <int n>
ROTORDROP_KERNEL void combine_all(std::size_t from, std::size_t to, const double* y, const double* factors,
                                  const double* const* list, double* out) {
  const double* k[n];
  double factor[n];
  std::copy_n(list, n, k);
  std::copy_n(factors, n, factor);
#pragma omp simd
  for (std::size_t i = from; i < to; ++i) {
    double sum = y[i];
#pragma GCC unroll 8
    for (int j = 0; j < n; ++j) sum += factor[j] * k[j][i];
    out[i] = sum;
  }
}

/// The same for `count` of them, from one to most_stages.
template <int n = 1>
ROTORDROP_KERNEL void combine(std::size_t from, std::size_t to, const double* y, const double* factor,
                              const double* const* k, int count, double* out) {
  if constexpr (n < most_stages)
    if (count > n) return combine<n + 1>(from, to, y, factor, k, count, out);
  combine_all<n>(from, to, y, factor, k, out);
}

/// What the error of a step is measured by.
struct StepEnds {
  std::size_t n_controlled, n;
  const double *before, *after, *rates;  // [n]
  const double* scale;                   // [n_controlled]
  double tolerance;
};
/// Sum of (error / (tolerance (scale + largest magnitude of both states)))^2, with the error sum_j factor_j k_j; not a number if a new state or a rate is
/// not finite.
template <int n>
ROTORDROP_KERNEL double squared_error_of_all(const StepEnds& ends, const double* factors, const double* const* list) {
  const double *before = ends.before, *after = ends.after, *rates = ends.rates, *scale = ends.scale;
  const double tolerance = ends.tolerance;
  const double* k[n];
  double factor[n];
  std::copy_n(list, n, k);
  std::copy_n(factors, n, factor);
  double sum = 0.;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < ends.n_controlled; ++i) {
    double error = 0.;
#pragma GCC unroll 8
    for (int j = 0; j < n; ++j) error += factor[j] * k[j][i];
    const double a = std::fabs(before[i]), b = std::fabs(after[i]);
    const double part = error / (tolerance * (scale[i] + (a > b ? a : b)));
    sum += part * part;
  }
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < ends.n; ++i) sum += (after[i] - after[i]) + (rates[i] - rates[i]);
  return sum;
}
template <int n = 1>
ROTORDROP_KERNEL double squared_error(const StepEnds& ends, const double* factor, const double* const* k, int count) {
  if constexpr (n < most_stages)
    if (count > n) return squared_error<n + 1>(ends, factor, k, count);
  return squared_error_of_all<n>(ends, factor, k);
}

AlignedNumbers scales_of(const OdeSystem& system) {
  AlignedNumbers scales;
  for (const auto& entry : system.layout().entries()) scales.push_back(entry.scale);
  return scales;
}

class EmbeddedPair final : public Integrator {
 public:
  EmbeddedPair(const EmbeddedTableau& method, const OdeSystem& system, const IntegrationParameters& parameters,
               double start_time, std::span<const double> state, double end_time)
      : method_(method),
        system_(system),
        n_(system.layout().size()),
        n_controlled_(system.first_quadrature()),
        tolerance_(parameters.tolerance),
        longest_(step_or_bound(parameters)),
        time_(start_time),
        instants_(system.instants(), end_time),
        control_(method, tolerance_, longest_),
        y_(state.begin(), state.end()),
        before_(y_),
        stage_(y_),
        scale_(scales_of(system)),
        own_scale_(scale_),
        exponentials_(method_, fast_oscillators(system.oscillators(), parameters), scale_),
        n_weighed_(std::max<std::size_t>(n_controlled_ - exponentials_.n_states(), 1)) {
    for (int i = 0; i < method_.n_stages; ++i) k_.emplace_back(n_);
  }

  [[nodiscard]] double time() const override { return time_; }
  [[nodiscard]] std::span<const double> state() const override { return y_; }

  void advance() override {
    if (is_cut_) begin_anew();
    if (!has_rates_) {
      evaluate(time_, y_, at_start());
      if (!all_finite(at_start())) throw_rates_not_finite(system_.layout(), at_start(), time_, next_step_);
      has_rates_ = true;
    } else if (last_step_ > 0.) {
      if (sees_past(method_)) std::swap(k_.front(), at_start());
      std::swap(at_start(), k_.back());  // first same as last
    }
    if (next_step_ == 0.) next_step_ = first_step();
    double step = next_step_;
    bool was_rejected = false;
    for (;;) {
      const Trial trial = control_.trial(step, time_, instants_.next(time_));
      step = trial.size;
      const double size = try_step(step, trial.target);
      if (size <= 1.) {
        accept(trial, size, was_rejected);
        return;
      }
      was_rejected = true;
      ++statistics_.rejected_steps;
      const double factor = control_.after_rejection(size);
      if (step * factor < shortest_step * longest_) fail(step);
      step *= factor;
    }
  }

  /// Those of the last stage, unless the system has changed since.
  void offer_rates(std::span<const double> rates) override { std::copy(rates.begin(), rates.end(), k_.back().begin()); }
  [[nodiscard]] bool uses_offered_rates() const override { return is_observed(); }
  bool evaluate_ends_with(const EndEvaluation& evaluation) override {
    end_evaluation_ = evaluation;
    return true;
  }

  void interpolate(double t, std::span<double> y) const override {
    const double theta = part_of_step(t, time_, last_step_);
    const auto k = stage_rates();
    std::array<double, most_stages> factor{};
    for (int i = 0; i < method_.n_stages; ++i)
      at(factor, i) = last_step_ * method_.weight(static_cast<std::size_t>(i), theta);
    wide<combine<1>>(0, n_, before_.data(), factor.data(), k.data(), method_.n_stages, y.data());
    exponentials_.interpolate(theta, y);
  }

  [[nodiscard]] IntegrationStatistics statistics() const override { return statistics_; }

 private:
  [[nodiscard]] AlignedNumbers& at_start() { return at(k_, method_.start); }
  [[nodiscard]] bool is_observed() const { return static_cast<bool>(end_evaluation_); }
  /// After an instant of the system, whose rates before it say nothing of those after it; its error control does of the step.
  void begin_anew() {
    is_cut_ = has_rates_ = false;
    last_step_ = 0.;
  }
  void evaluate(double t, std::span<const double> y, std::span<double> rates) {
    ++statistics_.rhs_evaluations;
    system_.rhs(t, y, rates);
  }

  [[nodiscard]] std::array<const double*, most_stages> stage_rates() const {
    std::array<const double*, most_stages> k{};
    for (int i = 0; i < method_.n_stages; ++i) at(k, i) = at(k_, i).data();
    return k;
  }

  /// Leaves the new state in stage_. @returns the error over what is allowed; not a number if a new state or a rate is not finite
  double try_step(double step, double target) {
    fit_to_step(method_, step, last_step_);
    const auto k = stage_rates();
    std::array<double, most_stages> factor{};
    const auto scaled = [&](const std::array<double, most_stages>& coefficients) {
      std::transform(coefficients.begin(), coefficients.end(), factor.begin(), [&](double a) { return step * a; });
      return factor.data();
    };
    // Nothing depends on quadratures: the stages before the last leave them as they are.
    std::copy(y_.begin() + static_cast<std::ptrdiff_t>(n_controlled_), y_.end(),
              stage_.begin() + static_cast<std::ptrdiff_t>(n_controlled_));
    const int last = method_.n_stages - 1;
    const double latest = instants_.latest(target);
    if (!exponentials_.empty()) {
      exponentials_.begin(step, last_step_, {y_, at_start(), before_, k_.front()});
      exponentials_.hide(own_scale_);
    }
    for (int i = method_.start + 1; i < last; ++i) {
      wide<combine<1>>(0, n_controlled_, y_.data(), scaled(at(method_.a, i)), k.data(), i, stage_.data());
      exponentials_.place(i, stage_);
      evaluate(std::min(time_ + at(method_.c, i) * step, latest), stage_, at(k_, i));
      exponentials_.take(i, at(k_, i));
    }
    wide<combine<1>>(0, n_, y_.data(), scaled(at(method_.a, last)), k.data(), last, stage_.data());
    exponentials_.place(last, stage_);
    if (is_observed()) {
      ++statistics_.rhs_evaluations;
      end_evaluation_(target, stage_, at(k_, last));
    } else {
      evaluate(std::min(target, latest), stage_, at(k_, last));
    }
    exponentials_.take(last, at(k_, last));
    // A rate that is not finite makes the new state so.
    const StepEnds ends{n_controlled_,     n_,        y_.data(), stage_.data(), at(k_, last).data(),
                        own_scale_.data(), tolerance_};
    const double sum = wide<squared_error<1>>(ends, scaled(method_.e), k.data(), method_.n_stages) +
                       exponentials_.squared_error(tolerance_);
    return std::sqrt(sum / static_cast<double>(n_weighed_));
  }

  void accept(const Trial& trial, double size, bool was_rejected) {
    std::swap(before_, y_);
    std::swap(y_, stage_);
    time_ = trial.target;
    last_step_ = trial.size;
    ++statistics_.steps;
    is_cut_ = trial.ends;
    // A step that was cut says nothing of the next one.
    if (!is_cut_) next_step_ = std::min(trial.size * control_.after_acceptance(size, was_rejected), longest_);
  }

  [[noreturn]] void fail(double step) {
    for (const auto& k : k_)
      if (!all_finite(k)) throw_rates_not_finite(system_.layout(), k, time_, step);
    std::vector<double> weighted(n_);
    for (std::size_t i = 0; i < n_controlled_; ++i) {
      double error = 0.;
      for (int j = 0; j < method_.n_stages; ++j) error += step * at(method_.e, j) * at(k_, j)[i];
      weighted[i] = error / (tolerance_ * (scale_[i] + std::max(std::fabs(y_[i]), std::fabs(stage_[i]))));
    }
    throw_no_step(system_.layout(), time_, step, weighted);
  }

  [[nodiscard]] double first_step() const {
    return control_.first(
        std::span(scale_).first(n_controlled_), [&](std::size_t i) { return y_[i]; },
        [&](std::size_t i) { return at(k_, method_.start)[i]; });
  }

  EmbeddedTableau method_;
  const OdeSystem& system_;
  std::size_t n_, n_controlled_;
  double tolerance_, longest_, time_;
  Instants instants_;
  StepControl control_;
  double next_step_ = 0, last_step_ = 0;
  bool has_rates_ = false, is_cut_ = false;
  AlignedNumbers y_, before_, stage_, scale_;
  AlignedNumbers own_scale_;  ///< infinite where exponentials are at work
  ExponentialStages exponentials_;
  /// States over which the mean of squared errors is taken: without fast oscillators, whose small errors would allow the others more.
  std::size_t n_weighed_;
  std::vector<AlignedNumbers> k_;
  EndEvaluation end_evaluation_;
  IntegrationStatistics statistics_;
};

}  // namespace

std::unique_ptr<Integrator> make_embedded_pair(const OdeSystem& system, const IntegrationParameters& parameters,
                                               double start_time, std::span<const double> state, double end_time) {
  return std::make_unique<EmbeddedPair>(tableau_of(parameters.method), system, parameters, start_time, state, end_time);
}

}  // namespace rotordrop
