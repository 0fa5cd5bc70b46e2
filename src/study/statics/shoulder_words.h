#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/facts/shoulder_report.h"
#include "machine/machine_parameters.h"

namespace rotordrop {

/// Shoulders beside a bearing's ring as JSON: stiffness, where it is from, and the force by energy for half, all and twice of it; null without shoulders.
nlohmann::ordered_json shoulder_json(const MachineParameters& parameters, const std::string& bearing);
nlohmann::ordered_json shoulder_json(const ShoulderReport& report);
/// The same as lines for the screen. @param indent  spaces before each line
std::string shoulder_text(const nlohmann::ordered_json& shoulder, std::size_t indent);

/// Values of a touchdown bearing in the program's convention and in that of catalogues and fit tables, side by side.
std::string conventions_text(const MachineParameters& parameters, const std::string& bearing);

}  // namespace rotordrop
