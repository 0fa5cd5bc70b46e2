#include "analysis/row_lanes.h"

#include <utility>

#include "machine/lanes/machine_lanes.h"

namespace rotordrop {

RowLanes::RowLanes(const Machine& machine)
    : y_(machine.layout().size() * LaneSystem::width), rates_(y_.size()), step_(machine.n_step() * LaneSystem::width) {
  const Machine* one = &machine;
  system_ = make_lanes({&one, 1});
  found_.step.resize(machine.n_step());
}

void RowLanes::add(double t, std::span<const double> y) {
  t_[n_] = t;
  state_[n_].assign(y.begin(), y.end());
  ++n_;
}

void RowLanes::evaluate(const std::function<void(double t, std::span<const double> y, const Evaluation& found)>& take) {
  const std::size_t n = std::exchange(n_, 0);  // if one of them cannot be taken, none is given again
  if (n == 0) return;
  // Lanes without a state repeat the first.
  for (std::size_t lane = 0; lane < LaneSystem::width; ++lane) {
    const std::size_t from = lane < n ? lane : 0;
    t_[lane] = t_[from];
    for (std::size_t i = 0; i < state_[from].size(); ++i) y_[i * LaneSystem::width + lane] = state_[from][i];
  }
  system_->observe(t_, y_, rates_, step_, {});
  for (std::size_t lane = 0; lane < n; ++lane) {
    for (std::size_t i = 0; i < found_.step.size(); ++i) found_.step[i] = step_[i * LaneSystem::width + lane];
    system_->found(lane, found_);
    take(t_[lane], state_[lane], found_);
  }
  n_ = 0;
}

}  // namespace rotordrop
