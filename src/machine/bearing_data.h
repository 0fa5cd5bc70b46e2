#pragma once
#include <string>

#include "bearing/touchdown_bearing.h"
#include "bearing/touchdown_data.h"
#include "machine/machine_parameters.h"
#include "thermal/circuit/bearing_circuit.h"

// A touchdown bearing of a case whose parameters were checked, as numbers for the parts that are made from it.
namespace rotordrop {

/// A material as parts without a section take it: of a table its value at ambient.
ThermalMaterial thermal_material(const MaterialParameters& material, double ambient);

/// The rotor's material at a touchdown bearing, for all that concerns heat: that of the ring if none is named.
const MaterialParameters& shaft_material(const MachineParameters& parameters, const TouchdownParameters& bearing);
/// Names of the materials of what finite elements mesh of a touchdown bearing.
std::vector<std::string> meshed_materials(const MachineParameters& parameters, const TouchdownParameters& bearing);

/// What a touchdown bearing takes from the case around it.
TouchdownSurroundings touchdown_surroundings(const MachineParameters& parameters, const TouchdownParameters& bearing);

TouchdownBearingData touchdown_data_of(const MachineParameters& parameters, const std::string& name,
                                       const TouchdownParameters& bearing);

/// Dimensions and materials from which its thermal models are built.
BearingCircuitData circuit_data(const MachineParameters& parameters, const std::string& name,
                                const TouchdownParameters& bearing);

/// The lumped circuits of all touchdown bearings, its places, with what a user adds; unknown names become faults.
ThermalNetworkData network_data(const MachineParameters& parameters, const Node& case_node, Faults& faults);

}  // namespace rotordrop
