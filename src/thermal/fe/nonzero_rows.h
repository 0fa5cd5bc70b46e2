#pragma once
#include <deal.II/lac/sparse_matrix.h>

#include <vector>

namespace rotordrop {

/// Multiplies by a matrix without its zeros, where it has many: bodies whose properties depend on temperature have a place in the pattern, but zeros there.
/// Of a matrix with few nothing is copied.
class NonzeroRows {
 public:
  NonzeroRows() = default;
  /// @param matrix  must outlive this, at its place
  explicit NonzeroRows(const dealii::SparseMatrix<double>& matrix) : matrix_(&matrix) {
    std::size_t n_zeros = 0;
    for (const auto& entry : matrix) n_zeros += entry.value() == 0. ? 1 : 0;
    if (2 * n_zeros < matrix.n_nonzero_elements()) return;
    for (unsigned int row = 0; row < matrix.m(); ++row) {
      for (auto entry = matrix.begin(row); entry != matrix.end(row); ++entry)
        if (entry->value() != 0.) {
          column_.push_back(entry->column());
          value_.push_back(entry->value());
        }
      end_.push_back(value_.size());
    }
  }
  /// out = matrix v
  void multiply(const dealii::Vector<double>& v, dealii::Vector<double>& out) const {
    if (end_.empty()) return matrix_->vmult(out, v);
    std::size_t k = 0;
    for (unsigned int row = 0; row < end_.size(); ++row) {
      double sum = 0.;
      for (; k < end_[row]; ++k) sum += value_[k] * v(column_[k]);
      out(row) = sum;
    }
  }

 private:
  const dealii::SparseMatrix<double>* matrix_ = nullptr;
  std::vector<std::size_t> end_;  // empty: the matrix itself is asked
  std::vector<unsigned int> column_;
  std::vector<double> value_;
};

}  // namespace rotordrop
