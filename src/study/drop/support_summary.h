#pragma once
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "analysis/watch/support_watch.h"
#include "machine/machine_parameters.h"

namespace rotordrop {

/// `support` of a bearing in summary.json; null if it is no touchdown bearing of the case.
[[nodiscard]] nlohmann::ordered_json support_summary(const SupportWatch& watch, const Machine& machine,
                                                     const MachineParameters& parameters, const std::string& bearing,
                                                     std::span<const double> y);

/// A line for the screen, from `support` of a bearing's summary; empty for springs that are within their limit.
[[nodiscard]] std::string support_text(const std::string& name, const nlohmann::ordered_json& support);

}  // namespace rotordrop
