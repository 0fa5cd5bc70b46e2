#pragma once
#include "machine/machine_parameters.h"

namespace rotordrop {

/// What the dimensions of a touchdown bearing lead one to expect, to tell a wrong unit or bearing.
struct BearingEstimates {
  double static_load = 0,
         dynamic_load = 0;        ///< C0 and C of all rows together, by ISO 76 and ISO 281 within some 30 % [N]
  double contact_stiffness = 0;   ///< K of rotor and bore from their bodies [N/m^n]; 0 if there is no journal
  double shoulder_stiffness = 0;  ///< of a shoulder of the rotor and the ring's wall [N/m]
};
[[nodiscard]] BearingEstimates bearing_estimates(const MachineParameters& parameters,
                                                 const TouchdownParameters& bearing);

}  // namespace rotordrop
