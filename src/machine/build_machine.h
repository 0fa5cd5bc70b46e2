#pragma once
#include <memory>

#include "machine/bearing_data.h"
#include "machine/heat/finite_elements.h"
#include "machine/heat/thermal_parts.h"
#include "machine/machine.h"
#include "machine/machine_parameters.h"

namespace rotordrop {

/// The parts of a machine, for programs that replace parts, or add some that no case names, before they wire them with
/// `Machine(std::move(parts))`. Arguments as of build_machine().
Machine::Parts machine_parts(const MachineParameters& parameters, const Node& case_node,
                             FiniteElements* finite_elements = nullptr,
                             std::shared_ptr<const GrowthHistory> recorded = nullptr);

/// The machine of a case whose parameters were checked. @throws InputError, SolverError
/// @param finite_elements  the room's doors if the case has finite elements; takes the sections that are made
/// @param recorded         growth of an earlier run, if that drives
std::unique_ptr<Machine> build_machine(const MachineParameters& parameters, const Node& case_node,
                                       FiniteElements* finite_elements = nullptr,
                                       std::shared_ptr<const GrowthHistory> recorded = nullptr);

}  // namespace rotordrop
