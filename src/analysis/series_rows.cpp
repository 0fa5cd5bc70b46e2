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
  if (!step.is_observed) return;
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

SeriesRows::SeriesRows(const Machine& machine, RowSchedule schedule, const GrowthHistory* growth_in_force)
    : ScheduledRows("rows", machine, std::move(schedule), growth_in_force),
      evaluates_in_lanes_(evaluates_in_lanes(machine)),
      n_step_(observed_size(machine.step_observables())),
      row_(n_step_ + observed_size(machine.state_observables())) {
  found_.wants_step = true;
  ahead_.step.resize(n_step_);
  ahead_.is_whole = false;
}

void SeriesRows::settle() {
  if (!lanes_) return;
  lanes_->evaluate([this](double t, std::span<const double> y, const Evaluation& found) {
    fill(y, found);
    tell(t, row_);
  });
}

void SeriesRows::fill(std::span<const double> y, const Evaluation& found) {
  std::copy(found.step.begin(), found.step.end(), row_.begin());
  machine_.observe_state(y, found, std::span(row_).subspan(n_step_));
}

bool SeriesRows::are_read() const { return is_needed(RowNeeds::all) || is_needed(RowNeeds::step); }

double SeriesRows::due_ahead() const { return are_read() ? due() : std::numeric_limits<double>::infinity(); }

void SeriesRows::write(double t, std::span<const double> y) {
  if (!needs_state(t)) return give(t, row_, false);
  if (t == ahead_time_) return write(t, y, ahead_);
  if (evaluates_in_lanes_ && !is_thinned_) {
    if (!lanes_) lanes_ = std::make_unique<RowLanes>(machine_);
    lanes_->add(t, y);
    schedule_.written(t);
    if (lanes_->is_full()) settle();
    return;
  }
  machine_.evaluate(t, y, found_);
  write(t, y, found_);
}

void SeriesRows::write(double t, std::span<const double> y, const Evaluation& found) {
  std::copy(found.step.begin(), found.step.end(), row_.begin());
  const bool is_whole = !is_thinned_ || is_needed(RowNeeds::all) || t >= watched_ + watch_interval;
  if (is_whole) {
    if (!found.is_whole) machine_.evaluate(t, y, found_);
    machine_.observe_state(y, found.is_whole ? found : found_, std::span(row_).subspan(n_step_));
    watched_ = t;
  } else {
    machine_.observe_held(y, std::span(row_).subspan(n_step_));
  }
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
