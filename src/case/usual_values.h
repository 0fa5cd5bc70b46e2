#pragma once
#include <string>
#include <vector>

#include "base/errors.h"
#include "base/node.h"
#include "base/parameters/range.h"
#include "base/units.h"

namespace rotordrop {

struct SectionDeclaration;

/// Values outside the range that their declaration calls usual: warnings, each with the likely slip.
/// @param tree  read by the section without a fault
void look_for_unusual_values(const SectionDeclaration& section, const Node& tree, std::vector<Fault>& warnings);

/// A value that an option gives: a warning with the likely slip if it is outside the range that is usual.
/// @param text  that convert_to_si() takes
[[nodiscard]] std::vector<Fault> look_at_option(const std::string& option, const std::string& text,
                                                const std::string& unit, QuantityKind kind, const Range& usual);

/// Keys of [bearings] itself that every touchdown bearing, or its catalogue entry, sets again.
void look_for_common_keys_without_effect(const Node& tree, std::vector<Fault>& warnings);

}  // namespace rotordrop
