#pragma once
#include <memory>

#include "machine/finite_elements.h"
#include "model/heat_conduction.h"
#include "study/case.h"

namespace rotordrop {

/// The room's doors for a case that has finite elements.
FiniteElements finite_elements_of(const Case& drop_case);

/// Loads the finite-element room, a module beside the program, and makes its solver. The module stays loaded.
/// @throws InputError if the program was built without it
std::unique_ptr<HeatConductionSolver> make_heat_solver(const HeatConductionProblem& problem);

}  // namespace rotordrop
