#include "analysis/drop.h"

#include <algorithm>

namespace rotordrop {
namespace {

RowSchedule schedule(const Machine& machine, const RunParameters& run, const OutputParameters& output,
                     double interval) {
  const double longest = output.longest_interval.value_or(std::max(output.interval, run.latest_end() / 20000.));
  // Details keep their ratio to the other rows.
  return {interval, longest * interval / output.interval, output.change, watched_columns(machine.step_observables())};
}

}  // namespace

Drop::Drop(const Machine& machine, const MachineParameters& p, const IntegrationParameters& integration,
           const OutputParameters& output, FiniteElements* elements, const FitWatch::Tell& tell)
    : sections_(make_section_coupling(machine, p.thermal, elements, schedule(machine, p.run, output, output.interval))),
      rows_(machine, schedule(machine, p.run, output, output.interval), sections_->growth_in_force()),
      detail_rows_(machine, schedule(machine, p.run, output, output.detail_interval), sections_->growth_in_force()),
      scalars_(machine),
      fatigue_(machine, p),
      impulse_(make_contact_impulse(machine, scalars_, p.run)),
      kelvin_(machine.state_observables(), observed_size(machine.step_observables())),
      guards_(machine, p, integration),
      closed_fits_(machine.state_observables(), observed_size(machine.step_observables()), false, tell),
      followed_fits_(sections_->observables(), 0, true, tell),
      loop_(machine, integration, p.run, sections_->growth_in_force()),
      machine_(machine),
      parameters_(p),
      elements_(elements) {
  rows_.add(closed_fits_, RowNeeds::now_and_then);
  rows_.add(kelvin_, RowNeeds::now_and_then);
  rows_.add(guards_.rows(), RowNeeds::now_and_then);
  sections_->watch(followed_fits_);
  if (const auto own = sections_->observables(); !own.empty()) sections_->watch(guards_.windows(own));
  loop_.add(rows_);
  if (!machine.detail_observables().empty()) loop_.add(detail_rows_);
  loop_.add(scalars_);
  loop_.add(fatigue_);
  loop_.add(guards_);
  loop_.add(*impulse_);
  loop_.add(*sections_);
}

void Drop::run(const std::function<bool()>& is_stopped) {
  loop_.run(is_stopped);
  finish();
}

void Drop::finish() {
  rows_.settle();
  is_complete_ = loop_.is_at_end();
  if (is_complete_) sections_->finish(loop_.time(), loop_.state());
}

DropResult Drop::result() const {
  DropResult result;
  result.completed = is_complete_;
  result.condition_met = loop_.condition_is_met();
  result.end_time = loop_.time();
  result.statistics = loop_.statistics();
  result.state.assign(loop_.state().begin(), loop_.state().end());
  result.impulse_before_end = impulse_->before();
  result.averaging_start = impulse_->start();
  if (const auto windows = sections_->windows()) {
    result.windows = windows->report;
    result.windows_energy = windows->energy;
  }
  if (const auto* growth = sections_->growth_in_force()) result.growth_in_force = *growth;
  for (std::size_t i = 0; i < scalars_.size(); ++i) result.fatigue.push_back(fatigue_.of(scalars_.name(i)));
  result.warnings = guards_.found(scalars_);
  const EndedRun ended{parameters_,           machine_,         scalars_,
                       result.end_time,       result.completed, result.windows ? &*result.windows : nullptr,
                       result.windows_energy, elements_};
  for (auto& warning : warnings_at_end(ended)) result.warnings.push_back(std::move(warning));
  return result;
}

}  // namespace rotordrop
