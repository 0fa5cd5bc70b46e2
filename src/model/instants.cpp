#include "model/instants.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace rotordrop {
namespace {

bool are_one(double a, double b) { return b - a <= 1e-13 + 1e-15 * b; }

}  // namespace

Instants::Instants(std::span<const double> times, double end) : end_(end) {
  std::vector<double> sorted;
  std::copy_if(times.begin(), times.end(), std::back_inserter(sorted), [end](double t) { return t > 0. && t <= end; });
  std::sort(sorted.begin(), sorted.end());
  for (const double t : sorted) {
    if (!instants_.empty() && are_one(instants_.back().time, t))
      instants_.back().time = t;
    else
      instants_.push_back({t, t});
  }
  // A step of rounding would be left to the end.
  if (!instants_.empty() && are_one(instants_.back().time, end)) instants_.back().time = end;
}

double Instants::next(double t) const {
  const auto after = std::upper_bound(instants_.begin(), instants_.end(), t,
                                      [](double time, const Instant& one) { return time < one.time; });
  return after == instants_.end() ? end_ : after->time;
}

double Instants::last(double t) const {
  const auto after = std::upper_bound(instants_.begin(), instants_.end(), t,
                                      [](double time, const Instant& one) { return time < one.time; });
  return after == instants_.begin() ? 0. : (after - 1)->time;
}

bool Instants::contains(double t) const { return !instants_.empty() && last(t) == t && t > 0.; }

double Instants::before(double t) const {
  const auto found = std::lower_bound(instants_.begin(), instants_.end(), t,
                                      [](const Instant& one, double time) { return one.time < time; });
  return found == instants_.end() || found->time != t ? t : std::nextafter(found->first, 0.);
}

double Instants::latest(double t) const { return contains(t) ? before(t) : std::numeric_limits<double>::infinity(); }

}  // namespace rotordrop
