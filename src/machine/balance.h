#pragma once
#include <string>
#include <vector>

#include "machine/machine_parameters.h"

namespace rotordrop {

/// The unbalance of rotor.balance_grade in its planes; empty without a grade, or with faults.
/// @param case_node  for the positions of faults
std::vector<Unbalance> unbalance_by_grade(const MachineParameters& parameters, const Node& case_node, Faults& faults);

/// The same as a line for the screen; empty without a grade.
std::string balance_text(const MachineParameters& parameters);

}  // namespace rotordrop
