#pragma once
#include <array>
#include <functional>
#include <memory>
#include <span>

#include "base/aligned_numbers.h"
#include "machine/machine.h"
#include "model/lane_system.h"

namespace rotordrop {

/// States of one drop at several times, evaluated side by side in lanes, which takes less time than one by one. What is found of a state does
/// not depend on those beside it.
class RowLanes {
 public:
  /// @param machine  evaluates_in_lanes(); must outlive this
  explicit RowLanes(const Machine& machine);
  static constexpr std::size_t most = LaneSystem::width;
  [[nodiscard]] bool is_full() const { return n_ == most; }
  [[nodiscard]] std::size_t n_added() const { return n_; }
  void add(double t, std::span<const double> y);
  /// Evaluates all that were added, gives them to `take` in their order, and is empty.
  /// @param take  its evaluation holds what Machine::observe_state() and the step observables need, and no more
  void evaluate(const std::function<void(double t, std::span<const double> y, const Evaluation& found)>& take);

 private:
  std::unique_ptr<LaneSystem> system_;
  std::size_t n_ = 0;
  std::array<double, LaneSystem::width> t_{};
  std::array<std::vector<double>, LaneSystem::width> state_;
  AlignedNumbers y_, rates_, step_;  // [n][width]
  Evaluation found_;
};

}  // namespace rotordrop
