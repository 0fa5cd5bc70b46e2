#include "thermal/fe/solvers/petsc_solver.h"

#include <fmt/format.h>
#include <petscksp.h>

#include <cstdlib>
#include <exception>
#include <vector>

#include "base/errors.h"

namespace rotordrop {
namespace {

constexpr double relative_residual = 1e-12;  // energy closes to 1e-10 of the input
constexpr int most_krylov_iterations = 1000;

void check(PetscErrorCode code, const char* what) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw SolverError(fmt::format("PETSc could not {} (error {}: {})", what, static_cast<int>(code), text ? text : "?"));
}

int number_in(const char* variable) {
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : 0;
}
bool is_under_mpirun() { return number_in("OMPI_COMM_WORLD_SIZE") > 0 || number_in("PMI_SIZE") > 0; }

/// Set where an error leaves this rank alone: waiting for the others at the end would be for ever. mpirun ends them.
bool is_abandoned = false;

void finalise() {
  if (!is_abandoned) PetscFinalize();
}

/// PETSc, and MPI with it, from the first solver that needs them to the program's end.
void start_petsc() {
  PetscBool is_started = PETSC_FALSE;
  PetscInitialized(&is_started);
  if (is_started) return;
  if (!is_under_mpirun())  // One process needs neither daemon nor network: 0.03 s instead of 0.3 s.
    for (const auto& [name, value] :
         {std::pair{"OMPI_MCA_ess_singleton_isolated", "1"}, std::pair{"OMPI_MCA_btl", "self"},
          std::pair{"OMPI_MCA_pml", "ob1"}, std::pair{"OMPI_MCA_mtl", "^psm2,ofi"}, std::pair{"OMPI_MCA_osc", "^ucx"}})
      setenv(name, value, 0);
  PetscOptionsSetValue(nullptr, "-no_signal_handler", "true");  // the program has its own
  if (PetscInitializeNoArguments() != 0) throw SolverError("PETSc could not be started.");
  PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  std::atexit(finalise);
}

class PetscSolver final : public LinearSolver {
 public:
  PetscSolver(HeatLinearSolver kind, bool is_symmetric) : kind_(kind), is_symmetric_(is_symmetric) { start_petsc(); }
  ~PetscSolver() override {
    if (std::uncaught_exceptions() > 0) {
      is_abandoned = true;
      return;
    }
    KSPDestroy(&solver_);
    MatDestroy(&matrix_);
    VecDestroy(&right_);
    VecDestroy(&solution_);
  }

  void set_matrix(const Matrix& matrix) override {
    if (!matrix_) prepare(matrix);
    std::vector<PetscInt> columns;
    std::vector<PetscScalar> values;
    for (PetscInt row = first_; row < end_; ++row) {
      columns.clear();
      values.clear();
      const auto number = static_cast<unsigned int>(row);
      for (auto entry = matrix.begin(number); entry != matrix.end(number); ++entry) {
        columns.push_back(static_cast<PetscInt>(entry->column()));
        values.push_back(entry->value());
      }
      check(MatSetValues(matrix_, 1, &row, static_cast<PetscInt>(columns.size()), columns.data(), values.data(),
                         INSERT_VALUES),
            "take the matrix of the finite elements");
    }
    check(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY), "assemble the matrix of the finite elements");
    check(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY), "assemble the matrix of the finite elements");
    check(KSPSetOperators(solver_, matrix_, matrix_), "take the matrix of the finite elements");
    check(KSPSetUp(solver_), "prepare the solver of the finite elements");
  }

  void solve(Vector& v) override {
    PetscScalar* local = nullptr;
    check(VecGetArray(right_, &local), "reach a vector");
    std::copy(v.begin() + first_, v.begin() + end_, local);
    check(VecRestoreArray(right_, &local), "reach a vector");
    check(KSPSolve(solver_, right_, solution_), "solve the equations of the finite elements");
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    KSPGetConvergedReason(solver_, &reason);
    if (reason < 0) fail(reason);
    const PetscScalar* found = nullptr;
    check(VecGetArrayRead(solution_, &found), "reach a vector");
    MPI_Allgatherv(found, counts_[static_cast<std::size_t>(rank_)], MPI_DOUBLE, v.begin(), counts_.data(),
                   starts_.data(), MPI_DOUBLE, PETSC_COMM_WORLD);
    check(VecRestoreArrayRead(solution_, &found), "reach a vector");
  }

 private:
  [[noreturn]] void fail(KSPConvergedReason reason) const {
    if (kind_ == HeatLinearSolver::direct)
      throw SolverError(fmt::format("the equations of the finite elements were not solved by factorisation (PETSc: {})",
                                    KSPConvergedReasons[reason]));
    throw SolverError(
        fmt::format("the equations of the finite elements were not solved by multigrid in {} iterations (PETSc: {}).\n"
                    "       Thin bodies and interfaces of next to no resistance make it slow: fe.solver = \"direct\" "
                    "does without, if memory is enough.",
                    most_krylov_iterations, KSPConvergedReasons[reason]));
  }

  void prepare(const Matrix& matrix) {
    const auto n = static_cast<PetscInt>(matrix.m());
    check(VecCreateMPI(PETSC_COMM_WORLD, PETSC_DECIDE, n, &right_), "make a vector");
    check(VecDuplicate(right_, &solution_), "make a vector");
    check(VecGetOwnershipRange(right_, &first_, &end_), "distribute rows");
    int n_ranks = 1;
    MPI_Comm_size(PETSC_COMM_WORLD, &n_ranks);
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank_);
    const PetscInt* ranges = nullptr;
    check(VecGetOwnershipRanges(right_, &ranges), "distribute rows");
    for (int r = 0; r < n_ranks; ++r) {
      starts_.push_back(static_cast<int>(ranges[r]));
      counts_.push_back(static_cast<int>(ranges[r + 1] - ranges[r]));
    }
    std::vector<PetscInt> own, others;
    for (PetscInt row = first_; row < end_; ++row) {
      own.push_back(0);
      others.push_back(0);
      const auto number = static_cast<unsigned int>(row);
      for (auto entry = matrix.begin(number); entry != matrix.end(number); ++entry) {
        const auto column = static_cast<PetscInt>(entry->column());
        ++(column >= first_ && column < end_ ? own : others).back();
      }
    }
    check(MatCreateAIJ(PETSC_COMM_WORLD, end_ - first_, end_ - first_, n, n, 0, own.data(), 0, others.data(), &matrix_),
          "make a matrix");
    if (is_symmetric_) {
      check(MatSetOption(matrix_, MAT_SYMMETRIC, PETSC_TRUE), "make a matrix");
      check(MatSetOption(matrix_, MAT_SPD, PETSC_TRUE), "make a matrix");
    }
    make_solver();
  }

  void make_solver() {
    check(KSPCreate(PETSC_COMM_WORLD, &solver_), "make a solver");
    PC preconditioner = nullptr;
    check(KSPGetPC(solver_, &preconditioner), "make a solver");
    if (kind_ == HeatLinearSolver::direct) {
      check(KSPSetType(solver_, KSPPREONLY), "make a solver");
      check(PCSetType(preconditioner, is_symmetric_ ? PCCHOLESKY : PCLU), "make a solver");
      check(PCFactorSetMatSolverType(preconditioner, MATSOLVERMUMPS), "find MUMPS");
    } else {
      check(KSPSetType(solver_, is_symmetric_ ? KSPCG : KSPGMRES), "make a solver");
      if (!is_symmetric_) check(KSPSetPCSide(solver_, PC_RIGHT), "make a solver");
      check(KSPSetNormType(solver_, KSP_NORM_UNPRECONDITIONED), "make a solver");
      check(KSPSetTolerances(solver_, relative_residual, 0., 1e10, most_krylov_iterations), "make a solver");
      check(PCSetType(preconditioner, PCHYPRE), "find hypre");
      check(PCHYPRESetType(preconditioner, "boomeramg"), "find hypre's multigrid");
    }
    check(KSPSetFromOptions(solver_), "take the options in PETSC_OPTIONS");
  }

  const HeatLinearSolver kind_;
  const bool is_symmetric_;
  Mat matrix_ = nullptr;
  Vec right_ = nullptr, solution_ = nullptr;
  KSP solver_ = nullptr;
  PetscInt first_ = 0, end_ = 0;  ///< rows of this rank
  int rank_ = 0;
  std::vector<int> counts_, starts_;  ///< of all ranks
};

}  // namespace

bool has_several_ranks() { return number_in("OMPI_COMM_WORLD_SIZE") > 1 || number_in("PMI_SIZE") > 1; }

bool on_any_rank(bool own) {
  if (!has_several_ranks()) return own;
  start_petsc();
  const int mine = own ? 1 : 0;
  int any = 0;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_LOR, PETSC_COMM_WORLD);
  return any != 0;
}

std::unique_ptr<LinearSolver> make_petsc_solver(HeatLinearSolver kind, bool is_symmetric) {
  return std::make_unique<PetscSolver>(kind, is_symmetric);
}

}  // namespace rotordrop
