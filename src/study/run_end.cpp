#include "study/run_end.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace rotordrop {

RunEnd::RunEnd(const Machine& machine, EndCondition condition) : condition_(condition) {
  std::map<std::string, std::size_t> where;
  std::size_t at = 0;
  for (const auto& o : machine.step_observables()) {
    where[o.name] = at;
    at += o.size;
  }
  for (std::size_t i = 0; i < machine.n_supports(); ++i) {
    const std::string prefix = "/bearings/" + machine.support(i).name() + "/";
    const auto penetration = where.find(prefix + "penetration"), lag = where.find(prefix + "spin_lag");
    if (penetration != where.end() && lag != where.end()) touchdown_.push_back({penetration->second, lag->second});
  }
}

void RunEnd::follow(double t, std::span<const double> step, double spin) {
  const auto touches = [&](const Columns& c) { return step[c.penetration] > 0.; };
  const auto is_at_speed = [&](const Columns& c) { return std::fabs(step[c.spin_lag]) < 0.01; };
  switch (condition_) {
    case EndCondition::time:
      break;
    case EndCondition::standstill:
      is_reached_ = std::fabs(spin) < standstill_speed;
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
  last_contact_ = values[0];
  is_reached_ = values[1] != 0.;
}

}  // namespace rotordrop
