#pragma once
#include "thermal/thermal_kinds.h"

namespace rotordrop {

/// The lumped circuits of all touchdown bearings, one network.
ThermalKind lumped_kind();

}  // namespace rotordrop
