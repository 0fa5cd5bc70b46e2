#pragma once
#include <array>
#include <memory>
#include <span>

#include "base/aligned_numbers.h"
#include "base/row_tile.h"
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
  static_assert(most == RowTile::width);
  [[nodiscard]] bool is_full() const { return n_ == most; }
  [[nodiscard]] std::size_t n_added() const { return n_; }
  void add(double t, std::span<const double> y);
  /// Evaluates all that were added, and is empty.
  /// @param is_whole  false: of the state observables only those of Machine::observe_held() are asked for
  /// @returns rows of step and state observables in the order in which their states were added; they stay until the next add()
  [[nodiscard]] RowTile evaluate(bool is_whole = true);

 private:
  std::unique_ptr<LaneSystem> system_;
  std::size_t n_ = 0, n_step_ = 0;
  std::array<double, LaneSystem::width> t_{};
  AlignedNumbers y_, rates_, values_;  // [n][width]
};

}  // namespace rotordrop
