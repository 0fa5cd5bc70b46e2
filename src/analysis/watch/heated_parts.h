#pragma once
#include <string>

#include "machine/machine_parameters.h"

namespace rotordrop {

/// Material of a part of a bearing that must keep its dimensions and hardness; null of other parts. Of the shaft only where a journal names its own:
/// the heat of others is reckoned with that of the ring, whatever they are of.
/// @param part  in words: "inner ring", "outer raceway", "ball"
const MaterialParameters* material_of_part(const MachineParameters& parameters, const TouchdownParameters& bearing,
                                           const std::string& part);

}  // namespace rotordrop
