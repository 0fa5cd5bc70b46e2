#pragma once
#include "machine/parts_module.h"

/// Adds the parts of this folder: the support "snubber" and the thermal model "wall".
void add_parts(rotordrop::PartsRegistry& registry);
