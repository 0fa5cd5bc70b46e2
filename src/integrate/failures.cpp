#include "integrate/failures.h"

#include <fmt/format.h>

#include <cmath>

#include "base/errors.h"
#include "base/wide_vectors.h"
#include "integrate/integrator.h"

namespace rotordrop {
namespace {

std::string not_finite(const StateLayout& layout, std::span<const double> values) {
  std::string list;
  int count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    if (++count <= 3) list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", layout.describe(i));
  }
  if (count > 3) list += fmt::format(" and {} more", count - 3);
  return list;
}

// x * 0 is 0 for finite x and NaN otherwise.
ROTORDROP_KERNEL bool are_finite(const double* values, std::size_t n) {
  double sum = 0.;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < n; ++i) sum += values[i] * 0.;
  return sum == 0.;
}

}  // namespace

bool all_finite(std::span<const double> values) { return wide<are_finite>(values.data(), values.size()); }

void throw_rates_not_finite(const StateLayout& layout, std::span<const double> rates, double t, double step) {
  throw SolverError(
      fmt::format("the rate of {} is not a finite number at t = {:.6g} ms (step {:.3g} s).\n"
                  "       A common cause: the time step is too long for the stiffest contact, or a parameter is far "
                  "outside its usual range.",
                  not_finite(layout, rates), t * 1e3, step));
}

void throw_state_not_finite(const StateLayout& layout, std::span<const double> state, double t) {
  throw SolverError(fmt::format(
      "the state is no longer finite at t = {:.6g} ms: {}.\n       A common cause: the time step is too long for the "
      "stiffest contact.",
      t * 1e3, not_finite(layout, state)));
}

void throw_no_step(const StateLayout& layout, double t, double step, std::span<const double> weighted_error,
                   const std::string& message) {
  std::string text =
      fmt::format("the integrator could not take a step at t = {:.6g} ms (step {:.3g} s).", t * 1e3, step);
  if (!weighted_error.empty()) text += "\n       Largest error: " + worst_components(layout, weighted_error) + ".";
  if (!message.empty()) text += "\n       " + message;
  throw SolverError(text);
}

}  // namespace rotordrop
