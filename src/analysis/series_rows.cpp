#include "analysis/series_rows.h"

#include <algorithm>

namespace rotordrop {

ScheduledRows::ScheduledRows(const char* name, const Machine& machine, RowSchedule schedule,
                             const GrowthHistory* growth_in_force)
    : machine_(machine), schedule_(std::move(schedule)), name_(name), state_(machine.layout().size()) {
  found_.growth_in_force = growth_in_force;
}

void ScheduledRows::step(const Step& step) {
  while (schedule_.due() < step.time && !is_same_time(schedule_.due(), step.time)) {
    const double t = schedule_.due();
    step.interpolate(t, state_);
    write(t, state_);
  }
  if (!step.is_observed) return;
  schedule_.follow(step.time, step.found->step);
  if (wants_before_change() && schedule_.is_awoken(step.start)) write(step.start, step.before);
  if (is_same_time(schedule_.due(), step.time) || step.is_last) write_end(step);
}

void ScheduledRows::give(double t, std::span<const double> row) {
  for (RowSink* sink : sinks_) sink->row(t, row);
  schedule_.written(t);
}

SeriesRows::SeriesRows(const Machine& machine, RowSchedule schedule, const GrowthHistory* growth_in_force)
    : ScheduledRows("rows", machine, std::move(schedule), growth_in_force),
      n_step_(observed_size(machine.step_observables())),
      row_(n_step_ + observed_size(machine.state_observables())) {
  found_.wants_step = true;
}

void SeriesRows::write(double t, std::span<const double> y) {
  machine_.evaluate(t, y, found_);
  write(y, found_);
}

void SeriesRows::write(std::span<const double> y, const Evaluation& found) {
  std::copy(found.step.begin(), found.step.end(), row_.begin());
  machine_.observe_state(y, found, std::span(row_).subspan(n_step_));
  give(found.time, row_);
}

DetailRows::DetailRows(const Machine& machine, RowSchedule schedule, const GrowthHistory* growth_in_force)
    : ScheduledRows("detail rows", machine, std::move(schedule), growth_in_force) {
  found_.wants_details = true;
}

void DetailRows::write(double t, std::span<const double> y) {
  machine_.evaluate(t, y, found_);
  give(t, found_.details);
}

void DetailRows::write_end(const Step& step) {
  if (step.found->details.empty()) return write(step.time, step.after);
  give(step.time, step.found->details);  // somebody else wants them, too
}

}  // namespace rotordrop
