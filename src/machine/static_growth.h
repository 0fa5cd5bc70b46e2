#pragma once
#include "laws/bearing_growth.h"
#include "machine/machine_parameters.h"

namespace rotordrop {

/// Where growth counts, by thermal.expansion: at the contact points, or (paper) at the rings' shoulders and only radially.
RaceSurfaces race_surfaces(const MachineParameters& parameters, const TouchdownParameters& bearing);

/// Growth of the surfaces of free parts that are evenly warm, per kelvin of each part [m/K].
Expansion even_growth(const MachineParameters& parameters, const TouchdownParameters& bearing);

/// Growth of a touchdown bearing's surfaces under [statics]; free rings of even temperature.
Expansion static_growth(const MachineParameters& parameters, const TouchdownParameters& bearing);

}  // namespace rotordrop
