#include <arkode/arkode_arkstep.h>

#include <array>
#include <cmath>

#include "integrate/integrator.h"
#include "integrate/methods.h"
#include "integrate/sundials_integrator.h"

namespace rotordrop {
namespace {

// The classical method of order 4 (Kutta 1901); ARKODE's own tables all carry an embedding, which a fixed step does not need.
ARKodeButcherTable classical_order_4() {
  std::array<realtype, 4> c = {0., 0.5, 0.5, 1.}, b = {1. / 6., 1. / 3., 1. / 3., 1. / 6.};
  std::array<realtype, 16> A = {0., 0., 0., 0., 0.5, 0., 0., 0., 0., 0.5, 0., 0., 0., 0., 1., 0.};
  return ARKodeButcherTable_Create(4, 4, 0, c.data(), A.data(), b.data(), nullptr);
}

constexpr SundialsLibrary arkode_library = {.one_step = ARK_ONE_STEP,
                                            .evolve = ARKStepEvolve,
                                            .get_derivative = ARKStepGetDky,
                                            .get_current_step = ARKStepGetCurrentStep,
                                            .get_n_steps = ARKStepGetNumSteps,
                                            .get_n_rejected = ARKStepGetNumErrTestFails,
                                            .get_local_errors = ARKStepGetEstLocalErrors,
                                            .get_error_weights = ARKStepGetErrWeights,
                                            .set_user_data = ARKStepSetUserData,
                                            .set_error_handler = ARKStepSetErrHandlerFn,
                                            .set_tolerances = ARKStepSVtolerances,
                                            .set_max_n_steps = ARKStepSetMaxNumSteps,
                                            .set_max_warnings = ARKStepSetMaxHnilWarns,
                                            .set_stop_time = ARKStepSetStopTime,
                                            .set_max_step = ARKStepSetMaxStep,
                                            .set_min_step = ARKStepSetMinStep,
                                            .free = ARKStepFree};

// ARKStep, not the leaner ERKStep: in SUNDIALS 6.4 ERKStep takes every method whose last node is 1 for one whose last stage is the next
// step's first ("FSAL"), and so loses the order of this one and of Fehlberg's.
class RungeKutta final : public SundialsIntegrator {
 public:
  RungeKutta(const OdeSystem& system, const IntegrationParameters& parameters, double start_time,
             std::span<const double> state, double end_time)
      : SundialsIntegrator(arkode_library, system, parameters.tolerance, start_time, state, end_time) {
    adopt(ARKStepCreate(SundialsProblem::right_hand_side, nullptr, start_time, problem_.state(), problem_.context()));
    if (parameters.method == IntegrationMethod::runge_kutta_4) {
      ARKodeButcherTable table = classical_order_4();
      check(ARKStepSetTables(memory_, 4, 0, nullptr, table));
      ARKodeButcherTable_Free(table);
      // A whole number of steps, so that the last one is not a sliver; counted from zero, so that a resumed run takes the same ones.
      const double n_steps = std::ceil(end_time / step_or_bound(parameters) * (1. - 1e-9));
      check(ARKStepSetFixedStep(memory_, end_time / n_steps));
      has_error_control_ = false;
    } else {
      check(ARKStepSetTableNum(memory_, ARKODE_DIRK_NONE,
                               parameters.method == IntegrationMethod::dormand_prince ? ARKODE_DORMAND_PRINCE_7_4_5
                                                                                      : ARKODE_FEHLBERG_13_7_8));
      bound_steps(step_or_bound(parameters), shortest_step);
    }
    require_good("the Runge-Kutta integrator");
  }

  void advance() override {
    const double before = time_;
    SundialsIntegrator::advance();
    if (has_error_control_) return;
    problem_.check_finite(time_);
    // Rounding leaves the last step short of the end by far less than a step.
    if (end_time_ - time_ < 1e-3 * (time_ - before)) time_ = end_time_;
  }

  void offer_rates(std::span<const double> rates) override { problem_.offer_rates(time_, problem_.values(), rates); }
  [[nodiscard]] bool uses_offered_rates() const override { return true; }
};

}  // namespace

std::unique_ptr<Integrator> make_runge_kutta(const OdeSystem& system, const IntegrationParameters& parameters,
                                             double start_time, std::span<const double> state, double end_time) {
  return std::make_unique<RungeKutta>(system, parameters, start_time, state, end_time);
}

}  // namespace rotordrop
