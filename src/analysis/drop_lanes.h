#pragma once
// Drops side by side in lanes: what a study runs when its points are alike.
#include <exception>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "analysis/drop.h"

namespace rotordrop {

/// Why a drop does not run in lanes, in words; empty: it does.
[[nodiscard]] std::string why_not_in_lanes(const Machine& machine, const IntegrationParameters& integration);

/// Whether two drops that run in lanes can run side by side.
[[nodiscard]] bool are_alike(const Machine& a, const IntegrationParameters& a_integration, const Machine& b,
                             const IntegrationParameters& b_integration);

/// Runs drops side by side to their ends. What a drop gives depends neither on its lane nor on its neighbours, bit for bit; by itself it gives the same
/// within what rounding does to it.
/// @param drops       1 to LaneSystem::width, at their starts, alike
/// @param is_stopped  asked after every step; then all are left where they are
/// @returns of every drop why it failed; none: it did not
std::vector<std::exception_ptr> run_in_lanes(std::span<Drop* const> drops,
                                             const std::function<bool()>& is_stopped = {});

}  // namespace rotordrop
