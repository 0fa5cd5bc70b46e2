#include "thermal/fe/solvers/cholesky_solver.h"

#include <cholmod.h>
#include <fmt/format.h>

#include <algorithm>

#include "base/errors.h"
#include "base/memory.h"
#include "thermal/fe/solvers/sorted_rows.h"

namespace rotordrop {

struct CholeskySolver::Factors {
  Factors() {
    cholmod_l_start(&common);
    common.supernodal = CHOLMOD_SIMPLICIAL;
    common.print = 0;
  }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;
  ~Factors() {
    cholmod_l_free_factor(&factor, &common);
    for (auto** dense : {&solution, &work, &more_work}) cholmod_l_free_dense(dense, &common);
    cholmod_l_finish(&common);
  }

  SortedRows rows;
  cholmod_common common{};
  cholmod_sparse matrix{};  ///< of rows' storage: as symmetric, rows are columns
  cholmod_factor* factor = nullptr;
  cholmod_dense *solution = nullptr, *work = nullptr, *more_work = nullptr;
};

namespace {

/// METIS, which finds the order of elimination, ends the process where memory is short.
void require_memory_to_analyse(const cholmod_sparse& m) {
  // An estimate: a graph with both halves, coarser ones of it, and weights.
  const double needed = 1.6e7 + 64. * static_cast<double>(m.nzmax) + 512. * static_cast<double>(m.nrow);
  const auto left = static_cast<double>(memory_left());
  if (left < needed)
    throw SolverError(
        fmt::format("there is not enough memory for the matrix of the finite elements: {} unknowns need at least {}, "
                    "{} are left (ulimit -v).\n       Make the mesh coarser, or choose the solver \"multigrid\".",
                    m.nrow, bytes_in_words(needed), bytes_in_words(left)));
}

}  // namespace

CholeskySolver::CholeskySolver() : factors_(std::make_unique<Factors>()) {}
CholeskySolver::~CholeskySolver() = default;

void CholeskySolver::set_matrix(const Matrix& matrix) {
  auto& f = *factors_;
  if (!f.factor) {
    f.rows.analyse(matrix);
    auto& m = f.matrix;
    m.nrow = m.ncol = matrix.m();
    m.nzmax = f.rows.column.size();
    m.p = f.rows.row_start.data();
    m.i = f.rows.column.data();
    m.x = f.rows.value.data();
    m.stype = 1;  // the upper half is read
    m.itype = CHOLMOD_LONG;
    m.xtype = CHOLMOD_REAL;
    m.dtype = CHOLMOD_DOUBLE;
    m.sorted = m.packed = 1;
    require_memory_to_analyse(m);
    f.factor = cholmod_l_analyze(&m, &f.common);
    if (!f.factor)
      throw SolverError(
          fmt::format("the matrix of the finite elements could not be analysed (CHOLMOD status {})", f.common.status));
  }
  f.rows.take_values(matrix);
  const bool is_done = cholmod_l_factorize(&f.matrix, f.factor, &f.common);
  if (f.common.status == CHOLMOD_OUT_OF_MEMORY)
    throw SolverError(
        fmt::format("there is not enough memory to factorise the matrix of the finite elements: {} unknowns, {} of "
                    "factors.\n"
                    "       Make the mesh coarser, or choose the solver \"multigrid\".",
                    f.matrix.nrow, bytes_in_words(f.common.lnz * 8.)));
  if (!is_done || f.common.status != CHOLMOD_OK)
    throw SolverError(
        fmt::format("the matrix of the finite elements could not be factorised (CHOLMOD status {})", f.common.status));
}

void CholeskySolver::solve(Vector& v) {
  auto& f = *factors_;
  cholmod_dense given{};
  given.nrow = given.nzmax = given.d = v.size();
  given.ncol = 1;
  given.x = v.begin();
  given.xtype = CHOLMOD_REAL;
  given.dtype = CHOLMOD_DOUBLE;
  if (!cholmod_l_solve2(CHOLMOD_A, f.factor, &given, nullptr, &f.solution, nullptr, &f.work, &f.more_work, &f.common))
    throw SolverError(
        fmt::format("the equations of the finite elements could not be solved (CHOLMOD status {})", f.common.status));
  const auto* x = static_cast<const double*>(f.solution->x);
  std::copy(x, x + v.size(), v.begin());
}

}  // namespace rotordrop
