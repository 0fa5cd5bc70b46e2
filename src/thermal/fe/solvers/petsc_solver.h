#pragma once
#include <memory>

#include "thermal/fe/solvers/linear_solver.h"

namespace rotordrop {

/// Whether mpirun has started this process together with others. Asks the environment: MPI itself takes a noticeable time to start.
bool has_several_ranks();
/// Whether any rank says yes. All of them must ask; alone the answer is the question.
bool on_any_rank(bool own);

/// Rows of the matrix distributed over all ranks; vectors are whole on each of them, before and after. Multigrid: conjugate gradients (GMRES if not
/// symmetric) preconditioned by BoomerAMG of hypre, to 1e-12 of the right side. Direct: MUMPS. PETSc and MPI start with the first of them.
std::unique_ptr<LinearSolver> make_petsc_solver(HeatLinearSolver kind, bool is_symmetric);

}  // namespace rotordrop
