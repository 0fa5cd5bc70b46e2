#pragma once
#include <memory>

#include "model/heat_conduction.h"

// The room's one door, as the program finds it in the module.
extern "C" rotordrop::HeatConductionSolver* rotordrop_make_heat_solver(const rotordrop::HeatConductionProblem& problem);

namespace rotordrop {

inline std::unique_ptr<HeatConductionSolver> make_solver(const HeatConductionProblem& problem) {
  return std::unique_ptr<HeatConductionSolver>(rotordrop_make_heat_solver(problem));
}

}  // namespace rotordrop
