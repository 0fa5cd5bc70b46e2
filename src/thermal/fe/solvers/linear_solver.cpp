#include "thermal/fe/solvers/linear_solver.h"

#include "thermal/fe/solvers/cholesky_solver.h"
#include "thermal/fe/solvers/lu_solver.h"
#include "thermal/fe/solvers/petsc_solver.h"

namespace rotordrop {

std::unique_ptr<LinearSolver> make_linear_solver(HeatLinearSolver kind, bool is_symmetric) {
  if (kind == HeatLinearSolver::multigrid || has_several_ranks()) return make_petsc_solver(kind, is_symmetric);
  if (is_symmetric) return std::make_unique<CholeskySolver>();
  return std::make_unique<LuSolver>();
}

}  // namespace rotordrop
