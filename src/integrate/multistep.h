#pragma once
// What the multistep methods of CVODES have in common.
#include <cvodes/cvodes.h>

#include "base/errors.h"
#include "integrate/integrator.h"
#include "integrate/sundials_problem.h"

namespace rotordrop {

/// Variable order and step, one step at a time up to an end. What solves the implicit equations is the derived class's.
class Multistep : public Integrator {
 public:
  ~Multistep() override { free_memory(); }

  [[nodiscard]] double time() const override { return time_; }
  [[nodiscard]] std::span<const double> state() const override { return problem_.values(); }

  void advance() override {
    const int code = CVode(memory_, end_time_, problem_.state(), &time_, CV_ONE_STEP);
    if (code >= 0) return;
    double step = 0.;
    CVodeGetCurrentStep(memory_, &step);
    problem_.fail(code, time_, step, problem_.weighted_error(memory_, CVodeGetEstLocalErrors, CVodeGetErrWeights));
  }

  void offer_rates(std::span<const double>) override {}  // its next evaluation is at the predicted state
  [[nodiscard]] bool uses_offered_rates() const override { return false; }

  void interpolate(double t, std::span<double> y) const override {
    problem_.take_interpolated(CVodeGetDky(memory_, t, 0, problem_.scratch()), y);
  }

  [[nodiscard]] IntegrationStatistics statistics() const override {
    IntegrationStatistics s;
    CVodeGetNumSteps(memory_, &s.steps);
    CVodeGetNumErrTestFails(memory_, &s.rejected_steps);
    s.rhs_evaluations = problem_.rhs_evaluations();
    return s;
  }

 protected:
  /// @param method  CV_ADAMS or CV_BDF
  Multistep(int method, const OdeSystem& system, double tolerance, double start_time, std::span<const double> state,
            double end_time)
      : problem_(system, state, tolerance), time_(start_time), end_time_(end_time) {
    memory_ = CVodeCreate(method, problem_.context());
    check(memory_ ? 0 : -1);
    check(CVodeSetErrHandlerFn(memory_, SundialsProblem::take_message, &problem_));
    check(CVodeInit(memory_, SundialsProblem::right_hand_side, start_time, problem_.state()));
    check(CVodeSetUserData(memory_, &problem_));
    check(CVodeSVtolerances(memory_, tolerance, problem_.absolute_tolerance()));
    check(CVodeSetMaxNumSteps(memory_, -1));
    check(CVodeSetMaxHnilWarns(memory_, -1));
    check(CVodeSetStopTime(memory_, end_time));
  }
  void check(int code) { is_good_ = is_good_ && code == 0; }
  /// For the end of the constructor. @throws SolverError if anything so far went wrong
  void require_good(const char* name) const {
    if (!is_good_) throw SolverError(std::string(name) + " could not be set up");
  }
  /// Before what solves the equations is freed.
  void free_memory() { CVodeFree(&memory_); }

  SundialsProblem problem_;
  void* memory_ = nullptr;

 private:
  bool is_good_ = true;
  double time_, end_time_;
};

}  // namespace rotordrop
