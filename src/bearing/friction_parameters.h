#pragma once

#include "bearing/touchdown_parameters.h"

namespace rotordrop {

/// Keys of the bearing's friction, and of the ratings by which it and damage are judged.
void add_friction_keys(Section<TouchdownParameters>& section);

}  // namespace rotordrop
