#pragma once
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <memory>

#include "base/memory.h"
#include "model/heat_conduction.h"

namespace rotordrop {

/// Solves with matrices that share one pattern: capacity + a conductance.
class LinearSolver {
 public:
  using Matrix = dealii::SparseMatrix<double>;
  using Vector = dealii::Vector<double>;
  LinearSolver() = default;
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;
  virtual ~LinearSolver() = default;

  /// @throws SolverError if the matrix is singular
  virtual void set_matrix(const Matrix& matrix) = 0;
  /// v becomes the solution. @throws SolverError if an iteration does not converge
  virtual void solve(Vector& v) = 0;
};

/// What `automatic` is for a mesh in the plane: direct if its factors take less than half of the memory [bytes].
[[nodiscard]] HeatLinearSolver chosen_solver(HeatLinearSolver asked, std::size_t n_unknowns,
                                             double memory = static_cast<double>(most_memory()));

/// Direct in one process: Cholesky's factors, or LU of what is not symmetric. Multigrid, and everything under mpirun, by PETSc.
/// @param asked  not automatic
/// @param is_symmetric  whether all matrices will be, and positive definite
std::unique_ptr<LinearSolver> make_linear_solver(HeatLinearSolver asked, bool is_symmetric);

}  // namespace rotordrop
