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

/// Where drops that run side by side come from, and where they go.
class LaneFeed {
 public:
  LaneFeed() = default;
  LaneFeed(const LaneFeed&) = delete;
  LaneFeed& operator=(const LaneFeed&) = delete;
  virtual ~LaneFeed() = default;
  /// A drop at its start for a lane that is free, alike to those that run; null: none now. It lives until it is over.
  virtual Drop* next() = 0;
  /// A drop is at its end, or was stopped where it is. @param failure  why it failed; none: it did not
  virtual void over(Drop& drop, const std::exception_ptr& failure) = 0;
};

/// Runs drops side by side to their ends; where one is over, the next begins beside the others. What a drop gives depends neither on its lane nor on
/// its neighbours, bit for bit; by itself it gives the same within what rounding does to it.
/// @param is_stopped  asked after every step; then all are over where they are
/// @returns how many drops were begun
std::size_t run_in_lanes(LaneFeed& feed, const std::function<bool()>& is_stopped = {});

/// The same of a list.
/// @param drops  at their starts, alike
/// @returns of every drop why it failed; none: it did not
std::vector<std::exception_ptr> run_in_lanes(std::span<Drop* const> drops,
                                             const std::function<bool()>& is_stopped = {});

}  // namespace rotordrop
