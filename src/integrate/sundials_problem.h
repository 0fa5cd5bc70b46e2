#pragma once
// The one place where our systems meet SUNDIALS' C interface: vectors, right-hand side, exceptions as return codes, errors in words.
#include <nvector/nvector_serial.h>

#include <exception>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "integrate/sundials_memory.h"
#include "model/ode_system.h"

namespace rotordrop {

class SundialsProblem {
 public:
  /// @param tolerance  relative; the absolute tolerance of an entry is this times its scale
  SundialsProblem(const OdeSystem& system, std::span<const double> state, double tolerance);
  SundialsProblem(const SundialsProblem&) = delete;
  SundialsProblem& operator=(const SundialsProblem&) = delete;

  /// Right-hand side in SUNDIALS' form; `self` is the problem. 0, 1 (trial state out of range: try a smaller step), -1 (exception kept).
  static int right_hand_side(realtype t, N_Vector y, N_Vector dydt, void* self);
  /// Tells the rates at a state that the caller has evaluated anyway; if the method asks for just these next, they are not computed again.
  void offer_rates(double t, std::span<const double> y, std::span<const double> rates);
  /// No such rates are known any more; rates are evaluated up to a time only, whatever rounding does (Instants::latest()).
  void begin_anew(double latest);
  /// Takes SUNDIALS' own messages, so that they do not reach the screen. `self` is the problem.
  static void take_message(int code, const char* module, const char* function, char* message, void* self);

  [[nodiscard]] SUNContext context() const { return context_.get(); }
  [[nodiscard]] N_Vector state() const { return state_.get(); }
  [[nodiscard]] N_Vector absolute_tolerance() const { return tolerance_.get(); }
  [[nodiscard]] std::span<double> values() const { return {NV_DATA_S(state_.get()), n_}; }
  [[nodiscard]] long rhs_evaluations() const { return rhs_evaluations_; }
  /// A vector for SUNDIALS to write to, apart from the state.
  [[nodiscard]] N_Vector scratch() const { return scratch_.get(); }

  /// Errors of the last test over what the tolerance allows [n]; zeros if the method cannot tell.
  using GetVector = int (*)(void* memory, N_Vector);
  [[nodiscard]] std::vector<double> weighted_error(void* memory, GetVector errors, GetVector weights) const;
  /// Copies what `code` says was found in scratch(). @throws SolverError for a time outside the last step
  void take_interpolated(int code, std::span<double> y) const;
  /// Throws for a failed step: the kept exception if there is one, else a SolverError that names time, step, cause and components.
  /// @param weighted_error  [n] of the last error test; empty if the method has none
  [[noreturn]] void fail(double t, double step, std::span<const double> weighted_error) const;
  /// @throws SolverError if the state holds a value that is not finite
  void check_finite(double t) const;

 private:
  const OdeSystem& system_;
  std::size_t n_;
  OwnedContext context_;
  OwnedVector state_, tolerance_, scratch_;
  std::exception_ptr exception_;
  std::string message_;
  std::vector<double> bad_rates_;  // the last rates that were not finite
  long rhs_evaluations_ = 0;
  double latest_ = std::numeric_limits<double>::infinity();  // [s]
  double offered_time_ = 0;
  std::vector<double> offered_state_, offered_rates_;
  bool is_offered_ = false;
};

}  // namespace rotordrop
