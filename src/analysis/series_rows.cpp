#include "analysis/series_rows.h"

#include <algorithm>
#include <limits>

#include "machine/lanes/machine_lanes.h"

namespace rotordrop {

ScheduledRows::ScheduledRows(const char* name, const Machine& machine, RowSchedule schedule,
                             const GrowthHistory* growth_in_force)
    : machine_(machine), schedule_(std::move(schedule)), name_(name), state_(machine.layout().size()) {
  found_.growth_in_force = growth_in_force;
}

void ScheduledRows::step(const Step& step) {
  while (schedule_.due() < step.time && !is_same_time(schedule_.due(), step.time)) {
    const double t = schedule_.due();
    write(t, needs_state(t) ? state_at(step, t) : state_);
  }
  if (!step.is_observed) {
    // Whether it would be was asked while a row within it was due first.
    if (is_same_time(schedule_.due(), step.time)) write(step.time, state_at(step, step.time));
    return;
  }
  schedule_.follow(step.time, step.found->step);
  if (wants_before_change() && schedule_.is_awoken(step.start)) write(step.start, state_at(step, step.start));
  if (is_same_time(schedule_.due(), step.time) || step.is_last) write_end(step);
}

bool ScheduledRows::is_needed(RowNeeds needs) const {
  return std::any_of(sinks_.begin(), sinks_.end(), [needs](const Reader& reader) { return reader.needs == needs; });
}

void ScheduledRows::tell(double t, std::span<const double> row, bool is_whole) {
  for (const auto& [sink, needs] : sinks_)
    if (is_whole || needs == RowNeeds::step) sink->row(t, row);
}

void ScheduledRows::tell(const RowTile& rows, std::span<double> row) {
  std::size_t n = 0;
  const auto tell_takers_of_tiles = [&] {
    for (const auto& reader : sinks_)
      if (n > 0 && reader.sink->takes_tiles()) reader.sink->rows(rows.part(0, n));
  };
  try {
    for (; n < rows.n_rows(); ++n) {
      rows.copy_row(n, row);
      for (const auto& reader : sinks_)
        if (!reader.sink->takes_tiles()) reader.sink->row(rows.times[n], row);
    }
  } catch (...) {  // the rows before the one that somebody refuses are sound
    tell_takers_of_tiles();
    throw;
  }
  tell_takers_of_tiles();
}

SeriesRows::SeriesRows(const Machine& machine, RowSchedule schedule, const GrowthHistory* growth_in_force)
    : ScheduledRows("rows", machine, std::move(schedule), growth_in_force),
      evaluates_in_lanes_(evaluates_in_lanes(machine)),
      n_step_(observed_size(machine.step_observables())),
      row_(n_step_ + observed_size(machine.state_observables())) {
  found_.wants_step = true;
}

void SeriesRows::settle() {
  if (!lanes_) return;
  const std::span is_whole(whole_.data(), lanes_->n_added());
  const auto n_whole = std::count(is_whole.begin(), is_whole.end(), true);
  const RowTile rows = lanes_->evaluate(n_whole > 0);
  if (static_cast<std::size_t>(n_whole) == rows.n_rows()) return tell(rows, row_);
  for (std::size_t i = 0; i < rows.n_rows(); ++i) {
    rows.copy_row(i, row_);
    tell(rows.times[i], row_, is_whole[i]);
  }
}

void SeriesRows::fill(std::span<const double> y, const Evaluation& found, bool is_whole) {
  std::copy(found.step.begin(), found.step.end(), row_.begin());
  const auto of_state = std::span(row_).subspan(n_step_);
  if (is_whole)
    machine_.observe_state(y, found, of_state);
  else
    machine_.observe_held(y, of_state);
}

bool SeriesRows::are_read() const { return is_needed(RowNeeds::all) || is_needed(RowNeeds::step); }

double SeriesRows::due_ahead() const { return are_read() ? due() : std::numeric_limits<double>::infinity(); }

void SeriesRows::write(double t, std::span<const double> y) {
  if (!needs_state(t)) return give(t, row_, false);
  if (evaluates_in_lanes_) {
    if (!lanes_) lanes_ = std::make_unique<RowLanes>(machine_);
    const bool is_whole = has_to_be_whole(t);
    if (is_whole) watched_ = t;
    whole_[lanes_->n_added()] = is_whole;
    lanes_->add(t, y);
    schedule_.written(t);
    if (lanes_->is_full()) settle();
    return;
  }
  machine_.evaluate(t, y, found_);
  write(t, y, found_);
}

void SeriesRows::write(double t, std::span<const double> y, const Evaluation& found) {
  const bool is_whole = has_to_be_whole(t);
  if (is_whole) watched_ = t;
  const bool lacks_inputs = is_whole && !found.is_whole;
  if (lacks_inputs) machine_.evaluate(t, y, found_);
  fill(y, lacks_inputs ? found_ : found, is_whole);
  give(t, row_, is_whole);
}

DetailRows::DetailRows(const Machine& machine, RowSchedule schedule, const GrowthHistory* growth_in_force)
    : ScheduledRows("detail rows", machine, std::move(schedule), growth_in_force) {
  found_.wants_details = true;
}

void DetailRows::write(double t, std::span<const double> y) {
  if (has_sinks()) machine_.evaluate(t, y, found_);
  give(t, found_.details);
}

void DetailRows::write_end(const Step& step) {
  if (step.found->details.empty()) return write(step.time, step.after);
  give(step.time, step.found->details);  // somebody else wants them, too
}

}  // namespace rotordrop
