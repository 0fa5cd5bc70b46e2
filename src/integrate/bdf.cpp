#include <cvodes/cvodes.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <vector>

#include "base/errors.h"
#include "integrate/integrator.h"
#include "integrate/sundials_problem.h"

namespace rotordrop {
namespace {

/// Backward differences of variable order and step (CVODES), Newton's method with a dense Jacobian of differences.
class Bdf final : public Integrator {
 public:
  Bdf(const OdeSystem& system, double tolerance, double start_time, std::span<const double> state, double end_time)
      : problem_(system, state, tolerance), time_(start_time), end_time_(end_time) {
    const auto n = static_cast<sunindextype>(state.size());
    memory_ = CVodeCreate(CV_BDF, problem_.context());
    matrix_ = SUNDenseMatrix(n, n, problem_.context());
    solver_ = SUNLinSol_Dense(problem_.state(), matrix_, problem_.context());
    bool good = memory_ != nullptr && matrix_ != nullptr && solver_ != nullptr;
    const auto check = [&](int code) { good = good && code == 0; };
    check(CVodeSetErrHandlerFn(memory_, SundialsProblem::take_message, &problem_));
    check(CVodeInit(memory_, SundialsProblem::right_hand_side, start_time, problem_.state()));
    check(CVodeSetUserData(memory_, &problem_));
    check(CVodeSVtolerances(memory_, tolerance, problem_.absolute_tolerance()));
    check(CVodeSetLinearSolver(memory_, solver_, matrix_));
    check(CVodeSetMaxNumSteps(memory_, -1));
    check(CVodeSetMaxHnilWarns(memory_, -1));
    check(CVodeSetStopTime(memory_, end_time));
    if (!good) throw SolverError("the integrator of backward differences could not be set up");
  }
  ~Bdf() override {
    CVodeFree(&memory_);
    SUNLinSolFree(solver_);
    SUNMatDestroy(matrix_);
  }

  [[nodiscard]] double time() const override { return time_; }
  [[nodiscard]] std::span<const double> state() const override { return problem_.values(); }

  void advance() override {
    const int code = CVode(memory_, end_time_, problem_.state(), &time_, CV_ONE_STEP);
    if (code >= 0) return;
    double step = 0.;
    CVodeGetCurrentStep(memory_, &step);
    problem_.fail(code, time_, step, weighted_error());
  }

  void offer_rates(std::span<const double>) override {}  // its next evaluation is at the predicted state
  [[nodiscard]] bool uses_offered_rates() const override { return false; }

  void interpolate(double t, std::span<double> y) const override {
    if (CVodeGetDky(memory_, t, 0, problem_.scratch()) != 0)
      throw SolverError("a time outside the last step was asked for");
    std::copy_n(NV_DATA_S(problem_.scratch()), y.size(), y.begin());
  }

  [[nodiscard]] IntegrationStatistics statistics() const override {
    IntegrationStatistics s;
    CVodeGetNumSteps(memory_, &s.steps);
    CVodeGetNumErrTestFails(memory_, &s.rejected_steps);
    s.rhs_evaluations = problem_.rhs_evaluations();
    return s;
  }

 private:
  [[nodiscard]] std::vector<double> weighted_error() const {
    N_Vector error = problem_.clone(), weight = problem_.clone();
    std::vector<double> product(problem_.values().size());
    if (CVodeGetEstLocalErrors(memory_, error) == 0 && CVodeGetErrWeights(memory_, weight) == 0)
      for (std::size_t i = 0; i < product.size(); ++i) product[i] = NV_DATA_S(error)[i] * NV_DATA_S(weight)[i];
    N_VDestroy(error);
    N_VDestroy(weight);
    return product;
  }

  SundialsProblem problem_;
  void* memory_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
  double time_, end_time_;
};

}  // namespace

std::unique_ptr<Integrator> make_stiff_integrator(const OdeSystem& system, double tolerance, double start_time,
                                                  std::span<const double> state, double end_time) {
  return std::make_unique<Bdf>(system, tolerance, start_time, state, end_time);
}

}  // namespace rotordrop
