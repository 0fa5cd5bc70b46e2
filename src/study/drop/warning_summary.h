#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "machine/machine_parameters.h"
#include "model/run_warning.h"

namespace rotordrop {

struct DropSummary;

/// What only a summary tells: local temperatures, wear and whirl of its bearings.
[[nodiscard]] std::vector<RunWarning> warnings_in_summary(const MachineParameters& parameters,
                                                          const DropSummary& summary);

/// `warnings` of summary.json.
[[nodiscard]] nlohmann::ordered_json warnings_json(const std::vector<RunWarning>& warnings);

/// Lines for the screen, from `warnings` of summary.json; empty without any.
[[nodiscard]] std::string warnings_text(const nlohmann::ordered_json& warnings);

/// @throws SolverError if one of `warnings` of summary.json is in run.fatal_warnings
void stop_at_fatal_warnings(const RunParameters& run, const nlohmann::ordered_json& warnings);

}  // namespace rotordrop
