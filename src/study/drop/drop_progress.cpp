#include "study/drop/drop_progress.h"

#include <cmath>
#include <limits>

namespace rotordrop {

DropProgress::DropProgress(const Machine& machine, const Drop& drop, const GrowthHistory* growth_in_force,
                           Report report)
    : machine_(machine),
      drop_(drop),
      report_(std::move(report)),
      observed_(observed_size(machine.state_observables())),
      state_(machine.layout().size()),
      inner_rings_(columns_of(machine.state_observables(), Observed::inner_ring_temperature)) {
  found_.growth_in_force = growth_in_force;
}

void DropProgress::begin(double time) {
  start_time_ = time;
  begin_ = last_ = Clock::now();
}

void DropProgress::step(const Step& step) {
  if (!report_ || ++counter_ % 64 != 0 || Clock::now() - last_ < std::chrono::milliseconds(200)) return;
  step.interpolate(step.time, state_);
  tell(step.time, state_);
  last_ = Clock::now();
}

void DropProgress::tell(double time, std::span<const double> y) {
  if (!report_) return;
  Progress p;
  p.time = time;
  p.end_time = drop_.loop().end_time();
  p.wall_time = std::chrono::duration<double>(Clock::now() - begin_).count();
  p.wall_time_left = time > start_time_ ? p.wall_time * (p.end_time - time) / (time - start_time_) : 0.;
  p.rotor_speed = machine_.spin(y).speed;
  p.largest_contact_force = drop_.scalars().largest_contact_force();
  p.inner_ring_temperature = std::numeric_limits<double>::quiet_NaN();
  machine_.evaluate(time, y, found_);
  machine_.observe_state(y, found_, observed_);
  for (const auto& ring : inner_rings_)
    p.inner_ring_temperature = std::fmax(p.inner_ring_temperature, observed_[ring.first]);
  report_(p);
}

}  // namespace rotordrop
