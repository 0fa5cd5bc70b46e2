#pragma once
#include "machine/machine_parameters.h"
#include "thermal/circuit/bearing_circuit.h"

namespace rotordrop {

/// Radius of the shaft's bore at a touchdown bearing, from the rotor's elements there, at most 0.95 of the journal's; 0 of a solid one [m].
double shaft_bore_radius(const MachineParameters& parameters, const TouchdownParameters& bearing);

/// The rotor's shaft beside a touchdown bearing as fins, from the diameters of its beam elements; to the rotor's end, or half-way to the next
/// touchdown bearing. Fins end after 4/m, from where on less than 0.1 % of their heat is missing. A side on which the rotor ends with the bearing has none.
/// @param circuit  of the bearing: the shaft's material, convection and lump
std::vector<FinNode> shaft_fins(const MachineParameters& parameters, const TouchdownParameters& bearing,
                                const BearingCircuitData& circuit);

/// The same shaft as bodies for the finite elements: a step for each diameter of the rotor's elements, without their mass points. They end after
/// thermal.fe.shaft_reach, by default where the fins do. A step shorter than 0.5 mm takes its neighbour's diameter.
std::vector<ShaftStep> shaft_steps(const MachineParameters& parameters, const TouchdownParameters& bearing);

}  // namespace rotordrop
