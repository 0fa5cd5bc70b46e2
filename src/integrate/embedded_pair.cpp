// Explicit embedded Runge-Kutta pairs of our own: first same as last, quadratures outside the stages and the error control, free interpolant,
// and a last stage that the caller may evaluate together with whatever else it wants to know of the step's end.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/errors.h"
#include "base/wide_vectors.h"
#include "integrate/failures.h"
#include "integrate/integrator.h"
#include "integrate/methods.h"

namespace rotordrop {
namespace {

constexpr int most_stages = 7, most_powers = 4;

/// y_i = y + h sum_j a_ij k_j, k_i = f(t + c_i h, y_i); the last stage is the new state. Error: h sum_i e_i k_i.
/// Interpolant: y + h sum_i k_i sum_p polynomial_ip theta^p, p = 1, 2, ...
struct Pair {
  int n_stages, order, powers;
  std::array<double, most_stages> c;
  std::array<std::array<double, most_stages>, most_stages> a;
  std::array<double, most_stages> e;
  std::array<std::array<double, most_powers>, most_stages> polynomial;
};

/// Order 5(4). Source: Tsitouras, Computers and Mathematics with Applications 62 (2011) 770-775; interpolant of order 4 from the same.
constexpr Pair tsitouras = {
    7,
    5,
    4,
    {0., 0.161, 0.327, 0.9, 0.9800255409045097, 1., 1.},
    {{{},
      {0.161},
      {-0.008480655492356989, 0.335480655492357},
      {2.8971530571054935, -6.359448489975075, 4.3622954328695815},
      {5.325864828439257, -11.748883564062828, 7.4955393428898365, -0.09249506636175525},
      {5.86145544294642, -12.92096931784711, 8.159367898576159, -0.071584973281401, -0.028269050394068383},
      {0.09646076681806523, 0.01, 0.4798896504144996, 1.379008574103742, -3.290069515436081, 2.324710524099774}}},
    {-0.00178001105222577714, -0.0008164344596567469, 0.007880878010261995, -0.1447110071732629, 0.5823571654525552,
     -0.45808210592918697, 1. / 66.},
    {{{1., -2.763706197274826, 2.9132554618219126, -1.0530884977290216},
      {0., 0.1317, -0.2234, 0.1017},
      {0., 3.9302962368947516, -5.941033872131505, 2.490627285651253},
      {0., -12.411077166933676, 30.33818863028232, -16.548102889244902},
      {0., 37.50931341651104, -88.1789048947664, 47.37952196281928},
      {0., -27.896526289197286, 65.09189467479366, -34.87065786149661},
      {0., 1.5, -4., 2.5}}}};

/// Order 3(2), with Hermite's cubic. Source: Bogacki & Shampine, Applied Mathematics Letters 2 (1989) 321-325.
constexpr Pair bogacki_shampine = {
    4,
    3,
    3,
    {0., 0.5, 0.75, 1.},
    {{{}, {0.5}, {0., 0.75}, {2. / 9., 1. / 3., 4. / 9.}}},
    {-5. / 72., 1. / 12., 1. / 9., -1. / 8.},
    {{{1., -4. / 3., 5. / 9.}, {0., 1., -2. / 3.}, {0., 4. / 3., -8. / 9.}, {0., -1., 1.}}}};

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

/// Sum of (error / (tolerance (scale + largest magnitude of both states)))^2.
ROTORDROP_KERNEL double squared_error(std::size_t n, const double* error, const double* before, const double* after,
                                      const double* scale, double tolerance) {
  double sum = 0.;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < n; ++i) {
    const double a = std::fabs(before[i]), b = std::fabs(after[i]);
    const double allowed = tolerance * (scale[i] + (a > b ? a : b));
    const double part = error[i] / allowed;
    sum += part * part;
  }
  return sum;
}

class EmbeddedPair final : public Integrator {
 public:
  EmbeddedPair(const Pair& pair, const OdeSystem& system, const IntegrationParameters& parameters, double start_time,
               std::span<const double> state, double end_time)
      : pair_(pair),
        system_(system),
        n_(system.layout().size()),
        n_controlled_(system.first_quadrature()),
        tolerance_(parameters.tolerance),
        longest_(step_or_bound(parameters)),
        time_(start_time),
        end_time_(end_time),
        y_(state.begin(), state.end()),
        before_(y_),
        stage_(y_),
        error_(n_) {
    for (const auto& entry : system.layout().entries()) scale_.push_back(entry.scale);
    for (int i = 0; i < pair_.n_stages; ++i) k_.emplace_back(n_);
  }

  [[nodiscard]] double time() const override { return time_; }
  [[nodiscard]] std::span<const double> state() const override { return y_; }

  void advance() override {
    if (!has_rates_) {
      evaluate(time_, y_, k_.front());
      if (!all_finite(k_.front())) throw_rates_not_finite(system_.layout(), k_.front(), time_, next_step_);
      has_rates_ = true;
    } else if (last_step_ > 0.) {
      std::swap(k_.front(), k_.back());  // first same as last
    }
    if (next_step_ == 0.) next_step_ = first_step();
    double step = next_step_;
    bool was_rejected = false;
    for (;;) {
      step = std::min(step, longest_);
      const bool ends = time_ + step * (1. + 1e-6) >= end_time_;
      if (ends) step = end_time_ - time_;
      const double target = ends ? end_time_ : time_ + step;
      const double size = try_step(step, target);
      if (size <= 1.) {
        accept(step, target, size, was_rejected, ends);
        return;
      }
      was_rejected = true;
      ++statistics_.rejected_steps;
      const double factor = std::isfinite(size) ? std::max(0.2, 0.9 * std::pow(size, -1. / pair_.order)) : 0.25;
      if (step * factor < shortest_step * longest_) fail(step, size);
      step *= factor;
    }
  }

  void offer_rates(std::span<const double>) override {}  // they are the last stage's
  [[nodiscard]] bool uses_offered_rates() const override { return is_observed(); }
  bool evaluate_ends_with(const EndEvaluation& evaluation) override {
    end_evaluation_ = evaluation;
    return true;
  }

  void interpolate(double t, std::span<double> y) const override {
    const double theta = (t - (time_ - last_step_)) / last_step_;
    // Like the step's end, a time that rounding puts outside is inside.
    if (!(theta >= -1e-6 && theta <= 1. + 1e-6)) throw SolverError("a time outside the last step was asked for");
    std::array<double, most_stages> factor{};
    std::array<const double*, most_stages> k{};
    for (int i = 0; i < pair_.n_stages; ++i) {
      double value = 0.;
      for (int p = pair_.powers; p-- > 0;)
        value = theta * (value + at(pair_.polynomial, i)[static_cast<std::size_t>(p)]);
      at(factor, i) = last_step_ * value;
      at(k, i) = at(k_, i).data();
    }
    wide<combine<1>>(0, n_, before_.data(), factor.data(), k.data(), pair_.n_stages, y.data());
  }

  [[nodiscard]] IntegrationStatistics statistics() const override { return statistics_; }

 private:
  [[nodiscard]] bool is_observed() const { return static_cast<bool>(end_evaluation_); }
  void evaluate(double t, std::span<const double> y, std::span<double> rates) {
    ++statistics_.rhs_evaluations;
    system_.rhs(t, y, rates);
  }

  /// Leaves the new state in stage_. @returns the error over what is allowed; not finite if a rate is not
  double try_step(double step, double target) {
    std::array<const double*, most_stages> k{};
    for (int i = 0; i < pair_.n_stages; ++i) at(k, i) = at(k_, i).data();
    std::array<double, most_stages> factor{};
    const auto scaled = [&](const std::array<double, most_stages>& coefficients) {
      std::transform(coefficients.begin(), coefficients.end(), factor.begin(), [&](double a) { return step * a; });
      return factor.data();
    };
    // Nothing depends on quadratures: the stages before the last leave them as they are.
    std::copy(y_.begin() + static_cast<std::ptrdiff_t>(n_controlled_), y_.end(),
              stage_.begin() + static_cast<std::ptrdiff_t>(n_controlled_));
    const int last = pair_.n_stages - 1;
    for (int i = 1; i < last; ++i) {
      wide<combine<1>>(0, n_controlled_, y_.data(), scaled(at(pair_.a, i)), k.data(), i, stage_.data());
      evaluate(time_ + at(pair_.c, i) * step, stage_, at(k_, i));
      if (!all_finite(at(k_, i))) return not_finite(i);
    }
    wide<combine<1>>(0, n_, y_.data(), scaled(at(pair_.a, last)), k.data(), last, stage_.data());
    if (is_observed()) {
      ++statistics_.rhs_evaluations;
      end_evaluation_(target, stage_, at(k_, last));
    } else {
      evaluate(target, stage_, at(k_, last));
    }
    if (!all_finite(at(k_, last))) return not_finite(last);
    std::fill(error_.begin(), error_.end(), 0.);
    wide<combine<1>>(0, n_controlled_, error_.data(), scaled(pair_.e), k.data(), pair_.n_stages, error_.data());
    const double sum =
        wide<squared_error>(n_controlled_, error_.data(), y_.data(), stage_.data(), scale_.data(), tolerance_);
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(n_controlled_, 1)));
  }

  double not_finite(int stage) {
    bad_stage_ = stage;
    return HUGE_VAL;
  }

  void accept(double step, double target, double size, bool was_rejected, bool ends) {
    std::swap(before_, y_);
    std::swap(y_, stage_);
    time_ = target;
    last_step_ = step;
    ++statistics_.steps;
    // PI control. Source: Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, 2nd ed., IV.2 (beta = 0.04).
    constexpr double beta = 0.04;
    const double exponent = 1. / pair_.order - 0.75 * beta;
    double factor = 0.9 * std::pow(std::max(size, 1e-10), -exponent) * std::pow(previous_size_, beta);
    factor = std::clamp(factor, 0.2, was_rejected ? 1. : 5.);
    previous_size_ = std::max(size, 1e-4);
    // A last step cut to the end says nothing of the next one; there is none.
    if (!ends) next_step_ = std::min(step * factor, longest_);
  }

  [[noreturn]] void fail(double step, double size) {
    if (!std::isfinite(size) && bad_stage_ >= 0)
      throw_rates_not_finite(system_.layout(), at(k_, bad_stage_), time_, step);
    std::vector<double> weighted(n_);
    for (std::size_t i = 0; i < n_controlled_; ++i)
      weighted[i] = error_[i] / (tolerance_ * (scale_[i] + std::max(std::fabs(y_[i]), std::fabs(stage_[i]))));
    throw_no_step(system_.layout(), time_, step, weighted);
  }

  /// A hundredth of the time in which the states change by their size, at a tolerance of 1e-6; longer and shorter as the method's error allows.
  /// Source: after II.4 of the same.
  [[nodiscard]] double first_step() const {
    double states = 0., rates = 0.;
    for (std::size_t i = 0; i < n_controlled_; ++i) {
      const double allowed = scale_[i] + std::fabs(y_[i]);
      states += std::pow(y_[i] / allowed, 2);
      rates += std::pow(k_.front()[i] / allowed, 2);
    }
    const double step = states > 1e-10 && rates > 1e-10 ? 0.01 * std::sqrt(states / rates) : 1e-6;
    return std::clamp(step * std::pow(tolerance_ / 1e-6, 1. / pair_.order), 1e-3 * longest_, longest_);
  }

  const Pair& pair_;
  const OdeSystem& system_;
  std::size_t n_, n_controlled_;
  double tolerance_, longest_, time_, end_time_;
  double next_step_ = 0, last_step_ = 0, previous_size_ = 1e-4;
  bool has_rates_ = false;
  int bad_stage_ = -1;
  std::vector<double> y_, before_, stage_, error_, scale_;
  std::vector<std::vector<double>> k_;
  EndEvaluation end_evaluation_;
  IntegrationStatistics statistics_;
};

}  // namespace

std::unique_ptr<Integrator> make_embedded_pair(const OdeSystem& system, const IntegrationParameters& parameters,
                                               double start_time, std::span<const double> state, double end_time) {
  const Pair& pair = parameters.method == IntegrationMethod::tsitouras ? tsitouras : bogacki_shampine;
  return std::make_unique<EmbeddedPair>(pair, system, parameters, start_time, state, end_time);
}

}  // namespace rotordrop
