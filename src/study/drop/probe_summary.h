#pragma once
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "analysis/watch/probe_watch.h"

namespace rotordrop {

/// `probes` of summary.json.
[[nodiscard]] nlohmann::ordered_json probe_summary(const Machine& machine, const ProbeWatch& watch,
                                                   std::span<const double> y);
/// Lines for the screen, from `probes` of a summary.
[[nodiscard]] std::string probe_text(const nlohmann::ordered_json& probes);

}  // namespace rotordrop
