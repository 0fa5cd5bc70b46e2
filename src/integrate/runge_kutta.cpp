#include <arkode/arkode_arkstep.h>

#include <array>
#include <cmath>
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

// ARKStep, not the leaner ERKStep: in SUNDIALS 6.4 ERKStep takes every method whose last node is 1 for one whose last stage is the next
// step's first ("FSAL"), and so loses the order of this one and of Fehlberg's.
class RungeKutta final : public Integrator {
 public:
  RungeKutta(const OdeSystem& system, const IntegrationParameters& parameters, double start_time,
             std::span<const double> state, double end_time)
      : problem_(system, state, parameters.tolerance), time_(start_time) {
    memory_ =
        ARKStepCreate(SundialsProblem::right_hand_side, nullptr, start_time, problem_.state(), problem_.context());
    bool good = memory_ != nullptr;
    const auto check = [&](int code) { good = good && code == 0; };
    check(ARKStepSetUserData(memory_, &problem_));
    check(ARKStepSetErrHandlerFn(memory_, SundialsProblem::take_message, &problem_));
    if (parameters.method == IntegrationMethod::runge_kutta_4) {
      ARKodeButcherTable table = classical_order_4();
      check(ARKStepSetTables(memory_, 4, 0, nullptr, table));
      ARKodeButcherTable_Free(table);
      // A whole number of steps, so that the last one is not a sliver; counted from zero, so that a resumed run takes the same ones.
      const double n_steps = std::ceil(end_time / step_or_bound(parameters) * (1. - 1e-9));
      check(ARKStepSetFixedStep(memory_, end_time / n_steps));
      fixed_ = true;
    } else {
      check(ARKStepSetTableNum(memory_, ARKODE_DIRK_NONE,
                               parameters.method == IntegrationMethod::dormand_prince ? ARKODE_DORMAND_PRINCE_7_4_5
                                                                                      : ARKODE_FEHLBERG_13_7_8));
      check(ARKStepSetMaxStep(memory_, step_or_bound(parameters)));
      check(ARKStepSetMinStep(memory_, shortest_step * step_or_bound(parameters)));
    }
    check(ARKStepSVtolerances(memory_, parameters.tolerance, problem_.absolute_tolerance()));
    check(ARKStepSetMaxNumSteps(memory_, -1));
    check(ARKStepSetMaxHnilWarns(memory_, -1));
    check(ARKStepSetStopTime(memory_, end_time));
    if (!good) throw SolverError("the Runge-Kutta integrator could not be set up");
    end_time_ = end_time;
  }
  ~RungeKutta() override { ARKStepFree(&memory_); }

  [[nodiscard]] double time() const override { return time_; }
  [[nodiscard]] std::span<const double> state() const override { return problem_.values(); }

  void advance() override {
    const double before = time_;
    const int code = ARKStepEvolve(memory_, end_time_, problem_.state(), &time_, ARK_ONE_STEP);
    if (code < 0) {
      std::vector<double> error;
      if (!fixed_) error = problem_.weighted_error(memory_, ARKStepGetEstLocalErrors, ARKStepGetErrWeights);
      double step = 0.;
      ARKStepGetCurrentStep(memory_, &step);
      problem_.fail(code, time_, step, error);
    }
    if (!fixed_) return;
    problem_.check_finite(time_);
    // Rounding leaves the last step short of the end by far less than a step.
    if (end_time_ - time_ < 1e-3 * (time_ - before)) time_ = end_time_;
  }

  void offer_rates(std::span<const double> rates) override { problem_.offer_rates(time_, problem_.values(), rates); }

  [[nodiscard]] bool uses_offered_rates() const override { return true; }

  void interpolate(double t, std::span<double> y) const override {
    problem_.take_interpolated(ARKStepGetDky(memory_, t, 0, problem_.scratch()), y);
  }

  [[nodiscard]] IntegrationStatistics statistics() const override {
    IntegrationStatistics s;
    ARKStepGetNumSteps(memory_, &s.steps);
    ARKStepGetNumErrTestFails(memory_, &s.rejected_steps);
    s.rhs_evaluations = problem_.rhs_evaluations();
    return s;
  }

 private:
  SundialsProblem problem_;
  void* memory_ = nullptr;
  double time_, end_time_ = 0;
  bool fixed_ = false;
};

}  // namespace

std::unique_ptr<Integrator> make_runge_kutta(const OdeSystem& system, const IntegrationParameters& parameters,
                                             double start_time, std::span<const double> state, double end_time) {
  return std::make_unique<RungeKutta>(system, parameters, start_time, state, end_time);
}

}  // namespace rotordrop
