#include "integrate/sundials_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "integrate/integrator.h"
#include "integrate/vector_operations.h"

namespace rotordrop {
namespace {

// x * 0 is 0 for finite x and NaN otherwise.
bool all_finite(std::span<const double> values) {
  double sum = 0.;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < values.size(); ++i) sum += values[i] * 0.;
  return sum == 0.;
}

}  // namespace

SundialsProblem::SundialsProblem(const OdeSystem& system, std::span<const double> state, double tolerance)
    : system_(system), n_(system.layout().size()) {
  if (SUNContext_Create(nullptr, &context_) != 0) throw SolverError("SUNDIALS could not be started");
  state_ = N_VNew_Serial(static_cast<sunindextype>(n_), context_);
  use_vectorised_operations(state_);
  tolerance_ = N_VClone(state_);
  scratch_ = N_VClone(state_);
  std::copy(state.begin(), state.end(), NV_DATA_S(state_));
  const auto& entries = system.layout().entries();
  for (std::size_t i = 0; i < n_; ++i)
    // Nothing depends on a quadrature: it follows the step that the others ask for.
    NV_DATA_S(tolerance_)[i] = i < system.first_quadrature() ? tolerance * entries[i].scale : 1e30;
}

SundialsProblem::~SundialsProblem() {
  N_VDestroy(state_);
  N_VDestroy(tolerance_);
  N_VDestroy(scratch_);
  SUNContext_Free(&context_);
}

int SundialsProblem::right_hand_side(realtype t, N_Vector y, N_Vector dydt, void* self) {
  auto& problem = *static_cast<SundialsProblem*>(self);
  const std::span<const double> state(NV_DATA_S(y), problem.n_);
  const std::span<double> rates(NV_DATA_S(dydt), problem.n_);
  ++problem.rhs_evaluations_;
  if (problem.is_offered_) {
    problem.is_offered_ = false;
    if (t == problem.offered_time_ && std::equal(state.begin(), state.end(), problem.offered_state_.begin())) {
      std::copy(problem.offered_rates_.begin(), problem.offered_rates_.end(), rates.begin());
      return 0;
    }
  }
  try {
    problem.system_.rhs(t, state, rates);
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

void SundialsProblem::take_message(int code, const char*, const char*, char* message, void* self) {
  if (code < 0) static_cast<SundialsProblem*>(self)->message_ = message;
}

std::string SundialsProblem::not_finite(std::span<const double> values) const {
  std::string list;
  int count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    if (++count <= 3) list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", system_.layout().describe(i));
  }
  if (count > 3) list += fmt::format(" and {} more", count - 3);
  return list;
}

void SundialsProblem::check_finite(double t) const {
  if (all_finite(values())) return;
  throw SolverError(
      fmt::format("the state is no longer finite at t = {:.6g} ms: {}.\n       Often the step is too long for the "
                  "stiffest contact.",
                  t * 1e3, not_finite(values())));
}

std::vector<double> SundialsProblem::weighted_error(void* memory, GetVector errors, GetVector weights) const {
  N_Vector error = N_VClone(state_), weight = N_VClone(state_);
  std::vector<double> product(n_);
  if (errors(memory, error) == 0 && weights(memory, weight) == 0)
    for (std::size_t i = 0; i < n_; ++i) product[i] = NV_DATA_S(error)[i] * NV_DATA_S(weight)[i];
  N_VDestroy(error);
  N_VDestroy(weight);
  return product;
}

void SundialsProblem::take_interpolated(int code, std::span<double> y) const {
  if (code != 0) throw SolverError("a time outside the last step was asked for");
  std::copy_n(NV_DATA_S(scratch_), y.size(), y.begin());
}

void SundialsProblem::fail(int, double t, double step, std::span<const double> weighted_error) const {
  if (exception_) std::rethrow_exception(exception_);
  if (!bad_rates_.empty())
    throw SolverError(fmt::format(
        "the rate of {} is not a finite number at t = {:.6g} ms (step {:.3g} s).\n"
        "       Often the step is too long for the stiffest contact, or a parameter is far out of its usual range.",
        not_finite(bad_rates_), t * 1e3, step));
  std::string text =
      fmt::format("the integrator could not take a step at t = {:.6g} ms (step {:.3g} s).", t * 1e3, step);
  if (!weighted_error.empty())
    text += "\n       Largest error: " + worst_components(system_.layout(), weighted_error) + ".";
  if (!message_.empty()) text += "\n       " + message_;
  throw SolverError(text);
}

}  // namespace rotordrop
