#pragma once
#include <string>
#include <vector>

#include "machine/machine_parameters.h"

namespace rotordrop {

/// Checks rotor.balance_grade and the keys that belong to it. @param case_node  for the positions of faults
void check_balance(const MachineParameters& parameters, const Node& case_node, Faults& faults);

/// The unbalance of rotor.balance_grade in its planes, of parameters that were checked and have a grade.
std::vector<Unbalance> unbalance_by_grade(const MachineParameters& parameters);

/// The same as a line for the screen; empty without a grade.
std::string balance_text(const MachineParameters& parameters);

}  // namespace rotordrop
