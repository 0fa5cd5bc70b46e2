#pragma once
#include "machine/machine_parameters.h"

namespace rotordrop {

/// Checks that need several sections at once; `case_node` gives the positions.
void check_machine(const MachineParameters& parameters, const Node& case_node, Faults& faults);

}  // namespace rotordrop
