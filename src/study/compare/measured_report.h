#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "study/compare/measured.h"
#include "study/recorded_drop.h"

namespace rotordrop {

/// Numbers of a measured series beside what was computed at its times.
nlohmann::ordered_json measured_difference(const Measured& measured, const std::vector<double>& computed);
/// A figure: measured samples and computed curves, thinned.
nlohmann::ordered_json measured_overlay(const Measured& measured,
                                        const std::vector<std::pair<std::string, TimeSeries>>& curves);
/// Lines for the screen. @param differences  a list of measured_difference()
std::string measured_text(const nlohmann::ordered_json& differences);

/// A drop beside measured series: differences and figures.
struct MeasuredComparison {
  nlohmann::ordered_json report;  ///< docs/how-to/compare.md
  std::string page;               ///< HTML
};
/// @throws InputError if the drop has not these series, in these units
MeasuredComparison compare_with_measured(const RecordedDrop& drop, const std::vector<Measured>& measured);

}  // namespace rotordrop
