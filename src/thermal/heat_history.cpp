#include "thermal/heat_history.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

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

}  // namespace rotordrop
