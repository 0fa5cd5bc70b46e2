#pragma once
#include <deal.II/lac/sparse_matrix.h>

#include <vector>

namespace rotordrop {

/// A matrix by rows with rising columns, as libraries of factorisations want it; deal.II puts the diagonal first.
struct SortedRows {
  std::vector<long> row_start, column;
  std::vector<double> value;

  /// Takes the pattern; at the first time only.
  void analyse(const dealii::SparseMatrix<double>& matrix);
  void take_values(const dealii::SparseMatrix<double>& matrix);

 private:
  std::vector<std::size_t> place_;  ///< where the matrix's k-th entry, in its own order, stands
};

}  // namespace rotordrop
