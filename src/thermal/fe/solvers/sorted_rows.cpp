#include "thermal/fe/solvers/sorted_rows.h"

#include <algorithm>
#include <utility>

namespace rotordrop {

void SortedRows::analyse(const dealii::SparseMatrix<double>& matrix) {
  const auto n = matrix.m();
  row_start.assign(n + 1, 0);
  column.clear();
  place_.clear();
  for (unsigned int row = 0; row < n; ++row) {
    std::vector<std::pair<long, std::size_t>> entries;
    for (auto entry = matrix.begin(row); entry != matrix.end(row); ++entry)
      entries.emplace_back(static_cast<long>(entry->column()), entries.size());
    std::sort(entries.begin(), entries.end());
    const std::size_t start = column.size();
    place_.resize(start + entries.size());
    for (const auto& [at, original] : entries) {
      place_[start + original] = column.size();
      column.push_back(at);
    }
    row_start[row + 1] = static_cast<long>(column.size());
  }
  value.resize(column.size());
}

void SortedRows::take_values(const dealii::SparseMatrix<double>& matrix) {
  std::size_t k = 0;
  for (unsigned int row = 0; row < matrix.m(); ++row)
    for (auto entry = matrix.begin(row); entry != matrix.end(row); ++entry) value[place_[k++]] = entry->value();
}

}  // namespace rotordrop
