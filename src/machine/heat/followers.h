#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "machine/machine.h"

namespace rotordrop {

/// Thermal models of a machine that follow the integration of the rest: each of its steps, or a part of one, is one step of theirs, under the energy that the
/// ledgers gained in it, as even power.
class Followers {
 public:
  explicit Followers(const Machine& machine);
  [[nodiscard]] bool empty() const { return models_.empty(); }
  /// Ways for heat through balls and contacts, as they are at the start of the next step, stay through it.
  void hold(const Evaluation& at_start) {
    if (!empty()) heats_ = at_start.heats;
  }
  /// @param step    [s]
  /// @param before  the state at the step's start [layout().size()]
  /// @param y       as large; its integrated part stands `step` later, the rest is filled in
  void advance(double step, std::span<const double> before, std::span<double> y);

 private:
  const Machine& machine_;
  std::vector<std::size_t> models_;
  std::vector<HeatInput> heats_;  // of the thermal places
};

}  // namespace rotordrop
