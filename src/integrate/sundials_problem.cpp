#include "integrate/sundials_problem.h"

#include <algorithm>

#include "base/errors.h"
#include "integrate/failures.h"
#include "integrate/vector_operations.h"

namespace rotordrop {
SundialsProblem::SundialsProblem(const OdeSystem& system, std::span<const double> state, double tolerance)
    : system_(system), n_(system.layout().size()), context_(new_sundials_context()) {
  if (!context_) throw SolverError("SUNDIALS could not be started");
  state_.reset(N_VNew_Serial(static_cast<sunindextype>(n_), context_.get()));
  use_vectorised_operations(state_.get());
  tolerance_.reset(N_VClone(state_.get()));
  scratch_.reset(N_VClone(state_.get()));
  std::copy(state.begin(), state.end(), NV_DATA_S(state_.get()));
  const auto& entries = system.layout().entries();
  for (std::size_t i = 0; i < n_; ++i)
    // Nothing depends on a quadrature: it follows the step that the others ask for.
    NV_DATA_S(tolerance_.get())[i] = i < system.first_quadrature() ? tolerance * entries[i].scale : 1e30;
}

int SundialsProblem::right_hand_side(realtype t, N_Vector y, N_Vector dydt, void* self) {
  auto& problem = *static_cast<SundialsProblem*>(self);
  const std::span<const double> state(NV_DATA_S(y), problem.n_);
  const std::span<double> rates(NV_DATA_S(dydt), problem.n_);
  ++problem.rhs_evaluations_;
  // Interpolants and repeated steps ask for them too, some after other states.
  if (problem.is_offered_ && t == problem.offered_time_ &&
      std::equal(state.begin(), state.end(), problem.offered_state_.begin())) {
    std::copy(problem.offered_rates_.begin(), problem.offered_rates_.end(), rates.begin());
    return 0;
  }
  try {
    problem.system_.rhs(std::min(t, problem.latest_), state, rates);
  } catch (...) {
    problem.exception_ = std::current_exception();
    return -1;
  }
  if (all_finite(rates)) {
    problem.bad_rates_.clear();
    return 0;
  }
  problem.bad_rates_.assign(rates.begin(), rates.end());
  return 1;
}

void SundialsProblem::offer_rates(double t, std::span<const double> y, std::span<const double> rates) {
  offered_time_ = t;
  offered_state_.assign(y.begin(), y.end());
  offered_rates_.assign(rates.begin(), rates.end());
  is_offered_ = all_finite(rates);
}

void SundialsProblem::begin_anew(double latest) {
  is_offered_ = false;
  latest_ = latest;
}

void SundialsProblem::take_message(int code, const char*, const char*, char* message, void* self) {
  if (code < 0) static_cast<SundialsProblem*>(self)->message_ = message;
}

void SundialsProblem::check_finite(double t) const {
  if (!all_finite(values())) throw_state_not_finite(system_.layout(), values(), t);
}

std::vector<double> SundialsProblem::weighted_error(void* memory, GetVector errors, GetVector weights) const {
  const OwnedVector error(N_VClone(state_.get())), weight(N_VClone(state_.get()));
  std::vector<double> product(n_);
  if (errors(memory, error.get()) == 0 && weights(memory, weight.get()) == 0)
    for (std::size_t i = 0; i < n_; ++i) product[i] = NV_DATA_S(error.get())[i] * NV_DATA_S(weight.get())[i];
  return product;
}

void SundialsProblem::take_interpolated(int code, std::span<double> y) const {
  if (code != 0) throw SolverError("a time outside the last step was asked for");
  std::copy_n(NV_DATA_S(scratch_.get()), y.size(), y.begin());
}

void SundialsProblem::fail(double t, double step, std::span<const double> weighted_error) const {
  if (exception_) std::rethrow_exception(exception_);
  if (!bad_rates_.empty()) throw_rates_not_finite(system_.layout(), bad_rates_, t, step);
  throw_no_step(system_.layout(), t, step, weighted_error, message_);
}

}  // namespace rotordrop
