#pragma once
#include <vector>

#include "base/errors.h"
#include "base/node.h"

namespace rotordrop {

struct SectionDeclaration;

/// Values outside the range that their declaration calls usual: warnings, each with the likely slip.
/// @param tree  read by the section without a fault
void look_for_unusual_values(const SectionDeclaration& section, const Node& tree, std::vector<Fault>& warnings);

}  // namespace rotordrop
