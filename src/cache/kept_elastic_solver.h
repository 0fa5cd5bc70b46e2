#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "model/thermo_elasticity.h"

namespace rotordrop {

using ElasticSolverMaker = std::function<std::unique_ptr<ElasticSolver>(const ElasticProblem&)>;

/// A solver that answers from the cache what was asked before of the fits as they are joined (influences and shares), and makes the real one for
/// anything else. Answers are the same to the last bit.
/// @param folder  of the cache; empty: the real solver
/// @param module  tells one version of the real solver from another
std::unique_ptr<ElasticSolver> kept_elastic_solver(const std::filesystem::path& folder, const std::string& module,
                                                   const ElasticProblem& problem, const ElasticSolverMaker& make);

}  // namespace rotordrop
