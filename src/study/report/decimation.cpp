#include "study/report/decimation.h"

#include <algorithm>
#include <stdexcept>

namespace rotordrop {

TimeSeries decimated(const TimeSeries& series, std::size_t n_buckets) {
  if (n_buckets == 0) throw std::invalid_argument("decimated: no buckets");
  const std::size_t n = series.times.size();
  if (n <= 2 * n_buckets + 2) return series;
  TimeSeries result;
  const auto keep = [&](std::size_t k) {
    result.times.push_back(series.times[k]);
    result.values.push_back(series.values[k]);
  };
  const double start = series.times.front(), span = series.times.back() - start;
  keep(0);
  std::size_t k = 1;
  for (std::size_t bucket = 0; bucket < n_buckets; ++bucket) {
    const double end = start + span * static_cast<double>(bucket + 1) / static_cast<double>(n_buckets);
    const bool is_last = bucket + 1 == n_buckets;
    std::size_t low = k, high = k, next = k;
    for (; next + 1 < n && (is_last || series.times[next] < end); ++next) {
      if (series.values[next] < series.values[low]) low = next;
      if (series.values[next] > series.values[high]) high = next;
    }
    if (next == k) continue;
    keep(std::min(low, high));
    if (low != high) keep(std::max(low, high));
    k = next;
  }
  keep(n - 1);
  return result;
}

}  // namespace rotordrop
