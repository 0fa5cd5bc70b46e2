#include "analysis/row_lanes.h"

#include <stdexcept>
#include <utility>

#include "machine/lanes/machine_lanes.h"

namespace rotordrop {

RowLanes::RowLanes(const Machine& machine)
    : n_step_(machine.n_step() * LaneSystem::width),
      y_(machine.layout().size() * LaneSystem::width),
      rates_(y_.size()),
      values_(n_step_ + observed_size(machine.state_observables()) * LaneSystem::width) {
  const Machine* one = &machine;
  system_ = make_lanes({&one, 1});
}

void RowLanes::add(double t, std::span<const double> y) {
  if (is_full()) throw std::logic_error("RowLanes: eight states wait to be evaluated");
  t_[n_] = t;
  for (std::size_t i = 0; i < y.size(); ++i) y_[i * LaneSystem::width + n_] = y[i];
  ++n_;
}

RowTile RowLanes::evaluate(bool is_whole) {
  const std::size_t n = std::exchange(n_, 0);  // if one of them cannot be taken, none is given again
  const std::span times(t_.data(), n), values(values_);
  if (n > 0) {
    // Lanes without a state repeat the first.
    for (std::size_t lane = n; lane < LaneSystem::width; ++lane) {
      t_[lane] = t_[0];
      for (std::size_t i = 0; i < y_.size(); i += LaneSystem::width) y_[i + lane] = y_[i];
    }
    system_->observe(t_, y_, rates_, values.first(n_step_), {});
    if (is_whole)
      system_->observe_state(y_, values.subspan(n_step_));
    else
      system_->observe_held(y_, values.subspan(n_step_));
  }
  return {times, values_.data(), values_.size() / LaneSystem::width};
}

}  // namespace rotordrop
