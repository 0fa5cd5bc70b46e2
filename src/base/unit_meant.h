#pragma once
#include <string>
#include <string_view>

#include "base/units.h"

namespace rotordrop {

/// What a unit that does not fit is meant as: "mm" of "MM", "W/(m2 K)" of "W/m2 K", "degC" of "C"; empty if nothing is near.
/// @param si_unit  that the quantity needs
[[nodiscard]] std::string unit_meant(std::string_view given, std::string_view si_unit, QuantityKind kind);

}  // namespace rotordrop
