#include "thermal/heating/heat_history.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace rotordrop {

FluxSteps steps_of(const PulseTrain& train) {
  FluxSteps steps;
  const bool is_one = train.count == 1 || train.period - train.width < 1e-12 * train.period;
  const int n = is_one ? 1 : train.count;
  const double width = is_one && train.count > 1 ? train.count * train.period : train.width;
  for (int i = 0; i < n; ++i) {
    const double begin = train.start + i * train.period;
    steps.times.insert(steps.times.end(), {begin, begin + width});
    steps.values.insert(steps.values.end(), {train.height, 0.});
  }
  return steps;
}

FluxSteps steps_of(const RecordedHeat& heat, double area, double share, double interval) {
  // Rows that are kept.
  std::vector<double> t, E;
  const std::size_t n = std::min(heat.times.size(), heat.joules.size());
  for (std::size_t i = 0; i < n; ++i) {
    const bool is_later = t.empty() || heat.times[i] > t.back();
    if (is_later && (t.empty() || i + 1 == n || heat.times[i] - t.back() >= interval * (1. - 1e-9))) {
      t.push_back(heat.times[i]);
      E.push_back(heat.joules[i]);
    }
  }
  FluxSteps steps;
  if (t.size() < 2) return steps;
  const auto power = [&](std::size_t from, std::size_t to) { return (E[to] - E[from]) / (t[to] - t[from]); };
  double largest = 0.;
  for (std::size_t i = 1; i < t.size(); ++i) largest = std::max(largest, std::fabs(power(i - 1, i)));
  // A step's value comes from the heat at its ends, however many rows it joins: no rounding adds up.
  for (std::size_t first = 0, last = 0; first + 1 < t.size(); first = last) {
    for (last = first + 1; last + 1 < t.size(); ++last)
      if (std::fabs(power(last, last + 1) - power(first, last)) > 1e-9 * largest) break;
    steps.times.push_back(t[first]);
    steps.values.push_back(share / area * power(first, last));
  }
  steps.times.push_back(t.back());
  steps.values.push_back(0.);
  return steps;
}

void BearingHeatHistory::add(HeatedPort port, FluxSteps steps, double factor) {
  for (double& value : steps.values) value *= factor;
  const std::size_t n = steps.times.size();
  parts_.push_back({port, std::move(steps.times), std::move(steps.values), std::vector<double>(n, 0.)});
}

void BearingHeatHistory::add_linear(HeatedPort port, const FluxSteps& points, double factor) {
  Part part{port, points.times, points.values, std::vector<double>(points.times.size(), 0.)};
  for (double& value : part.values) value *= factor;
  for (std::size_t i = 0; i + 1 < part.times.size(); ++i)
    part.slopes[i] = (part.values[i + 1] - part.values[i]) / (part.times[i + 1] - part.times[i]);
  parts_.push_back(std::move(part));
}

std::vector<double> BearingHeatHistory::changes() const {
  std::vector<double> times;
  for (const auto& part : parts_) times.insert(times.end(), part.times.begin(), part.times.end());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

std::array<double, n_heated_ports> BearingHeatHistory::sums(double t, bool of_slopes) const {
  std::array<double, n_heated_ports> sum{};
  for (const auto& part : parts_) {
    const auto next = std::upper_bound(part.times.begin(), part.times.end(), t);
    if (next == part.times.begin()) continue;
    const auto i = static_cast<std::size_t>(next - part.times.begin()) - 1;
    sum[static_cast<std::size_t>(part.port)] +=
        of_slopes ? part.slopes[i] : part.values[i] + part.slopes[i] * (t - part.times[i]);
  }
  return sum;
}

HeatInput BearingHeatHistory::heat(double t) const {
  const auto [ring, shaft, inner, outer] = sums(t, false);
  const auto [ring_slope, shaft_slope, i, o] = sums(t, true);
  HeatInput heat{.rub = ring + shaft, .rub_into_ring = ring, .inner = inner, .outer = outer, .balls = {}, .rows = {}};
  heat.is_in_contact = heat.rub != 0. || ring_slope + shaft_slope != 0.;
  return heat;
}

HeatInput BearingHeatHistory::rate(double t) const {
  const auto [ring, shaft, inner, outer] = sums(t, true);
  return {.rub = ring + shaft, .rub_into_ring = ring, .inner = inner, .outer = outer, .balls = {}, .rows = {}};
}

double BearingHeatHistory::Part::integral(double until, bool is_unsigned) const {
  double sum = 0.;
  for (std::size_t i = 0; i < times.size() && times[i] < until; ++i) {
    const double length = (i + 1 < times.size() ? std::min(until, times[i + 1]) : until) - times[i];
    const double mean = values[i] + 0.5 * slopes[i] * length;
    sum += length * (is_unsigned ? std::fabs(mean) : mean);
  }
  return sum;
}

double BearingHeatHistory::joules(HeatedPort port, double until) const {
  double sum = 0.;
  for (const auto& part : parts_)
    if (part.port == port) sum += part.integral(until, false);
  return sum;
}

double BearingHeatHistory::turnover(double until) const {
  double sum = 0.;
  for (const auto& part : parts_) sum += part.integral(until, true);
  return sum;
}

}  // namespace rotordrop
