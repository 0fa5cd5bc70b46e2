#pragma once
#include <csignal>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/drop/drop_run.h"

// A second opinion on a drop: by how much its numbers differ with finer steps and from starts beside its own.
namespace rotordrop {

/// Distance between starts of neighbouring drops [m], up and down: far below what anyone can set, far above roundoff.
inline constexpr double neighbour_distance = 1e-9;
/// Neighbours have parted when an orbit differs by this part of the air gap.
inline constexpr double parted_share = 0.01;
/// Smaller results are nothing, and what they differ by is roundoff [N, J, K, Pa, s, rad/s].
inline constexpr double least_judged = 1e-6;

/// Computes a finished drop again, in memory: the first impacts of all bearings with and without a tenth of the tolerance and half the step, and
/// the whole of it from starts beside its own. For `second_opinion` of summary.json; null if it was stopped.
/// @param first  with the series that its summary needs, which are those of series_of_impact(), too
nlohmann::ordered_json second_opinion(const Case& drop_case, const FinishedDrop& first,
                                      const volatile std::sig_atomic_t* stop);

/// Lines for the screen, from `second_opinion` of a summary.
std::string second_opinion_text(const nlohmann::ordered_json& opinion);

}  // namespace rotordrop
