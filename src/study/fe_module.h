#pragma once
#include <memory>

#include "model/heat_conduction.h"

namespace rotordrop {

/// Loads the finite-element room, a module beside the program, and makes its solver. The module stays loaded.
/// @throws InputError if the program was built without it
std::unique_ptr<HeatConductionSolver> make_heat_solver(const HeatConductionProblem& problem);

}  // namespace rotordrop
