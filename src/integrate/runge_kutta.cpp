#include <arkode/arkode_arkstep.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "integrate/integrator.h"
#include "integrate/methods.h"
#include "integrate/pairs.h"
#include "integrate/sundials_integrator.h"

namespace rotordrop {
namespace {

// The classical method of order 4 (Kutta 1901); ARKODE's own tables all carry an embedding, which a fixed step does not need.
ARKodeButcherTable classical_order_4() {
  std::array<realtype, 4> c = {0., 0.5, 0.5, 1.}, b = {1. / 6., 1. / 3., 1. / 3., 1. / 6.};
  std::array<realtype, 16> A = {0., 0., 0., 0., 0.5, 0., 0., 0., 0., 0.5, 0., 0., 0., 0., 1., 0.};
  return ARKodeButcherTable_Create(4, 4, 0, c.data(), A.data(), b.data(), nullptr);
}

int restart_arkode(void* memory, realtype t, N_Vector y) {
  return ARKStepReInit(memory, SundialsProblem::right_hand_side, nullptr, t, y);
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
                                            .restart = restart_arkode,
                                            .set_max_step = ARKStepSetMaxStep,
                                            .set_min_step = ARKStepSetMinStep,
                                            .free = ARKStepFree};

// ARKStep, not the leaner ERKStep: in SUNDIALS 6.4 ERKStep takes every method whose last node is 1 for one whose last stage is the next
// step's first ("FSAL"), and so loses the order of the classical method and of Fehlberg's.
class RungeKutta : public SundialsIntegrator {
 public:
  void offer_rates(std::span<const double> rates) override { problem_.offer_rates(time_, problem_.values(), rates); }
  [[nodiscard]] bool uses_offered_rates() const override { return true; }

 protected:
  RungeKutta(const OdeSystem& system, const IntegrationParameters& parameters, double start_time,
             std::span<const double> state, double end_time)
      : SundialsIntegrator(arkode_library, system, parameters.tolerance, start_time, state, end_time) {
    adopt(ARKStepCreate(SundialsProblem::right_hand_side, nullptr, start_time, problem_.state(), problem_.context()));
  }
  void require_good() const { SundialsIntegrator::require_good("the Runge-Kutta integrator"); }
};

class ErrorControlled final : public RungeKutta {
 public:
  ErrorControlled(const OdeSystem& system, const IntegrationParameters& parameters, double start_time,
                  std::span<const double> state, double end_time)
      : RungeKutta(system, parameters, start_time, state, end_time) {
    check(ARKStepSetTableNum(
        memory_, ARKODE_DIRK_NONE,
        parameters.method == IntegrationMethod::dormand_prince ? ARKODE_DORMAND_PRINCE_7_4_5 : ARKODE_FEHLBERG_13_7_8));
    bound_steps(step_or_bound(parameters), shortest_step);
    require_good();
  }
};

/// The classical method with fixed steps; between them Hermite's cubic. ARKODE 6.4 has that, too, but takes the last stage's rates for those at the end of
/// a step, since its node is 1; they differ by terms of third order.
class FixedStep final : public RungeKutta {
 public:
  FixedStep(const OdeSystem& system, const IntegrationParameters& parameters, double start_time,
            std::span<const double> state, double end_time)
      : RungeKutta(system, parameters, start_time, state, end_time),
        system_(system),
        before_(state.size()),
        rates_before_(state.size()),
        rates_(state.size()) {
    ARKodeButcherTable table = classical_order_4();
    check(ARKStepSetTables(memory_, 4, 0, nullptr, table));
    ARKodeButcherTable_Free(table);
    step_ = step_or_bound(parameters);
    fix_step();
    has_error_control_ = false;
    require_good();
  }

  void advance() override {
    if (time_ >= piece_end_) begin_piece();
    const double start = time_;
    std::ranges::copy(state(), before_.begin());
    if (!has_rates_) problem_.offer_rates(time_, state(), rates());
    rates_before_.swap(rates_);
    has_rates_ = false;
    SundialsIntegrator::advance();
    problem_.check_finite(time_);
    // Rounding leaves the last step short of the end by far less than a step.
    if (piece_end_ - time_ < 1e-3 * (time_ - start)) time_ = piece_end_;
    last_step_ = time_ - start;
    is_at_end_of_step_ = true;
  }

  void offer_rates(std::span<const double> rates) override {
    RungeKutta::offer_rates(rates);
    std::ranges::copy(rates, rates_.begin());
    has_rates_ = true;
  }

  void interpolate(double t, std::span<double> y) const override {
    const double theta = part_of_step(t, time_, last_step_), rest = 1. - theta;
    const double of_after = theta * theta * (3. - 2. * theta), of_rates_before = last_step_ * theta * rest * rest,
                 of_rates_after = -last_step_ * theta * theta * rest;
    const auto after = state();
    const auto& rates_after = rates();
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] = before_[i] + of_after * (after[i] - before_[i]) + of_rates_before * rates_before_[i] +
             of_rates_after * rates_after[i];
  }

 private:
  /// A whole number of steps up to where they have to end, so that the last one is not a sliver; counted from zero or from the instant before, so that a
  /// resumed run takes the same ones.
  void fix_step() {
    const double length = piece_end_ - instants_.last(time_);
    check(ARKStepSetFixedStep(memory_, length / std::ceil(length / step_ * (1. - 1e-9))));
  }
  void begin_piece() override {
    has_rates_ = is_at_end_of_step_ = false;
    RungeKutta::begin_piece();
    fix_step();
  }
  /// At time(), evaluated unless somebody has offered them.
  const std::vector<double>& rates() const {
    if (!has_rates_) system_.rhs(is_at_end_of_step_ ? instants_.before(time_) : time_, state(), rates_);
    has_rates_ = true;
    return rates_;
  }

  const OdeSystem& system_;
  std::vector<double> before_, rates_before_;  ///< at the last step's start
  double step_ = 0, last_step_ = 0;            // as asked for, the last one [s]
  bool is_at_end_of_step_ = false;
  mutable std::vector<double> rates_;
  mutable bool has_rates_ = false;
};

}  // namespace

std::unique_ptr<Integrator> make_runge_kutta(const OdeSystem& system, const IntegrationParameters& parameters,
                                             double start_time, std::span<const double> state, double end_time) {
  if (parameters.method == IntegrationMethod::runge_kutta_4)
    return std::make_unique<FixedStep>(system, parameters, start_time, state, end_time);
  return std::make_unique<ErrorControlled>(system, parameters, start_time, state, end_time);
}

}  // namespace rotordrop
