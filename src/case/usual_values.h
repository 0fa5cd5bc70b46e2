#pragma once
#include <vector>

#include "base/errors.h"
#include "base/node.h"

namespace rotordrop {

struct SectionDeclaration;

/// Values outside the range that their declaration calls usual: warnings, each with the likely slip.
/// @param tree  read by the section without a fault
void look_for_unusual_values(const SectionDeclaration& section, const Node& tree, std::vector<Fault>& warnings);

/// Keys of [bearings] itself that every touchdown bearing, or its catalogue entry, sets again.
void look_for_common_keys_without_effect(const Node& tree, std::vector<Fault>& warnings);

}  // namespace rotordrop
