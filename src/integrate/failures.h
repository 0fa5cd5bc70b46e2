#pragma once
// How a failed integration is told, whichever method failed.
#include <span>
#include <string>

#include "model/state_layout.h"

namespace rotordrop {

/// Whether every value is a finite number.
bool all_finite(std::span<const double> values);

/// @param rates  of which at least one is not finite [layout.size()]; @param t, step [s]; @throws SolverError
[[noreturn]] void throw_rates_not_finite(const StateLayout& layout, std::span<const double> rates, double t,
                                         double step);
/// @throws SolverError
[[noreturn]] void throw_state_not_finite(const StateLayout& layout, std::span<const double> state, double t);
/// @param weighted_error  of the last error test [layout.size()]; empty if the method has none
/// @param message         of the method; may be empty; @throws SolverError
[[noreturn]] void throw_no_step(const StateLayout& layout, double t, double step,
                                std::span<const double> weighted_error, const std::string& message = {});

}  // namespace rotordrop
