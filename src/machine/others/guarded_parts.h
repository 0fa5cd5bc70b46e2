#pragma once
#include <string>

#include "machine/supports.h"
#include "thermal/thermal_kinds.h"

namespace rotordrop {

// Parts of modules with what they throw caught at their door. It is a fault of the module, told with the part's name, and not one of the program. Faults
// of the input (InputError) that a part finds while it is read or made stay what they are, and so does a lack of memory.

/// @param file  of the module, for messages
SupportKind guarded(SupportKind kind, const std::string& file);
ThermalKind guarded(ThermalKind kind, const std::string& file);

}  // namespace rotordrop
