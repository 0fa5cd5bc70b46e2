#pragma once
// When a rotor touches a touchdown bearing: in its bore, or with a shoulder beside its inner ring.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/real.h"
#include "model/observable.h"

namespace rotordrop {

/// Rotors and rings below it do not spin but by roundoff [rad/s]: bores of 0.1 m move by 5 um/s.
inline constexpr double least_spin = 1e-4;

/// Where a bearing's touch stands among a machine's step observables.
struct TouchColumns {
  std::size_t penetration;
  std::optional<std::size_t> shoulder_force;  ///< of a ring that moves along the axis
};

/// @returns nothing if the place is not a touchdown bearing
[[nodiscard]] inline std::optional<TouchColumns> touch_columns(const std::vector<Observable>& step_observables,
                                                               const std::string& place) {
  const auto penetration = columns_of(step_observables, Observed::penetration, place),
             shoulder = columns_of(step_observables, Observed::shoulder_force, place);
  if (!penetration) return {};
  return TouchColumns{penetration->first, shoulder ? std::optional(shoulder->first) : std::nullopt};
}

/// Whether a shoulder presses on the ring. @param step  values of the step observables, by column
template <class Real, class StepValues>
[[nodiscard]] MaskOf<Real> is_shoulder_touched(const TouchColumns& c, const StepValues& step) {
  if (!c.shoulder_force) return MaskOf<Real>(false);
  return Real(step[*c.shoulder_force]) != 0.;
}

/// Whether the rotor touches the bearing, in the bore or on a shoulder.
template <class Real, class StepValues>
[[nodiscard]] MaskOf<Real> is_touched(const TouchColumns& c, const StepValues& step) {
  return (Real(step[c.penetration]) > 0.) | is_shoulder_touched<Real>(c, step);
}

}  // namespace rotordrop
