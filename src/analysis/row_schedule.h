#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "model/observable.h"

namespace rotordrop {

/// Columns of a row of step observables whose changes call for rows: contact forces, orbits and ring speeds of touchdown bearings; of a
/// machine without any, all.
std::vector<std::size_t> watched_columns(const std::vector<Observable>& step_observables);

/// When rows of a series are due: at every multiple of an interval while something changes, after a longest interval otherwise.
///
/// A watched quantity has changed if it differs from its value at the last row by more than `change` times the largest magnitude it has had. So
/// straight lines between rows miss at most that part of it, plus what happens within one interval.
class RowSchedule {
 public:
  /// @param longest  without changes [s]; rounded to whole intervals; `interval` or less: rows are evenly spaced
  RowSchedule(double interval, double longest, double change, std::vector<std::size_t> watched);

  /// Time of the next row as far as is known now [s]: a multiple of the interval that was not passed yet.
  [[nodiscard]] double due() const;
  /// An observed step. @param step values of the machine's step observables at t
  void follow(double t, std::span<const double> step);
  /// Whether the last step brought the first change since the last row, which lies more than an interval before `before`: a row at `before`, the
  /// beginning of that step, then keeps the line straight up to the change.
  [[nodiscard]] bool is_awoken(double before) const;
  /// A row was written at t.
  void written(double t);
  /// Multiples up to t, that one included, are passed.
  void pass(double t);
  /// For checkpoints: all that decides about later rows.
  [[nodiscard]] std::vector<double> packed() const;
  /// @throws std::invalid_argument if the values are not those of such a schedule
  void unpack(std::span<const double> values);

 private:
  [[nodiscard]] double time_of(std::size_t index) const { return static_cast<double>(index) * interval_; }

  double interval_, change_;
  std::size_t stride_;
  std::vector<std::size_t> watched_;
  std::size_t next_ = 0;  // first multiple not passed
  double last_row_ = 0;   // [s]
  double followed_ = 0;   // time of the last step [s]
  bool has_rows_ = false, is_changed_ = false, is_first_change_ = false;
  std::vector<double> latest_, reference_, largest_;  // of each watched column
};

/// Times this close are the same: a row's time and a step's end.
[[nodiscard]] bool is_same_time(double a, double b);

}  // namespace rotordrop
