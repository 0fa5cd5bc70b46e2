#pragma once
#include <optional>
#include <string>

#include "machine/machine_parameters.h"

namespace rotordrop {

/// What a falling rotor touches first.
struct FirstTouch {
  double earliest = 0, latest = 0;  ///< [s]; between them where waves of a bore stand is unknown
  bool is_probe = false;            ///< a contact at a probe, no bearing
  std::string name;
};
/// When a rigid rotor that falls freely from its start first bridges the gap of a touchdown bearing, as the rotor's growth by its speed leaves it, or the
/// clearance at a contact probe: y(t) = y_0 + v_0 t + g t^2/2 at the node. Waves of a bore make it narrower or wider by up to the sum of their amplitudes.
/// Unbalance, bending and rings that hang in their balls change it by some percent. None with supports of other kinds, such as magnets, and for a rotor that stays within the gaps for `within` seconds.
[[nodiscard]] std::optional<FirstTouch> first_touch(const MachineParameters& parameters, double within = 10.);

/// A line for `check`; empty where nothing is known.
[[nodiscard]] std::string first_touch_text(const MachineParameters& parameters);

}  // namespace rotordrop
