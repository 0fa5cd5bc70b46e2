#pragma once
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <memory>
#include <vector>

namespace rotordrop {

/// LU factors of matrices that share one pattern (UMFPACK): the order of elimination is found once.
class DirectSolver {
 public:
  /// @throws SolverError if the matrix is singular
  void factorise(const dealii::SparseMatrix<double>& matrix);
  /// v becomes the solution.
  void solve(dealii::Vector<double>& v);

 private:
  void analyse(const dealii::SparseMatrix<double>& matrix);

  std::vector<long> row_start_, column_;
  std::vector<std::size_t> place_;  ///< where the matrix's k-th entry, in its own order, stands in sorted rows
  std::vector<double> value_, solution_;
  std::shared_ptr<void> symbolic_, numeric_;
};

}  // namespace rotordrop
