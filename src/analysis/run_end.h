#pragma once
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "analysis/watch/bearing_touch.h"
#include "machine/machine.h"
#include "machine/machine_parameters.h"

namespace rotordrop {

/// Watches for the condition of `run.until` at every step that is observed.
class RunEnd {
 public:
  RunEnd(const Machine& machine, EndCondition condition);
  /// @param step  values of machine.step_observables() at t
  /// @param spin  speed of the rotor [rad/s]
  void follow(double t, std::span<const double> step, double spin);
  /// Whether the condition held at the last step.
  [[nodiscard]] bool is_reached() const { return is_reached_; }
  /// For checkpoints.
  [[nodiscard]] std::vector<double> packed() const { return {last_contact_, is_reached_ ? 1. : 0., last_spin_}; }
  void unpack(std::span<const double> values);

 private:
  struct Columns {
    TouchColumns touch;
    std::size_t spin_lag;
  };
  EndCondition condition_;
  std::vector<Columns> touchdown_;
  double last_contact_ = std::numeric_limits<double>::infinity();  // [s]; infinite before the first contact
  bool is_reached_ = false;
  double last_spin_ = 0;  // at the last step [rad/s]
};

}  // namespace rotordrop
