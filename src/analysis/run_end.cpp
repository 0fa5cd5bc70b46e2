#include "analysis/run_end.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rotordrop {

RunEnd::RunEnd(const Machine& machine, EndCondition condition) : condition_(condition) {
  const auto& list = machine.step_observables();
  for (const auto& lag : columns_of(list, Observed::spin_lag))
    if (const auto touch = touch_columns(list, lag.place)) touchdown_.push_back({*touch, lag.first});
}

void RunEnd::follow(double t, std::span<const double> step, double spin) {
  const auto touches = [&](const Columns& c) { return is_touched<double>(c.touch, step); };
  const auto is_at_speed = [&](const Columns& c) {
    return std::fabs(spin) > least_spin && std::fabs(step[c.spin_lag]) < 0.01;
  };
  switch (condition_) {
    case EndCondition::time:
      break;
    case EndCondition::standstill:
      // A step may take the rotor from one direction of spin to the other.
      is_reached_ = std::fabs(spin) < standstill_speed || spin * last_spin_ < 0.;
      last_spin_ = spin;
      break;
    case EndCondition::no_contact:
      if (std::any_of(touchdown_.begin(), touchdown_.end(), touches)) last_contact_ = t;
      is_reached_ = t - last_contact_ >= flight_without_contact;
      break;
    case EndCondition::rings_at_speed:
      is_reached_ = !touchdown_.empty() && std::all_of(touchdown_.begin(), touchdown_.end(), is_at_speed);
      break;
  }
}

void RunEnd::unpack(std::span<const double> values) {
  if (values.size() != 3) throw std::invalid_argument("an end condition of another kind");
  last_contact_ = values[0];
  is_reached_ = values[1] != 0.;
  last_spin_ = values[2];
}

}  // namespace rotordrop
