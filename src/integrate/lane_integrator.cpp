#include "integrate/lane_integrator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/errors.h"
#include "base/wide_vectors.h"
#include "integrate/failures.h"
#include "integrate/integration_parameters.h"
#include "integrate/methods.h"

namespace rotordrop {
namespace {

constexpr std::size_t width = LaneSystem::width;
static_assert(width == vector_length);

/// out = y + sum_j factor_j k_j, factors of every lane. @param factors [count][width]
template <int n>
ROTORDROP_KERNEL void combine_all(std::size_t size, const double* y, const double* factors, const double* const* list,
                                  double* out) {
  // Copies stay in registers: what is written below cannot change them.
  const double* k[n];
  std::copy_n(list, n, k);
  double factor[n * width];
  std::copy_n(factors, n * width, factor);
  for (std::size_t at = 0; at < size * width; at += width) {
#pragma omp simd
    for (std::size_t l = 0; l < width; ++l) {
      double sum = y[at + l];
#pragma GCC unroll 8
      for (int j = 0; j < n; ++j) sum += factor[static_cast<std::size_t>(j) * width + l] * k[j][at + l];
      out[at + l] = sum;
    }
  }
}
template <int n = 1>
ROTORDROP_KERNEL void combine_lanes(std::size_t size, const double* y, const double* factors, const double* const* k,
                                    int count, double* out) {
  if constexpr (n < most_stages)
    if (count > n) return combine_lanes<n + 1>(size, y, factors, k, count, out);
  combine_all<n>(size, y, factors, k, out);
}

/// What the errors of a step are measured by.
struct StepEnds {
  const double *before, *after, *rates;  // [n][width]
  const double *scale, *tolerance;       // [n_controlled][width], [width]
};
/// Sums of (error / (tolerance (scale + largest magnitude of both states)))^2 with the errors sum_j factor_j k_j; not a number for a lane with a rate
/// or a new state that is not finite.
template <int n>
ROTORDROP_KERNEL void squared_errors_of_all(std::size_t n_controlled, std::size_t size, const double* factors,
                                            const double* const* list, const StepEnds& ends, double* sums) {
  const double* k[n];
  std::copy_n(list, n, k);
  double factor[n * width], tolerance[width];
  std::copy_n(factors, n * width, factor);
  std::copy_n(ends.tolerance, width, tolerance);
  const double *before = ends.before, *after = ends.after, *rates = ends.rates;
  Octet sum;
  for (std::size_t i = 0; i < n_controlled; ++i) {
    const std::size_t at = i * width;
    const double* scale = ends.scale + at;
#pragma omp simd
    for (std::size_t l = 0; l < width; ++l) {
      double error = 0.;
#pragma GCC unroll 8
      for (int j = 0; j < n; ++j) error += factor[static_cast<std::size_t>(j) * width + l] * k[j][at + l];
      const double a = std::fabs(before[at + l]), b = std::fabs(after[at + l]);
      const double part = error / (tolerance[l] * (scale[l] + (a > b ? a : b)));
      sum[l] += part * part;
    }
  }
  for (std::size_t at = 0; at < size * width; at += width)
#pragma omp simd
    for (std::size_t l = 0; l < width; ++l) sum[l] += (after[at + l] - after[at + l]) + (rates[at + l] - rates[at + l]);
  std::copy(sum.value.begin(), sum.value.end(), sums);
}
template <int n = 1>
ROTORDROP_KERNEL void squared_errors(std::size_t n_controlled, std::size_t size, const double* factors,
                                     const double* const* k, int count, const StepEnds& ends, double* sums) {
  if constexpr (n < most_stages)
    if (count > n) return squared_errors<n + 1>(n_controlled, size, factors, k, count, ends, sums);
  squared_errors_of_all<n>(n_controlled, size, factors, k, ends, sums);
}

/// to = from in lanes whose flag is not zero.
ROTORDROP_KERNEL void take(std::size_t size, const double* flags, const double* from, double* to) {
  for (std::size_t at = 0; at < size * width; at += width)
#pragma omp simd
    for (std::size_t l = 0; l < width; ++l) to[at + l] = flags[l] != 0. ? from[at + l] : to[at + l];
}

/// Numbers that stand side by side by lanes, one lane after the other: all lanes at once, so that vectors are turned instead of numbers picked.
ROTORDROP_KERNEL void turn(std::size_t size, const double* from, double* to) {
  double *a = to, *b = a + size, *c = b + size, *d = c + size, *e = d + size, *f = e + size, *g = f + size,
         *h = g + size;
#pragma omp simd
  for (std::size_t i = 0; i < size; ++i) {
    const double* of = from + i * width;
    a[i] = of[0];
    b[i] = of[1];
    c[i] = of[2];
    d[i] = of[3];
    e[i] = of[4];
    f[i] = of[5];
    g[i] = of[6];
    h[i] = of[7];
  }
}
static_assert(width == 8);

}  // namespace

void LaneIntegrator::ByLane::lay_out(const AlignedNumbers& side_by_side) {
  wide<turn>(length, side_by_side.data(), numbers.data());
}

bool runs_in_lanes(IntegrationMethod method) { return is_own_pair(method); }

void LaneView::advance() { throw std::logic_error("a lane is advanced with its neighbours"); }

LaneIntegrator::LaneIntegrator(std::unique_ptr<LaneSystem> system, const Lane& like, std::size_t n_step)
    : system_(std::move(system)),
      shape_(tableau_of(like.parameters.method)),
      n_(system_->layout().size()),
      n_controlled_(system_->first_quadrature()),
      scale_(n_controlled_ * width),
      y_(n_ * width),
      step_(n_step * width),
      y_by_lane_(n_),
      step_by_lane_(n_step) {
  for (int i = 0; i < shape_.n_stages; ++i) k_.emplace_back(n_ * width);
  before_ = stage_ = y_;
  methods_.fill(shape_);
  control_.assign(width, StepControl(shape_, 1., 1.));
  for (std::size_t l = 0; l < width; ++l) begin(l, like);
  runs_.fill(false);
  begun_.fill(0.);
}

void LaneIntegrator::begin(std::size_t l, const Lane& drop) {
  if (&tableau_of(drop.parameters.method) != &shape_ || drop.state.size() != n_ || drop.layout->size() != n_)
    throw std::invalid_argument("drops in lanes are of one kind, integrated by one method");
  for (std::size_t i = 0; i < n_controlled_; ++i) scale_[i * width + l] = drop.layout->entries()[i].scale;
  for (std::size_t i = 0; i < n_; ++i)
    y_[i * width + l] = before_[i * width + l] = stage_[i * width + l] = y_by_lane_.numbers[l * n_ + i] = drop.state[i];
  if (details_.size() < drop.n_details * width) details_.resize(drop.n_details * width);
  time_[l] = drop.start_time;
  end_time_[l] = drop.end_time;
  instants_[l] = drop.instants.empty() ? Instants({}, drop.end_time) : drop.instants;
  tolerance_[l] = drop.parameters.tolerance;
  longest_[l] = step_or_bound(drop.parameters);
  control_[l] = StepControl(shape_, tolerance_[l], longest_[l]);
  last_step_[l] = next_step_[l] = stepped_[l] = 0.;
  within_time_[l] = std::numeric_limits<double>::quiet_NaN();  // what lies in within_ is of the drop before
  was_rejected_[l] = false;
  statistics_[l] = {};
  failures_[l] = nullptr;
  begun_[l] = 1.;
  runs_[l] = true;
}

/// First rates and steps of drops that were begun, or rates after an instant; lanes amid theirs keep what they have.
void LaneIntegrator::start_begun() {
  if (std::all_of(begun_.begin(), begun_.end(), [](double flag) { return flag == 0.; })) return;
  system_->rates(time_, y_, k_.back());
  wide<take>(n_, begun_.data(), k_.back().data(), at_start().data());
  for (std::size_t l = 0; l < width; ++l) {
    if (begun_[l] == 0.) continue;
    begun_[l] = last_step_[l] = 0.;
    ++statistics_[l].rhs_evaluations;
    if (next_step_[l] != 0.) continue;
    std::vector<double> scale(n_controlled_);
    column(scale_, l, scale);
    next_step_[l] = control_[l].first(
        scale, [&](std::size_t i) { return y_[i * width + l]; },
        [&](std::size_t i) { return at_start()[i * width + l]; });
  }
}

void LaneIntegrator::combine(std::size_t n, int stage) {
  std::array<const double*, most_stages> k{};
  std::array<double, most_stages * width> factors;
  const auto count = static_cast<std::size_t>(stage);
  for (std::size_t j = 0; j < count; ++j) {
    k[j] = k_[j].data();
    for (std::size_t l = 0; l < width; ++l) factors[j * width + l] = tried_[l] * methods_[l].a[count][j];
  }
  wide<combine_lanes<1>>(n, y_.data(), factors.data(), k.data(), stage, stage_.data());
}

LaneIntegrator::PerLane LaneIntegrator::error_sizes() {
  std::array<const double*, most_stages> k{};
  std::array<double, most_stages * width> factors;
  for (std::size_t j = 0; j < k_.size(); ++j) {
    k[j] = k_[j].data();
    for (std::size_t l = 0; l < width; ++l) factors[j * width + l] = tried_[l] * shape_.e[j];
  }
  PerLane sums;
  const StepEnds ends{y_.data(), stage_.data(), k_.back().data(), scale_.data(), tolerance_.data()};
  wide<squared_errors<1>>(n_controlled_, n_, factors.data(), k.data(), shape_.n_stages, ends, sums.data());
  for (double& sum : sums) sum = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(n_controlled_, 1)));
  return sums;
}

bool LaneIntegrator::have_all_stepped() const {
  return std::all_of(stepped_.begin(), stepped_.end(), [](double flag) { return flag != 0.; });
}

void LaneIntegrator::advance() {
  // First same as last.
  if (have_all_stepped()) {
    if (sees_past(shape_)) k_.front().swap(at_start());
    at_start().swap(k_.back());
  } else {
    if (sees_past(shape_)) wide<take>(n_, stepped_.data(), at_start().data(), k_.front().data());
    wide<take>(n_, stepped_.data(), k_.back().data(), at_start().data());
  }
  start_begun();
  for (std::size_t l = 0; l < width; ++l) {
    const Trial trial =
        runs_[l] ? control_[l].trial(next_step_[l], time_[l], instants_[l].next(time_[l])) : Trial{0., time_[l]};
    tried_[l] = trial.size;
    target_[l] = trial.target;
    ends_[l] = trial.ends;
    if (!runs_[l]) continue;
    statistics_[l].rhs_evaluations += shape_.n_stages - 1 - shape_.start;
    fit_to_step(methods_[l], trial.size, last_step_[l]);
  }
  PerLane latest;
  for (std::size_t l = 0; l < width; ++l) latest[l] = instants_[l].latest(target_[l]);
  // Nothing depends on quadratures: the stages before the last leave them as they are.
  const int last = shape_.n_stages - 1;
  for (int i = shape_.start + 1; i < last; ++i) {
    const auto at = static_cast<std::size_t>(i);
    combine(n_controlled_, i);
    PerLane t;
    for (std::size_t l = 0; l < width; ++l) t[l] = std::min(time_[l] + shape_.c[at] * tried_[l], latest[l]);
    system_->rates(t, stage_, k_[at]);
  }
  combine(n_, last);
  PerLane end;
  for (std::size_t l = 0; l < width; ++l) end[l] = std::min(target_[l], latest[l]);
  system_->observe(end, stage_, k_.back(), step_, details_);
  const PerLane sizes = error_sizes();
  for (std::size_t l = 0; l < width; ++l) finish(l, sizes[l]);
  if (have_all_stepped()) {
    before_.swap(y_);
    y_.swap(stage_);
  } else {
    wide<take>(n_, stepped_.data(), y_.data(), before_.data());
    wide<take>(n_, stepped_.data(), stage_.data(), y_.data());
  }
  y_by_lane_.lay_out(y_);
  step_by_lane_.lay_out(step_);
}

void LaneIntegrator::finish(std::size_t l, double size) {
  stepped_[l] = 0.;
  if (!runs_[l]) return;
  if (size <= 1.) {
    stepped_[l] = 1.;
    time_[l] = target_[l];
    last_step_[l] = tried_[l];
    ++statistics_[l].steps;
    if (time_[l] >= end_time_[l])
      runs_[l] = false;
    else if (ends_[l])
      begun_[l] = 1.;
    else
      next_step_[l] = std::min(tried_[l] * control_[l].after_acceptance(size, was_rejected_[l]), longest_[l]);
    was_rejected_[l] = false;
    return;
  }
  was_rejected_[l] = true;
  ++statistics_[l].rejected_steps;
  next_step_[l] = tried_[l] * control_[l].after_rejection(size);
  if (next_step_[l] >= shortest_step * longest_[l]) return;
  runs_[l] = false;
  try {
    fail(l, size);
  } catch (const SolverError&) {
    failures_[l] = std::current_exception();
  }
}

void LaneIntegrator::fail(std::size_t l, double size) const {
  if (!std::isfinite(size))
    for (const auto& k : k_) {
      std::vector<double> rates(n_);
      column(k, l, rates);
      if (!all_finite(rates)) throw_rates_not_finite(system_->layout(), rates, time_[l], tried_[l]);
    }
  std::vector<double> weighted(n_);
  for (std::size_t i = 0; i < n_controlled_; ++i) {
    const std::size_t at = i * width + l;
    double error = 0.;
    for (std::size_t j = 0; j < k_.size(); ++j) error += tried_[l] * shape_.e[j] * k_[j][at];
    weighted[i] = error / (tolerance_[l] * (scale_[at] + std::max(std::fabs(y_[at]), std::fabs(stage_[at]))));
  }
  throw_no_step(system_->layout(), time_[l], tried_[l], weighted);
}

void LaneIntegrator::interpolate(std::size_t l, double t, std::span<double> y) const {
  if (has_stepped(l) && t == within_time_[l] && t < time_[l] && t > time_[l] - last_step_[l])
    return column(within_, l, y);  // interpolate_all() was there
  const double theta = part_of_step(t, time_[l], last_step_[l]);
  column(before_, l, y);
  for (std::size_t j = 0; j < k_.size(); ++j) {
    const double factor = last_step_[l] * methods_[l].weight(j, theta);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += factor * k_[j][i * width + l];
  }
}

void LaneIntegrator::interpolate_all(std::span<const double> t) {
  within_.resize(y_.size());
  std::array<const double*, most_stages> k{};
  std::array<double, most_stages * width> factors{};
  for (std::size_t j = 0; j < k_.size(); ++j) {
    k[j] = k_[j].data();
    for (std::size_t l = 0; l < width; ++l)
      if (has_stepped(l))
        factors[j * width + l] =
            last_step_[l] * methods_[l].weight(j, (t[l] - (time_[l] - last_step_[l])) / last_step_[l]);
  }
  wide<combine_lanes<1>>(n_, before_.data(), factors.data(), k.data(), shape_.n_stages, within_.data());
  std::copy(t.begin(), t.end(), within_time_.begin());
}

}  // namespace rotordrop
