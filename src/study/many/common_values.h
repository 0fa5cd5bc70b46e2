#pragma once
#include <string>
#include <vector>

#include "case/case.h"

namespace rotordrop {

/// The resolved text of a case in which some keys of all bearings, "bearings.ball_model", stand in [bearings] once again instead of in each bearing that has no value of its own: laid over it, such
/// a key does what it does laid over the case itself. Reads back to the same values.
/// @param keys  of the case; others than those of all bearings change nothing
[[nodiscard]] std::string text_with_common_values(const Case& c, const std::vector<std::string>& keys);

/// A warning for each of these keys that is one of all bearings, and that every touchdown bearing, or its catalogue entry, sets again.
/// @param where  the keys stand
[[nodiscard]] std::vector<Fault> common_values_without_effect(const Case& c, const std::vector<std::string>& keys,
                                                              const SourcePosition& where);

}  // namespace rotordrop
