#pragma once

#include <string_view>

#include "base/parameters/range.h"
#include "base/units.h"

namespace rotordrop {

/// What a quantity of a unit is at most in machines of this kind, of either sign, for keys that declare no usual range of their own.
/// @param allowed  the range of the key; nothing is said where it already excludes what is unusual
[[nodiscard]] Range usual_magnitudes(std::string_view unit, QuantityKind kind, const Range& allowed);

}  // namespace rotordrop
