#include "study/rub/impact.h"

#include <fmt/format.h>

#include <cmath>

namespace rotordrop {

Impact first_impact(const RecordedDrop& drop, const std::string& bearing) {
  const TimeSeries penetration = drop.series("/bearings/" + bearing + "/penetration");
  Impact impact;
  const double begin = penetration.times.front();
  const auto start = penetration.values.front() > 0. ? begin : first_crossing(penetration, true, begin);
  if (!start) return impact;
  impact.start = *start;
  impact.end = first_crossing(penetration, false, *start).value_or(penetration.times.back());
  if (const auto peak = largest_of(drop.series("/bearings/" + bearing + "/contact_force"), impact.start, impact.end)) {
    impact.peak = peak->value;
    impact.peak_time = peak->time;
  }
  return impact;
}

std::vector<Instant> instants_of(const Impact& impact, double end, const std::vector<double>& more) {
  std::vector<Instant> list;
  if (std::isfinite(impact.peak_time)) list.push_back({"first impact's peak", impact.peak_time});
  for (const double t : more)
    if (t < end) list.push_back({fmt::format("{:.6g} ms", t * 1e3), t});
  list.push_back({"end", end});
  return list;
}

}  // namespace rotordrop
