#include "study/rub/impact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rotordrop {
namespace {

/// Whether the journal comes nearer to the bearing's axis where a time falls between two rows.
bool moves_inward(const TimeSeries& y, const TimeSeries& z, double t) {
  const auto after = std::upper_bound(y.times.begin(), y.times.end(), t) - y.times.begin();
  const auto i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after, 1, std::ssize(y.times) - 1));
  return std::hypot(y.values[i], z.values[i]) < std::hypot(y.values[i - 1], z.values[i - 1]);
}

}  // namespace

Impact first_impact(const RecordedDrop& drop, const std::string& bearing, double until) {
  const TimeSeries penetration = drop.series("/bearings/" + bearing + "/penetration");
  Impact impact;
  const double begin = penetration.times.front(), last = std::min(penetration.times.back(), until);
  const auto start = penetration.values.front() > 0. ? begin : first_crossing(penetration, true, begin);
  if (!start || *start >= until) return impact;
  impact.start = *start;
  impact.end = last;
  const TimeSeries y = drop.series("/bearings/" + bearing + "/orbit", 0),
                   z = drop.series("/bearings/" + bearing + "/orbit", 1);
  for (auto closes = start; closes && *closes < last; closes = first_crossing(penetration, true, impact.end)) {
    impact.end = std::min(first_crossing(penetration, false, *closes).value_or(last), last);
    if (moves_inward(y, z, impact.end)) break;
  }
  if (const auto next = first_crossing(penetration, true, impact.end); next && *next < until) impact.next = *next;
  if (const auto peak = largest_of(drop.series("/bearings/" + bearing + "/contact_force"), impact.start, impact.end)) {
    impact.peak = peak->value;
    impact.peak_time = peak->time;
  }
  return impact;
}

std::vector<std::string> series_of_impact(const std::string& bearing) {
  const std::string at = "/bearings/" + bearing + "/";
  return {at + "penetration", at + "orbit", at + "contact_force"};
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
