#include <arkode/arkode_erkstep.h>

#include <array>
#include <vector>

#include "base/errors.h"
#include "integrate/methods.h"
#include "integrate/sundials_problem.h"

namespace rotordrop {
namespace {

// The classical method of order 4 (Kutta 1901); ARKODE's own tables all carry an embedding, which a fixed step does not need.
ARKodeButcherTable classical_order_4() {
  std::array<realtype, 4> c = {0., 0.5, 0.5, 1.}, b = {1. / 6., 1. / 3., 1. / 3., 1. / 6.};
  std::array<realtype, 16> A = {0., 0., 0., 0., 0.5, 0., 0., 0., 0., 0.5, 0., 0., 0., 0., 1., 0.};
  return ARKodeButcherTable_Create(4, 4, 0, c.data(), A.data(), b.data(), nullptr);
}

class RungeKutta final : public Integrator {
 public:
  RungeKutta(const OdeSystem& system, const IntegrationParameters& parameters, double start_time, std::span<const double> state, double end_time)
      : problem_(system, state, parameters.tolerance), time_(start_time) {
    memory_ = ERKStepCreate(SundialsProblem::right_hand_side, start_time, problem_.state(), problem_.context());
    bool good = memory_ != nullptr;
    const auto check = [&](int code) { good = good && code == 0; };
    check(ERKStepSetUserData(memory_, &problem_));
    check(ERKStepSetErrHandlerFn(memory_, SundialsProblem::take_message, &problem_));
    if (parameters.method == IntegrationMethod::runge_kutta_4) {
      ARKodeButcherTable table = classical_order_4();
      check(ERKStepSetTable(memory_, table));
      ARKodeButcherTable_Free(table);
      check(ERKStepSetFixedStep(memory_, parameters.step));
      fixed_ = true;
    } else {
      check(ERKStepSetTableNum(memory_, parameters.method == IntegrationMethod::dormand_prince ? ARKODE_DORMAND_PRINCE_7_4_5
                                                                                              : ARKODE_FEHLBERG_13_7_8));
      check(ERKStepSetMaxStep(memory_, parameters.maximum_step));
    }
    check(ERKStepSVtolerances(memory_, parameters.tolerance, problem_.absolute_tolerance()));
    check(ERKStepSetMaxNumSteps(memory_, -1));
    check(ERKStepSetMaxHnilWarns(memory_, -1));
    check(ERKStepSetStopTime(memory_, end_time));
    if (!good) throw SolverError("the Runge-Kutta integrator could not be set up");
    end_time_ = end_time;
  }
  ~RungeKutta() override { ERKStepFree(&memory_); }

  [[nodiscard]] double time() const override { return time_; }
  [[nodiscard]] std::span<const double> state() const override { return problem_.values(); }

  void advance() override {
    const int code = ERKStepEvolve(memory_, end_time_, problem_.state(), &time_, ARK_ONE_STEP);
    if (code < 0) {
      std::vector<double> error;
      if (!fixed_) error = weighted_error();
      double step = 0.;
      ERKStepGetCurrentStep(memory_, &step);
      problem_.fail(code, time_, step, error);
    }
    if (fixed_) problem_.check_finite(time_);
  }

  void interpolate(double t, std::span<double> y) const override {
    N_Vector out = N_VMake_Serial(static_cast<sunindextype>(y.size()), y.data(), problem_.context());
    const int code = ERKStepGetDky(memory_, t, 0, out);
    N_VDestroy(out);
    if (code != 0) throw SolverError("a time outside the last step was asked for");
  }

  [[nodiscard]] IntegrationStatistics statistics() const override {
    IntegrationStatistics s;
    ERKStepGetNumSteps(memory_, &s.steps);
    ERKStepGetNumErrTestFails(memory_, &s.rejected_steps);
    s.rhs_evaluations = problem_.rhs_evaluations();
    return s;
  }

 private:
  [[nodiscard]] std::vector<double> weighted_error() const {
    N_Vector error = problem_.clone(), weight = problem_.clone();
    std::vector<double> product(problem_.values().size());
    if (ERKStepGetEstLocalErrors(memory_, error) == 0 && ERKStepGetErrWeights(memory_, weight) == 0)
      for (std::size_t i = 0; i < product.size(); ++i) product[i] = N_VGetArrayPointer(error)[i] * N_VGetArrayPointer(weight)[i];
    N_VDestroy(error);
    N_VDestroy(weight);
    return product;
  }

  SundialsProblem problem_;
  void* memory_ = nullptr;
  double time_, end_time_ = 0;
  bool fixed_ = false;
};

}  // namespace

std::unique_ptr<Integrator> make_runge_kutta(const OdeSystem& system, const IntegrationParameters& parameters, double start_time,
                                             std::span<const double> state, double end_time) {
  return std::make_unique<RungeKutta>(system, parameters, start_time, state, end_time);
}

}  // namespace rotordrop
