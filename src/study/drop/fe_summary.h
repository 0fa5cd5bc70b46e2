#pragma once
#include <nlohmann/json_fwd.hpp>

#include "machine/heat/finite_elements.h"
#include "study/recorded_drop.h"

namespace rotordrop {

/// Scalars of a bearing's finite-element model: rises at the end, the hottest that its surfaces became, and how the model was made.
nlohmann::ordered_json fe_summary(const FiniteElements::Section& section, FeCoupling coupling,
                                  const RecordedDrop& drop);

/// How the windows of a windowed coupling turned out.
nlohmann::ordered_json windows_summary(const WindowedSections::Report& report, const HeatEnergy& energy);

}  // namespace rotordrop
