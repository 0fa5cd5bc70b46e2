#pragma once
// What the multistep methods of CVODES have in common.
#include <cvodes/cvodes.h>

#include "integrate/sundials_integrator.h"

namespace rotordrop {

inline constexpr SundialsLibrary cvodes_library = {.one_step = CV_ONE_STEP,
                                                   .evolve = CVode,
                                                   .get_derivative = CVodeGetDky,
                                                   .get_current_step = CVodeGetCurrentStep,
                                                   .get_n_steps = CVodeGetNumSteps,
                                                   .get_n_rejected = CVodeGetNumErrTestFails,
                                                   .get_local_errors = CVodeGetEstLocalErrors,
                                                   .get_error_weights = CVodeGetErrWeights,
                                                   .set_user_data = CVodeSetUserData,
                                                   .set_error_handler = CVodeSetErrHandlerFn,
                                                   .set_tolerances = CVodeSVtolerances,
                                                   .set_max_n_steps = CVodeSetMaxNumSteps,
                                                   .set_max_warnings = CVodeSetMaxHnilWarns,
                                                   .set_stop_time = CVodeSetStopTime,
                                                   .restart = CVodeReInit,
                                                   .set_max_step = CVodeSetMaxStep,
                                                   .set_min_step = CVodeSetMinStep,
                                                   .free = CVodeFree};

/// Variable order and step. The derived class owns what solves the implicit equations.
class Multistep : public SundialsIntegrator {
 public:
  void offer_rates(std::span<const double>) override {}  // its next evaluation is at the predicted state
  [[nodiscard]] bool uses_offered_rates() const override { return false; }

 protected:
  /// @param method  CV_ADAMS or CV_BDF
  Multistep(int method, const OdeSystem& system, double tolerance, double start_time, std::span<const double> state,
            double end_time)
      : SundialsIntegrator(cvodes_library, system, tolerance, start_time, state, end_time) {
    void* memory = CVodeCreate(method, problem_.context());
    if (memory) check(CVodeInit(memory, SundialsProblem::right_hand_side, start_time, problem_.state()));
    adopt(memory);
  }
};

}  // namespace rotordrop
