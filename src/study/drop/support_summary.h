#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>

#include "analysis/watch/support_watch.h"
#include "machine/machine_parameters.h"

namespace rotordrop {

/// What a summary tells of the support of a bearing's outer ring.
struct SupportSummary {
  std::string type;
  double largest_travel = 0, largest_travel_time = 0;  ///< of the outer ring [m], [s]
  std::optional<double> travel_limit;                  ///< [m]
  double loss = 0;                                     ///< dissipated [J]
  std::optional<double> largest_stored_energy;         ///< of a support that tells it [J]
  std::optional<bool> meets_stop;                      ///< of a support with a stop
};
/// None if it is no touchdown bearing of the case.
[[nodiscard]] std::optional<SupportSummary> support_summary(const SupportWatch& watch, const Machine& machine,
                                                            const MachineParameters& parameters,
                                                            const std::string& bearing, std::span<const double> y);
/// `support` of a bearing in summary.json; null for none.
[[nodiscard]] nlohmann::ordered_json support_json(const std::optional<SupportSummary>& support);
/// Lines for the screen; empty for springs without a stop.
[[nodiscard]] std::string support_text(const std::string& name, const SupportSummary& support);

}  // namespace rotordrop
