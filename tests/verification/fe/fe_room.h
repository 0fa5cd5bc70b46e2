#pragma once
#include <memory>

#include "model/heat_conduction.h"
#include "model/thermo_elasticity.h"

// The room's doors, as the program finds them in the module.
extern "C" rotordrop::HeatConductionSolver* rotordrop_make_heat_solver(const rotordrop::HeatConductionProblem& problem);
extern "C" rotordrop::ElasticSolver* rotordrop_make_elastic_solver(const rotordrop::ElasticProblem& problem);

namespace rotordrop {

inline std::unique_ptr<HeatConductionSolver> make_solver(const HeatConductionProblem& problem) {
  return std::unique_ptr<HeatConductionSolver>(rotordrop_make_heat_solver(problem));
}
inline std::unique_ptr<ElasticSolver> make_elastic_solver(const ElasticProblem& problem) {
  return std::unique_ptr<ElasticSolver>(rotordrop_make_elastic_solver(problem));
}

}  // namespace rotordrop
