#pragma once
#include <deal.II/lac/sparse_matrix.h>

#include <vector>

namespace rotordrop {

/// The entries of a matrix that are not zero, row after row. Bodies whose properties depend on temperature have a place in the pattern, but zeros there.
class NonzeroRows {
 public:
  NonzeroRows() = default;
  explicit NonzeroRows(const dealii::SparseMatrix<double>& matrix) {
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
    std::size_t k = 0;
    for (unsigned int row = 0; row < end_.size(); ++row) {
      double sum = 0.;
      for (; k < end_[row]; ++k) sum += value_[k] * v(column_[k]);
      out(row) = sum;
    }
  }

 private:
  std::vector<std::size_t> end_;
  std::vector<unsigned int> column_;
  std::vector<double> value_;
};

}  // namespace rotordrop
