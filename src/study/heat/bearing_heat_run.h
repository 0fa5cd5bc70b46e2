#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/heat/bearing_heat_case.h"
#include "study/heat/heat_run.h"

namespace rotordrop {

/// Computes it into a directory: results.h5, summary.json, parameters.toml, fields. @return the summary
nlohmann::ordered_json run_bearing_heat(BearingHeatCase& heat_case, const HeatRunOptions& options);

/// A few lines for the screen.
std::string bearing_heat_summary_text(const nlohmann::ordered_json& summary);

}  // namespace rotordrop
