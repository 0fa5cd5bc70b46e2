#pragma once
// A circumference cut into cells, and what a moving band leaves in each.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace rotordrop {

/// Divides what a band gives off evenly over its length 2 b while its middle goes evenly from one angle to the other [rad]; any number of turns.
/// Length of a cell under the band, summed over the way:
///   integral of [r(c1 - p + b) - r(c0 - p + b) - r(c1 - p - b) + r(c0 - p - b)] dp,  r(x) = max(x, 0), whose integral is r^2/2.
/// @param half_angle  b over the radius [rad], > 0; a band that reaches round covers all
/// @param give        called with a cell's index and its share; the shares' sum is 1. A cell may be called more than once.
template <class Give>
void spread_over_cells(std::size_t n_cells, double from, double to, double half_angle, Give&& give) {
  using std::numbers::pi;
  const double cell_angle = 2. * pi / static_cast<double>(n_cells), b = std::min(half_angle, pi);
  const double low = std::min(from, to), high = std::max(from, to), way = high - low, middle = 0.5 * (low + high);
  const bool rests = way < 1e-7 * b;
  const auto ramp = [&](double x) {
    if (rests) return std::max(x - middle, 0.);
    const double at_low = std::max(x - low, 0.), at_high = std::max(x - high, 0.);
    // (at_low^2 - at_high^2)/(2 way), without the difference of squares where both are positive
    return at_high > 0. ? 0.5 * (at_low + at_high) : 0.5 * at_low * at_low / way;
  };
  const auto covered = [&](double x) { return ramp(x + b) - ramp(x - b); };
  const auto first = static_cast<long>(std::floor((low - b) / cell_angle)),
             last = static_cast<long>(std::floor((high + b) / cell_angle));
  const auto count = static_cast<long>(n_cells);
  auto cell = static_cast<std::size_t>(((first % count) + count) % count);
  double before = 0.;
  for (long i = first; i <= last; ++i, cell = cell + 1 == n_cells ? 0 : cell + 1) {
    const double after = i == last ? 2. * b : covered(static_cast<double>(i + 1) * cell_angle);
    const double share = (after - before) / (2. * b);
    before = after;
    if (share > 0.) give(cell, share);
  }
}

}  // namespace rotordrop
