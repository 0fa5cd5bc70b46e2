#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "analysis/facts/circuit_fit.h"
#include "case/case.h"

namespace rotordrop {

/// Calibrates the circuits of all touchdown bearings of a case.
/// @throws InputError if the case has none
std::vector<CalibratedBearing> calibrate(const Case& c, const CalibrationSettings& settings);

/// A parameter file that builds on the case and holds the factors.
/// @param overrides  with which the case was read: the factors are of no other circuit, so the file holds them, too
std::string calibration_file(const Case& c, const std::vector<std::string>& overrides,
                             const std::filesystem::path& file, const std::vector<CalibratedBearing>& bearings,
                             const CalibrationSettings& settings);
std::string calibration_text(const std::vector<CalibratedBearing>& bearings);

}  // namespace rotordrop
