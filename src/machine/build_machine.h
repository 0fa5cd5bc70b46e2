#pragma once
#include <memory>

#include "machine/machine.h"
#include "machine/machine_parameters.h"

namespace rotordrop {

/// Checks that need several sections at once; `case_node` gives the positions.
void check_machine(const MachineParameters& parameters, const Node& case_node, Faults& faults);

/// The machine of a case whose parameters were checked. @throws InputError, SolverError
std::unique_ptr<Machine> build_machine(const MachineParameters& parameters, const Node& case_node);

}  // namespace rotordrop
