#pragma once
#include <string>

#include "machine/machine_parameters.h"

namespace rotordrop {

/// Lines on what the bodies of the touchdown bearings give: contact stiffness, laws of supports.
[[nodiscard]] std::string bearing_report(const MachineParameters& parameters);

}  // namespace rotordrop
