#pragma once
#include <functional>
#include <string>

#include "thermal/thermal_kinds.h"

namespace rotordrop {

/// Takes what is wrong with a part, and advice.
using RefusePart = std::function<void(const std::string& what, const std::string& advice)>;

/// States of inner rings are one for each touchdown bearing where the kind says that there are such, or none.
/// @param n_places  touchdown bearings of the case
void check_ring_states(const ThermalModel& model, const ThermalKind& kind, std::size_t n_places,
                       const RefusePart& refuse);

/// What the program takes for granted of a thermal model of others: each place of heat once, growth that is linear and has the rates of growth_rates(), and
/// no heat stored at the start.
void check_heat(const ThermalModel& model, std::size_t n_places, const RefusePart& refuse);

}  // namespace rotordrop
