#include "thermal/fe/solvers/lu_solver.h"

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
    c[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;  // of the pattern
    c[UMFPACK_IRSTEP] = 0;  // the matrices are well conditioned; Newton's iteration refines where it matters
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

void LuSolver::set_matrix(const Matrix& matrix) {
  if (!symbolic_) {
    rows_.analyse(matrix);
    solution_.resize(matrix.m());
    void* symbolic = nullptr;
    const auto n = static_cast<long>(matrix.m());
    // Rows for columns: UMFPACK sees the transposed matrix, which solve() undoes.
    check(
        umfpack_dl_symbolic(n, n, rows_.row_start.data(), rows_.column.data(), nullptr, &symbolic, control(), nullptr),
        "analysed");
    symbolic_ = std::shared_ptr<void>(symbolic, [](void* p) { umfpack_dl_free_symbolic(&p); });
  }
  rows_.take_values(matrix);
  void* numeric = nullptr;
  numeric_.reset();
  check(umfpack_dl_numeric(rows_.row_start.data(), rows_.column.data(), rows_.value.data(), symbolic_.get(), &numeric,
                           control(), nullptr),
        "factorised");
  numeric_ = std::shared_ptr<void>(numeric, [](void* p) { umfpack_dl_free_numeric(&p); });
}

void LuSolver::solve(Vector& v) {
  check(umfpack_dl_solve(UMFPACK_At, rows_.row_start.data(), rows_.column.data(), rows_.value.data(), solution_.data(),
                         v.begin(), numeric_.get(), control(), nullptr),
        "solved");
  std::copy(solution_.begin(), solution_.end(), v.begin());
}

}  // namespace rotordrop
