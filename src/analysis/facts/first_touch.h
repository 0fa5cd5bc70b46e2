#pragma once
#include <optional>
#include <string>

#include "machine/machine_parameters.h"

namespace rotordrop {

/// When a rigid rotor that falls freely from its start first bridges the gap of a touchdown bearing, y(t) = y_0 + v_0 t + g t^2/2 at each bearing's
/// node [s]. Unbalance, bending and rings that hang in their balls change it by some percent.
/// None with supports of other kinds, such as magnets, and for a rotor that stays within the gaps for `within` seconds.
[[nodiscard]] std::optional<double> first_touch(const MachineParameters& parameters, double within = 10.);

/// A line for `check`; empty where nothing is known.
[[nodiscard]] std::string first_touch_text(const MachineParameters& parameters);

}  // namespace rotordrop
