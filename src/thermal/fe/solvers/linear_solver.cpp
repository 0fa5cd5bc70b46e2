#include "thermal/fe/solvers/linear_solver.h"

#include <cmath>

#include "thermal/fe/solvers/cholesky_solver.h"
#include "thermal/fe/solvers/lu_solver.h"
#include "thermal/fe/solvers/petsc_solver.h"

namespace rotordrop {

HeatLinearSolver chosen_solver(HeatLinearSolver asked, std::size_t n_unknowns, double memory) {
  if (asked != HeatLinearSolver::automatic) return asked;
  // Measured with 160 801 and 491 401 unknowns, quadratic cells: 142 and 130 bytes of n log2 n.
  const auto n = static_cast<double>(n_unknowns);
  const double factors = 150. * n * std::log2(n + 1.);
  return factors < 0.5 * memory ? HeatLinearSolver::direct : HeatLinearSolver::multigrid;
}

std::unique_ptr<LinearSolver> make_linear_solver(HeatLinearSolver asked, bool is_symmetric) {
  if (asked == HeatLinearSolver::multigrid || has_several_ranks()) return make_petsc_solver(asked, is_symmetric);
  if (is_symmetric) return std::make_unique<CholeskySolver>();
  return std::make_unique<LuSolver>();
}

}  // namespace rotordrop
