#pragma once
#include <memory>
#include <span>
#include <vector>

#include "analysis/watch/bearing_scalars.h"
#include "model/lane_system.h"

namespace rotordrop {

/// Follows the touchdown bearings of eight drops that run side by side: what DropScalars does of one.
class ScalarsInLanes {
 public:
  ScalarsInLanes() = default;
  ScalarsInLanes(const ScalarsInLanes&) = delete;
  ScalarsInLanes& operator=(const ScalarsInLanes&) = delete;
  virtual ~ScalarsInLanes() = default;

  /// Goes on with a drop's in this lane. @param bearings  [number of columns]
  virtual void take(std::size_t lane, std::span<const BearingScalars> bearings) = 0;
  /// Those of a lane as far as they were followed.
  [[nodiscard]] virtual std::vector<BearingScalars> of(std::size_t lane) const = 0;
  /// @param told  [width]: not 0 in lanes whose step is told; @param t  [width] [s]
  /// @param step  values of the step observables [number of values][width]
  virtual void follow(std::span<const double> told, std::span<const double> t, std::span<const double> step) = 0;
};

/// @param columns  of every touchdown bearing
std::unique_ptr<ScalarsInLanes> make_scalars_in_lanes(const std::vector<BearingColumns>& columns);

// One for each level of vectors: scalars_engine.cpp is compiled for all of them.
std::unique_ptr<ScalarsInLanes> scalars_in_lanes_base(const std::vector<BearingColumns>& columns);
std::unique_ptr<ScalarsInLanes> scalars_in_lanes_v3(const std::vector<BearingColumns>& columns);
std::unique_ptr<ScalarsInLanes> scalars_in_lanes_v4(const std::vector<BearingColumns>& columns);
std::unique_ptr<ScalarsInLanes> scalars_in_lanes_v4_newton(const std::vector<BearingColumns>& columns);

}  // namespace rotordrop
