#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "machine/finite_elements.h"

namespace rotordrop {

/// Scalars of a bearing's finite-element model: rises at the end, the hottest that its surfaces became, and how the model was made.
/// @param results  the run's results.h5, closed
nlohmann::ordered_json fe_summary(const FiniteElements::Section& section, FeCoupling coupling,
                                  const std::filesystem::path& results);

/// How the windows of a windowed coupling turned out.
nlohmann::ordered_json windows_summary(const WindowedSections::Report& report, const HeatEnergy& energy);

}  // namespace rotordrop
