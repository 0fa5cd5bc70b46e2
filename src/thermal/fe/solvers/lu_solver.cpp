#include "thermal/fe/solvers/lu_solver.h"

#include <fmt/format.h>
#include <umfpack.h>

#include <algorithm>
#include <array>

#include "base/errors.h"
#include "base/memory.h"

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

/// OpenBLAS takes a buffer at its first call; where there is no memory for it, it asks again for ever.
void require_memory_of_blas() {
  constexpr std::uint64_t buffer =
      150'000'000;  // [bytes]: 134 MB of OpenBLAS 0.3.21, and some for what comes before it
  static bool is_there = false;
  if (const auto left = memory_left(); !is_there && left < buffer)
    throw SolverError(
        fmt::format("there is not enough memory for the matrix of the finite elements: its factors need at least {}, "
                    "{} are left (ulimit -v).",
                    bytes_in_words(static_cast<double>(buffer)), bytes_in_words(static_cast<double>(left))));
  is_there = true;
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
  require_memory_of_blas();
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
