#include "study/report/spectrum.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace rotordrop {
namespace {

constexpr std::size_t fewest_samples = 128, padding = 4;
constexpr std::size_t usual_segments = 60, most_segments = 600;  ///< the latter take some tenths of a second
constexpr double longest_segment = 0.25;                         ///< [s]

/// Values at evenly spaced times, linear between rows. @param first  sample, counted from the series' start
std::vector<double> sampled(const TimeSeries& s, double interval, std::size_t first, std::size_t n) {
  std::vector<double> values;
  values.reserve(n);
  std::size_t row = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double t = s.times.front() + static_cast<double>(first + k) * interval;
    if (k == 0) row = static_cast<std::size_t>(std::upper_bound(s.times.begin(), s.times.end(), t) - s.times.begin());
    while (row < s.times.size() && s.times[row] <= t) ++row;
    if (row == s.times.size()) {
      values.push_back(s.values.back());
      continue;
    }
    const double t1 = s.times[row - 1], part = (t - t1) / (s.times[row] - t1);
    values.push_back(s.values[row - 1] + part * (s.values[row] - s.values[row - 1]));
  }
  return values;
}

void take_mean_away(std::vector<double>& values) {
  double sum = 0.;
  for (const double v : values) sum += v;
  for (double& v : values) v -= sum / static_cast<double>(values.size());
}

/// Evenly spaced segments: an eighth of their length apart if these are few enough, otherwise half of it, as far as they may be many.
std::size_t segments_in(std::size_t n, std::size_t length) {
  const std::size_t dense = std::max((n - length) / (length / 8) + 1, n > length ? 2ul : 1ul);
  const std::size_t half = (n - length + length / 2 - 1) / (length / 2) + 1;
  return std::min({dense, std::max(usual_segments, half), most_segments});
}

/// Largest distance between rows that lie, in part or whole, between two times [s].
double largest_distance(const std::vector<double>& times, double from, double to) {
  auto next = std::upper_bound(times.begin(), times.end(), from);
  if (next == times.begin()) ++next;
  double largest = 0.;
  for (; next != times.end(); ++next) {
    largest = std::max(largest, *next - *(next - 1));
    if (*next >= to) break;
  }
  return largest;
}

/// Parts of a drop between segments. @param begins  [n_segments] [s], rising
std::vector<std::array<double, 2>> gaps_between(const std::vector<double>& begins, double length, double start,
                                                double end, double tolerance) {
  std::vector<std::array<double, 2>> gaps;
  double covered = start;
  const auto gap_until = [&](double time) {
    if (time > covered + tolerance) gaps.push_back({covered, time});
  };
  for (const double begin : begins) {
    gap_until(begin);
    covered = begin + length;
  }
  gap_until(end);
  return gaps;
}

}  // namespace

std::vector<double> Waterfall::largest() const {
  std::vector<double> result(frequencies.size(), 0.);
  for (const auto& one : amplitude)
    for (std::size_t k = 0; k < one.size(); ++k) result[k] = std::max(result[k], one[k]);
  return result;
}

std::vector<double> Waterfall::mean() const {
  std::vector<double> result(frequencies.size(), 0.);
  for (const auto& one : amplitude)
    for (std::size_t k = 0; k < one.size(); ++k) result[k] += one[k] * one[k];
  for (double& v : result) v = std::sqrt(v / static_cast<double>(std::max<std::size_t>(amplitude.size(), 1)));
  return result;
}

Waterfall waterfall(const TimeSeries& y, const TimeSeries* z, double interval, double largest_frequency) {
  Waterfall result;
  result.interval = interval;
  const double span = y.times.back() - y.times.front();
  const auto n = static_cast<std::size_t>(std::floor(span / interval * (1. + 1e-9))) + 1;
  if (n < fewest_samples) return result;
  const std::size_t length =
      std::max(fewest_samples,
               std::bit_floor(std::min(n / 3, static_cast<std::size_t>(std::round(longest_segment / interval)))));
  result.segment = static_cast<double>(length) * interval;

  // Periodic Hann window.
  std::vector<double> window(length);
  double sum = 0.;
  for (std::size_t k = 0; k < length; ++k) {
    window[k] = 0.5 - 0.5 * std::cos(2. * std::numbers::pi * static_cast<double>(k) / static_cast<double>(length));
    sum += window[k];
  }

  const std::size_t n_points = padding * length;
  const double step = 1. / (static_cast<double>(n_points) * interval);
  const auto highest =
      std::min(static_cast<std::size_t>(std::floor(largest_frequency / step * (1. + 1e-9))), n_points / 2 - 1);
  const bool is_two_sided = z != nullptr;
  const auto n_below = is_two_sided ? static_cast<std::ptrdiff_t>(highest) : 0;
  for (std::ptrdiff_t k = -n_below; k <= static_cast<std::ptrdiff_t>(highest); ++k)
    result.frequencies.push_back(static_cast<double>(k) * step);

  result.longest_allowed = std::max(interval, 0.5 / largest_frequency);
  const std::size_t n_places = segments_in(n, length);
  std::vector<double> begins;
  Eigen::FFT<double> fft;
  std::vector<std::complex<double>> signal(n_points), transformed;
  for (std::size_t i = 0; i < n_places; ++i) {
    const std::size_t first = n_places == 1 ? 0 : (n - length) * i / (n_places - 1);
    const double begin = y.times.front() + static_cast<double>(first) * interval;
    const double last = begin + (static_cast<double>(length) - 1.) * interval;
    const double distance = largest_distance(y.times, begin + 1e-3 * interval, last - 1e-3 * interval);
    result.place_times.push_back(begin + 0.5 * result.segment);
    if (distance > (1. + 1e-3) * result.longest_allowed) continue;
    result.row_distance = std::max(result.row_distance, distance);
    begins.push_back(begin);
    result.places.push_back(i);
    auto real = sampled(y, interval, first, length);
    auto imaginary = is_two_sided ? sampled(*z, interval, first, length) : std::vector<double>(length, 0.);
    take_mean_away(real);
    take_mean_away(imaginary);
    for (std::size_t k = 0; k < length; ++k) signal[k] = window[k] * std::complex(real[k], imaginary[k]);
    fft.fwd(transformed, signal);
    std::vector<double>& amplitude = result.amplitude.emplace_back();
    for (std::ptrdiff_t k = -n_below; k <= static_cast<std::ptrdiff_t>(highest); ++k) {
      const auto at = static_cast<std::size_t>(k < 0 ? k + static_cast<std::ptrdiff_t>(n_points) : k);
      amplitude.push_back((is_two_sided || k == 0 ? 1. : 2.) * std::abs(transformed[at]) / sum);
    }
    result.times.push_back(result.place_times.back());
  }
  result.uncovered = gaps_between(begins, result.segment, y.times.front(), y.times.back(), 2. * interval);
  return result;
}

}  // namespace rotordrop
