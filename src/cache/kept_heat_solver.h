#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "model/heat_conduction.h"

namespace rotordrop {

using HeatSolverMaker = std::function<std::unique_ptr<HeatConductionSolver>(const HeatConductionProblem&)>;

/// A solver that answers what it was asked before from the cache (capacities, areas, reductions, projections), steps linear problems by the matrices
/// that it has there, and makes the real one for anything else. Answers are the same to the last bit, with or without a cache.
/// @param folder  of the cache; empty: nothing is kept
/// @param module  tells one version of the real solver from another
std::unique_ptr<HeatConductionSolver> kept_heat_solver(const std::filesystem::path& folder, const std::string& module,
                                                       const HeatConductionProblem& problem,
                                                       const HeatSolverMaker& make);

}  // namespace rotordrop
