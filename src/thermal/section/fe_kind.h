#pragma once
#include "thermal/thermal_kinds.h"

namespace rotordrop {

/// The finite elements of all touchdown bearings, on few modes or all.
ThermalKind fe_kind();

}  // namespace rotordrop
