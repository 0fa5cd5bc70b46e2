#include "study/time_series.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace rotordrop {
namespace {

/// Part of a straight line, as fractions of its length.
struct Part {
  double from, to;
};
/// Calls take(part) for each part of a line from a to b on which its magnitude exceeds a tolerance that goes from p to q.
template <class Take>
void for_each_part_beyond(double a, double b, double p, double q, const Take& take) {
  if (std::fabs(a) <= p && std::fabs(b) <= q) return;  // so is the line between
  std::array<double, 4> cuts = {0.};
  std::size_t n = 1;
  for (const double sign : {-1., 1.}) {
    const double before = a - sign * p, after = b - sign * q;
    if (before * after < 0.) cuts[n++] = before / (before - after);
  }
  cuts[n++] = 1.;
  if (n == cuts.size() && cuts[1] > cuts[2]) std::swap(cuts[1], cuts[2]);
  for (std::size_t i = 1; i < n; ++i) {
    const double middle = 0.5 * (cuts[i - 1] + cuts[i]);
    if (std::fabs(a + middle * (b - a)) > p + middle * (q - p)) take(Part{cuts[i - 1], cuts[i]});
  }
}

std::size_t samples_within(const TimeSeries& s, double from, double to) {
  return static_cast<std::size_t>(std::upper_bound(s.times.begin(), s.times.end(), to) -
                                  std::lower_bound(s.times.begin(), s.times.end(), from));
}

/// A value at or between samples. @param after  first sample later than the time
double value_between(const TimeSeries& s, std::size_t after, double time) {
  if (after == 0) return s.values.front();
  if (after == s.times.size()) return s.values.back();
  const double part = (time - s.times[after - 1]) / (s.times[after] - s.times[after - 1]);
  // At a sample its very value.
  return part == 0. ? s.values[after - 1] : s.values[after - 1] + part * (s.values[after] - s.values[after - 1]);
}

/// TimeSeries::at() for times that rise, without a search for each.
class Following {
 public:
  explicit Following(const TimeSeries& series) : series_(series) {}
  double at(double time) {
    while (after_ < series_.times.size() && series_.times[after_] <= time) ++after_;
    return value_between(series_, after_, time);
  }

 private:
  const TimeSeries& series_;
  std::size_t after_ = 0;
};

TimeSeries subtract(const TimeSeries& first, const TimeSeries& second) {
  if (first.empty() || second.empty()) throw std::invalid_argument("a series without samples");
  const double from = std::max(first.times.front(), second.times.front()),
               to = std::min(first.times.back(), second.times.back());
  const bool take_second = samples_within(second, from, to) < samples_within(first, from, to);
  const std::vector<double>& times = take_second ? second.times : first.times;
  TimeSeries result;
  result.times.reserve(times.size());
  result.values.reserve(times.size());
  Following of_first(first), of_second(second);
  for (const double t : times) {
    if (t < from || t > to) continue;
    result.times.push_back(t);
    result.values.push_back(of_second.at(t) - of_first.at(t));
  }
  if (result.empty()) throw std::invalid_argument("two series without a time in common");
  return result;
}

}  // namespace

double TimeSeries::at(double time) const {
  if (empty()) throw std::invalid_argument("a series without samples");
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  return value_between(*this, static_cast<std::size_t>(after - times.begin()), time);
}

double Tolerance::at(double first, double second) const {
  return std::max(floor, part * std::max(std::fabs(first - zero), std::fabs(second - zero)));
}

Difference difference_of(const TimeSeries& first, const TimeSeries& second, const Tolerance& tolerance) {
  Difference d;
  d.series = subtract(first, second);
  const std::vector<double>&t = d.series.times, &v = d.series.values;
  Following of_first(first), of_second(second);
  d.allowed.reserve(t.size());
  for (const double time : t) d.allowed.push_back(tolerance.at(of_first.at(time), of_second.at(time)));
  for (std::size_t i = 0; i < v.size(); ++i)
    if (i == 0 || std::fabs(v[i]) > std::fabs(d.largest)) {
      d.largest = v[i];
      d.largest_time = t[i];
    }
  d.within = t.front();
  if (std::fabs(v.front()) > d.allowed.front()) d.beyond = t.front();
  for (std::size_t i = 1; i < v.size(); ++i)
    for_each_part_beyond(v[i - 1], v[i], d.allowed[i - 1], d.allowed[i], [&](const Part& part) {
      const double step = t[i] - t[i - 1];
      if (!d.beyond) d.beyond = t[i - 1] + part.from * step;
      d.within = t[i - 1] + part.to * step;
      d.time_beyond += (part.to - part.from) * step;
    });
  if (std::fabs(v.back()) > d.allowed.back()) d.within.reset();
  return d;
}

Difference::Worst Difference::worst_until(double time) const {
  Worst worst;
  for (std::size_t i = 0; i < series.times.size() && series.times[i] <= time; ++i) {
    const double size = std::fabs(series.values[i]), usage = size > 0. ? size / allowed[i] : 0.;
    if (i == 0 || usage > worst.usage) worst = {series.values[i], series.times[i], usage};
  }
  return worst;
}

Extreme largest_of(const TimeSeries& s) {
  if (s.empty()) throw std::invalid_argument("a series without samples");
  return *largest_of(s, s.times.front(), s.times.back());
}

std::optional<Extreme> largest_of(const TimeSeries& s, double from, double to) {
  std::optional<Extreme> found;
  for (std::size_t i = 0; i < s.times.size(); ++i)
    if (s.times[i] >= from && s.times[i] <= to && (!found || s.values[i] > found->value))
      found = {s.values[i], s.times[i]};
  return found;
}

std::optional<double> first_crossing(const TimeSeries& s, bool upwards, double from) {
  const double sign = upwards ? 1. : -1.;
  for (std::size_t i = 1; i < s.times.size(); ++i) {
    const double a = sign * s.values[i - 1], b = sign * s.values[i];
    if (s.times[i] <= from || !(a <= 0. && b > 0.)) continue;
    const double t = s.times[i - 1] - a / (b - a) * (s.times[i] - s.times[i - 1]);
    if (t > from) return t;
  }
  return {};
}

TimeSeries integral_of(const TimeSeries& s) {
  TimeSeries sum{s.times, std::vector<double>(s.times.size(), 0.)};
  for (std::size_t i = 1; i < s.times.size(); ++i)
    sum.values[i] = sum.values[i - 1] + 0.5 * (s.values[i - 1] + s.values[i]) * (s.times[i] - s.times[i - 1]);
  return sum;
}

}  // namespace rotordrop
