#include "thermal/fe/direct_solver.h"

#include <fmt/format.h>
#include <umfpack.h>

#include <algorithm>
#include <array>

#include "base/errors.h"

namespace rotordrop {
namespace {

using Control = std::array<double, UMFPACK_CONTROL>;

const double* control() {
  static const Control values = [] {
    Control c{};
    umfpack_dl_defaults(c.data());
    c[UMFPACK_STRATEGY] =
        UMFPACK_STRATEGY_SYMMETRIC;  // of the pattern; with temperature-dependent k the values are not
    c[UMFPACK_IRSTEP] = 0;           // the matrices are well conditioned; Newton's iteration refines where it matters
    return c;
  }();
  return values.data();
}

void check(long status, const char* what) {
  if (status != UMFPACK_OK)
    throw SolverError(
        fmt::format("the matrix of the finite elements could not be {} (UMFPACK status {})", what, status));
}

}  // namespace

void DirectSolver::analyse(const dealii::SparseMatrix<double>& matrix) {
  const auto n = matrix.m();
  row_start_.assign(n + 1, 0);
  column_.clear();
  place_.clear();
  for (unsigned int row = 0; row < n; ++row) {
    std::vector<std::pair<long, std::size_t>> entries;
    for (auto entry = matrix.begin(row); entry != matrix.end(row); ++entry)
      entries.emplace_back(static_cast<long>(entry->column()), entries.size());
    std::sort(entries.begin(), entries.end());
    const std::size_t start = column_.size();
    place_.resize(start + entries.size());
    for (const auto& [column, original] : entries) {
      place_[start + original] = column_.size();
      column_.push_back(column);
    }
    row_start_[row + 1] = static_cast<long>(column_.size());
  }
  value_.resize(column_.size());
  solution_.resize(n);
  void* symbolic = nullptr;
  // Rows for columns: UMFPACK sees the transposed matrix, which solve() undoes.
  check(umfpack_dl_symbolic(static_cast<long>(n), static_cast<long>(n), row_start_.data(), column_.data(), nullptr,
                            &symbolic, control(), nullptr),
        "analysed");
  symbolic_ = std::shared_ptr<void>(symbolic, [](void* p) { umfpack_dl_free_symbolic(&p); });
}

void DirectSolver::factorise(const dealii::SparseMatrix<double>& matrix) {
  if (!symbolic_) analyse(matrix);
  std::size_t k = 0;
  for (unsigned int row = 0; row < matrix.m(); ++row)
    for (auto entry = matrix.begin(row); entry != matrix.end(row); ++entry) value_[place_[k++]] = entry->value();
  void* numeric = nullptr;
  numeric_.reset();
  check(umfpack_dl_numeric(row_start_.data(), column_.data(), value_.data(), symbolic_.get(), &numeric, control(),
                           nullptr),
        "factorised");
  numeric_ = std::shared_ptr<void>(numeric, [](void* p) { umfpack_dl_free_numeric(&p); });
}

void DirectSolver::solve(dealii::Vector<double>& v) {
  check(umfpack_dl_solve(UMFPACK_At, row_start_.data(), column_.data(), value_.data(), solution_.data(), v.begin(),
                         numeric_.get(), control(), nullptr),
        "solved");
  std::copy(solution_.begin(), solution_.end(), v.begin());
}

}  // namespace rotordrop
