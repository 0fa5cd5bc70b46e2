#pragma once
// What the integrators of SUNDIALS have in common: CVODES and ARKODE have the same functions under other names.
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "base/errors.h"
#include "integrate/integrator.h"
#include "integrate/sundials_problem.h"
#include "model/instants.h"

namespace rotordrop {

/// The functions of one library of SUNDIALS.
struct SundialsLibrary {
  int one_step;  ///< task of `evolve`: return after each internal step
  int (*evolve)(void*, realtype, N_Vector, realtype*, int);
  int (*get_derivative)(void*, realtype, int, N_Vector);
  int (*get_current_step)(void*, realtype*);
  int (*get_n_steps)(void*, long int*);
  int (*get_n_rejected)(void*, long int*);
  int (*get_local_errors)(void*, N_Vector);
  int (*get_error_weights)(void*, N_Vector);
  int (*set_user_data)(void*, void*);
  int (*set_error_handler)(void*, void (*)(int, const char*, const char*, char*, void*), void*);
  int (*set_tolerances)(void*, realtype, N_Vector);
  int (*set_max_n_steps)(void*, long int);
  int (*set_max_warnings)(void*, int);
  int (*set_stop_time)(void*, realtype);
  int (*restart)(void*, realtype, N_Vector);
  int (*set_max_step)(void*, realtype);
  int (*set_min_step)(void*, realtype);
  void (*free)(void**);
};

/// One step at a time up to an end. The derived class chooses the method.
class SundialsIntegrator : public Integrator {
 public:
  SundialsIntegrator(const SundialsIntegrator&) = delete;
  SundialsIntegrator& operator=(const SundialsIntegrator&) = delete;
  ~SundialsIntegrator() override { free_memory(); }

  [[nodiscard]] double time() const override { return time_; }
  [[nodiscard]] std::span<const double> state() const override { return problem_.values(); }

  void advance() override {
    if (time_ >= piece_end_) begin_piece();
    const int code = library_.evolve(memory_, end_time_, problem_.state(), &time_, library_.one_step);
    reached_ = time_;
    if (code >= 0) return;
    std::vector<double> error;
    if (has_error_control_)
      error = problem_.weighted_error(memory_, library_.get_local_errors, library_.get_error_weights);
    double step = 0.;
    library_.get_current_step(memory_, &step);
    problem_.fail(time_, step, error);
  }

  void interpolate(double t, std::span<double> y) const override {
    // The run's end may lie a rounding beyond what the library calls its last step.
    const double inside = t <= time_ ? std::min(t, reached_) : t;
    problem_.take_interpolated(library_.get_derivative(memory_, inside, 0, problem_.scratch()), y);
  }

  [[nodiscard]] IntegrationStatistics statistics() const override {
    IntegrationStatistics s;
    library_.get_n_steps(memory_, &s.steps);
    library_.get_n_rejected(memory_, &s.rejected_steps);
    s.steps += earlier_.steps;
    s.rejected_steps += earlier_.rejected_steps;
    s.rhs_evaluations = problem_.rhs_evaluations();
    return s;
  }

 protected:
  SundialsIntegrator(const SundialsLibrary& library, const OdeSystem& system, double tolerance, double start_time,
                     std::span<const double> state, double end_time)
      : problem_(system, state, tolerance),
        time_(start_time),
        end_time_(end_time),
        instants_(system.instants(), end_time),
        piece_end_(instants_.next(start_time)),
        library_(library),
        tolerance_(tolerance) {}

  /// Takes the memory of a method that was created, and sets what is the same for all.
  void adopt(void* memory) {
    memory_ = memory;
    check(memory_ ? 0 : -1);
    check(library_.set_user_data(memory_, &problem_));
    check(library_.set_error_handler(memory_, SundialsProblem::take_message, &problem_));
    check(library_.set_tolerances(memory_, tolerance_, problem_.absolute_tolerance()));
    check(library_.set_max_n_steps(memory_, -1));
    check(library_.set_max_warnings(memory_, -1));
    check(library_.set_stop_time(memory_, piece_end_));
    problem_.begin_anew(instants_.latest(piece_end_));
  }
  /// After an instant of the system the method begins anew, up to the next one.
  virtual void begin_piece() {
    earlier_ = statistics();
    piece_end_ = instants_.next(time_);
    problem_.begin_anew(instants_.latest(piece_end_));
    check(library_.restart(memory_, time_, problem_.state()));
    check(library_.set_stop_time(memory_, piece_end_));
    IntegrationStatistics kept;  // in which the library goes on counting
    library_.get_n_steps(memory_, &kept.steps);
    library_.get_n_rejected(memory_, &kept.rejected_steps);
    earlier_.steps -= kept.steps;
    earlier_.rejected_steps -= kept.rejected_steps;
    require_good("the integrator, after an instant,");
  }
  /// Longest step [s]; the shortest follows from it.
  void bound_steps(double longest, double shortest_part) {
    check(library_.set_max_step(memory_, longest));
    check(library_.set_min_step(memory_, shortest_part * longest));
  }
  void check(int code) { is_good_ = is_good_ && code == 0; }
  /// For the end of the constructor. @throws SolverError if anything so far went wrong
  void require_good(const char* name) const {
    if (!is_good_) throw SolverError(std::string(name) + " could not be set up");
  }
  /// Before what the memory refers to is freed.
  void free_memory() {
    if (memory_) library_.free(&memory_);
  }

  SundialsProblem problem_;
  void* memory_ = nullptr;
  double time_, end_time_;
  Instants instants_;
  double piece_end_;  ///< where steps have to end [s]
  bool has_error_control_ = true;

 private:
  const SundialsLibrary& library_;
  double tolerance_;
  double reached_ = -std::numeric_limits<double>::infinity();  // time of the library's last step [s]
  bool is_good_ = true;
  IntegrationStatistics earlier_;  // steps before the last restart
};

}  // namespace rotordrop
