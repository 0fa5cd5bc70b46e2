#include "analysis/series_rows.h"

#include <algorithm>

namespace rotordrop {

SeriesRows::SeriesRows(const Machine& machine, RowSchedule schedule, const GrowthHistory* growth_in_force)
    : machine_(machine),
      schedule_(std::move(schedule)),
      n_step_(observed_size(machine.step_observables())),
      state_(machine.layout().size()),
      row_(n_step_ + observed_size(machine.state_observables())) {
  found_.wants_step = true;
  found_.growth_in_force = growth_in_force;
}

void SeriesRows::step(const Step& step) {
  while (schedule_.due() < step.time && !is_same_time(schedule_.due(), step.time)) {
    const double t = schedule_.due();
    step.interpolate(t, state_);
    write(t, state_);
  }
  if (!step.is_observed) return;
  schedule_.follow(step.time, step.found->step);
  // At the beginning of a step that brought a change after a long interval without any.
  if (schedule_.is_awoken(step.start)) write(step.start, step.before);
  if (is_same_time(schedule_.due(), step.time) || step.is_last) write(step.after, *step.found);
}

void SeriesRows::write(double t, std::span<const double> y) {
  machine_.evaluate(t, y, found_);
  write(y, found_);
}

void SeriesRows::write(std::span<const double> y, const Evaluation& found) {
  std::copy(found.step.begin(), found.step.end(), row_.begin());
  machine_.observe_state(y, found, std::span(row_).subspan(n_step_));
  for (RowSink* sink : sinks_) sink->row(found.time, row_);
  schedule_.written(found.time);
}

DetailRows::DetailRows(const Machine& machine, RowSchedule schedule, const GrowthHistory* growth_in_force)
    : machine_(machine), schedule_(std::move(schedule)), state_(machine.layout().size()) {
  found_.wants_details = true;
  found_.growth_in_force = growth_in_force;
}

void DetailRows::step(const Step& step) {
  while (schedule_.due() < step.time && !is_same_time(schedule_.due(), step.time)) {
    const double t = schedule_.due();
    step.interpolate(t, state_);
    write(t, state_);
  }
  if (!step.is_observed) return;
  schedule_.follow(step.time, step.found->step);
  if (is_same_time(schedule_.due(), step.time) || step.is_last) write(step.time, step.after);
}

void DetailRows::write(double t, std::span<const double> y) {
  machine_.evaluate(t, y, found_);
  for (RowSink* sink : sinks_) sink->row(t, found_.details);
  schedule_.written(t);
}

}  // namespace rotordrop
