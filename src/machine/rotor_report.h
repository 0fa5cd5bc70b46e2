#pragma once
#include <vector>

#include "machine/machine_parameters.h"
#include "rotor/modal_analysis.h"

namespace rotordrop {

/// Properties of a rotor without supports.
struct RotorReport {
  RigidBody body;
  std::vector<double>
      free_free_frequencies;  ///< of the flexible modes of one plane at rest that take part in the run [Hz]
};
RotorReport rotor_report(const RotorParameters& rotor);

/// Natural modes at constant spin with the case's linear supports; free-free if it has none. Touchdown bearings do not hold the
/// levitated rotor and take no part.
/// @param spin_speeds [rad/s]
std::vector<WhirlModes> machine_modes(const MachineParameters& parameters, const std::vector<double>& spin_speeds);

}  // namespace rotordrop
