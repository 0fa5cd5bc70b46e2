#pragma once
#include <cstddef>
#include <optional>
#include <vector>

// Recorded quantities over time, and what two of them differ by.
namespace rotordrop {

/// Samples of a quantity, straight lines between them.
struct TimeSeries {
  std::vector<double> times;   ///< [s], rising
  std::vector<double> values;  ///< of the same length

  [[nodiscard]] bool empty() const { return times.empty(); }
  /// Before the first sample the first value, after the last one the last. @throws std::invalid_argument without samples
  [[nodiscard]] double at(double time) const;
};

/// Difference up to which two quantities agree at an instant: a part of the larger of their rises then, and at least a floor. It depends on what has
/// happened until then alone, so a longer run does not change what is said of its beginning.
struct Tolerance {
  double floor = 0;  ///< in the quantity's unit
  double part = 0;   ///< of the rise [1]
  double zero = 0;   ///< where rises count from, in the quantity's unit
  [[nodiscard]] double at(double first, double second) const;
};

/// Difference of two quantities over the time that both cover.
struct Difference {
  TimeSeries series;             ///< second - first
  std::vector<double> allowed;   ///< tolerance at each sample of it
  double largest = 0;            ///< of the largest magnitude, with its sign
  double largest_time = 0;       ///< [s]
  double time_beyond = 0;        ///< how long it is larger, altogether [s]
  std::optional<double> beyond;  ///< from when it first is [s]; none: never
  std::optional<double> within;  ///< from when it stays within to the end [s]; none: it ends beyond

  /// The sample until a time [s] that is farthest from what is allowed (or nearest to it).
  struct Worst {
    double difference = 0, time = 0;
    double usage = 0;  ///< magnitude over what is allowed then; above 1: beyond
  };
  [[nodiscard]] Worst worst_until(double time) const;
};

/// second - first at the times of the one with fewer samples there, so that lines are drawn through the finer one only. Crossings of the tolerance
/// are found on the straight lines between these times.
/// @throws std::invalid_argument if they have no time in common
Difference difference_of(const TimeSeries& first, const TimeSeries& second, const Tolerance& tolerance);

/// Largest value; the earliest one if there are several. @throws std::invalid_argument without samples
struct Extreme {
  double value = 0, time = 0;
};
Extreme largest_of(const TimeSeries& series);
/// Samples with `from` <= time <= `to`; none if there are none.
std::optional<Extreme> largest_of(const TimeSeries& series, double from, double to);

/// First time after `from` at which the series passes zero upwards (or downwards), on the straight line between samples.
std::optional<double> first_crossing(const TimeSeries& series, bool upwards, double from);

/// Integral from the first sample on, by the trapezoid rule.
TimeSeries integral_of(const TimeSeries& series);

}  // namespace rotordrop
