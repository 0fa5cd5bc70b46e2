#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "machine/machine_parameters.h"
#include "model/run_warning.h"

namespace rotordrop {

/// What only a summary tells: local temperatures, wear and whirl, from its `bearings`.
[[nodiscard]] std::vector<RunWarning> warnings_in_summary(const MachineParameters& parameters,
                                                          const nlohmann::ordered_json& summary);

/// `warnings` of summary.json.
[[nodiscard]] nlohmann::ordered_json warnings_json(const std::vector<RunWarning>& warnings);

/// Lines for the screen, from `warnings` of a summary; empty without any.
[[nodiscard]] std::string warnings_text(const nlohmann::ordered_json& summary);

/// @throws SolverError if one of them is in run.fatal_warnings
void stop_at_fatal_warnings(const RunParameters& run, const nlohmann::ordered_json& summary);

}  // namespace rotordrop
