#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "integrate/multistep.h"

namespace rotordrop {
namespace {

/// Backward differences, Newton's method with a dense Jacobian of differences.
class Bdf final : public Multistep {
 public:
  Bdf(const OdeSystem& system, double tolerance, double start_time, std::span<const double> state, double end_time)
      : Multistep(CV_BDF, system, tolerance, start_time, state, end_time) {
    const auto n = static_cast<sunindextype>(state.size());
    matrix_ = SUNDenseMatrix(n, n, problem_.context());
    solver_ = SUNLinSol_Dense(problem_.state(), matrix_, problem_.context());
    check(matrix_ && solver_ ? 0 : -1);
    check(CVodeSetLinearSolver(memory_, solver_, matrix_));
    require_good("the integrator of backward differences");
  }
  ~Bdf() override {
    free_memory();
    SUNLinSolFree(solver_);
    SUNMatDestroy(matrix_);
  }

 private:
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
};

}  // namespace

std::unique_ptr<Integrator> make_stiff_integrator(const OdeSystem& system, double tolerance, double start_time,
                                                  std::span<const double> state, double end_time) {
  return std::make_unique<Bdf>(system, tolerance, start_time, state, end_time);
}

}  // namespace rotordrop
