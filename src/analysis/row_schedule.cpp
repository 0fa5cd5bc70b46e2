#include "analysis/row_schedule.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rotordrop {

bool is_same_time(double a, double b) { return std::fabs(a - b) <= 1e-9 * std::max(b, 1e-3); }

std::vector<std::size_t> watched_columns(const std::vector<Observable>& step_observables) {
  std::vector<std::size_t> touchdown, all;
  std::size_t at = 0;
  for (const auto& o : step_observables) {
    const bool is_watched = o.kind == Observed::contact_force || o.kind == Observed::orbit ||
                            o.kind == Observed::ring_speed || o.kind == Observed::shoulder_force ||
                            o.kind == Observed::axial_position;
    for (std::size_t k = 0; k < o.size; ++k, ++at) {
      all.push_back(at);
      if (is_watched) touchdown.push_back(at);
    }
  }
  return touchdown.empty() ? all : touchdown;
}

RowSchedule::RowSchedule(double interval, double longest, double change, std::vector<std::size_t> watched)
    : interval_(interval),
      change_(change),
      stride_(static_cast<std::size_t>(std::max(std::floor(longest / interval * (1. + 1e-9)), 1.))),
      watched_(std::move(watched)),
      latest_(watched_.size(), 0.),
      reference_(watched_.size(), 0.),
      largest_(watched_.size(), 0.) {}

double RowSchedule::due() const {
  if (stride_ == 1 || is_changed_ || !has_rows_) return time_of(next_);
  // From the multiple at or before the last row.
  const auto last = static_cast<std::size_t>(last_row_ / interval_ * (1. + 1e-9));
  return time_of(std::max(next_, last + stride_));
}

void RowSchedule::follow(double t, std::span<const double> step) {
  if (stride_ == 1) return;
  const bool was_changed = is_changed_;
  followed_ = t;
  for (std::size_t k = 0; k < watched_.size(); ++k) {
    latest_[k] = step[watched_[k]];
    largest_[k] = std::max(largest_[k], std::fabs(latest_[k]));
    // A value that is no number is a change, too.
    if (!(std::fabs(latest_[k] - reference_[k]) <= change_ * largest_[k])) is_changed_ = true;
  }
  is_first_change_ = is_changed_ && !was_changed;
  while (time_of(next_) < t && !is_same_time(time_of(next_), t)) ++next_;  // one at this very time may still be due
}

bool RowSchedule::is_awoken(double before) const { return is_first_change_ && before - last_row_ > interval_; }

void RowSchedule::written(double t) {
  last_row_ = t;
  has_rows_ = true;
  is_first_change_ = false;
  if (t < followed_) return;  // before the change, which the next multiple still has to show
  reference_ = latest_;
  is_changed_ = false;
  pass(t);
}

void RowSchedule::pass(double t) {
  while (time_of(next_) < t || is_same_time(time_of(next_), t)) ++next_;
}

std::vector<double> RowSchedule::packed() const {
  std::vector<double> values = {
      static_cast<double>(next_), last_row_, followed_, has_rows_ ? 1. : 0., is_changed_ ? 1. : 0.,
      is_first_change_ ? 1. : 0.};
  for (const auto* list : {&latest_, &reference_, &largest_}) values.insert(values.end(), list->begin(), list->end());
  return values;
}

void RowSchedule::unpack(std::span<const double> values) {
  // Neither the last row nor the last step lies beyond the first multiple that was not passed.
  const auto is_before_next = [&](double t) {
    const double next = values[0] * interval_;
    return t >= 0. && (t <= next || is_same_time(t, next));
  };
  if (values.size() != 6 + 3 * watched_.size() || !(values[0] >= 0. && values[0] < 1e15) ||
      !is_before_next(values[1]) || !is_before_next(values[2]))
    throw std::invalid_argument("a schedule of rows of another kind");
  next_ = static_cast<std::size_t>(values[0]);
  last_row_ = values[1];
  followed_ = values[2];
  has_rows_ = values[3] != 0.;
  is_changed_ = values[4] != 0.;
  is_first_change_ = values[5] != 0.;
  auto from = values.begin() + 6;
  for (auto* list : {&latest_, &reference_, &largest_}) {
    std::copy_n(from, list->size(), list->begin());
    from += static_cast<std::ptrdiff_t>(list->size());
  }
}

}  // namespace rotordrop
