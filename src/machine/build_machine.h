#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "bearing/touchdown_data.h"
#include "machine/heat/finite_elements.h"
#include "machine/machine.h"
#include "machine/machine_parameters.h"

namespace rotordrop {

/// Checks that need several sections at once; `case_node` gives the positions.
void check_machine(const MachineParameters& parameters, const Node& case_node, Faults& faults);

/// Which model's growth is fed back; of no model without thermal.growth.
GrowthDriver driver_of(const ThermalParameters& parameters);

/// Data from which the thermal models of a touchdown bearing are built.
BearingCircuitData circuit_data(const MachineParameters& parameters, const std::string& name,
                                const TouchdownParameters& bearing);

/// The lumped circuits of all touchdown bearings, its places, with what a user adds; unknown names become faults.
ThermalNetworkData network_data(const MachineParameters& parameters, const Node& case_node, Faults& faults);

/// One touchdown bearing of a case whose parameters were checked, as numbers.
/// What a touchdown bearing takes from the case around it.
TouchdownSurroundings touchdown_surroundings(const MachineParameters& parameters, const TouchdownParameters& bearing);

TouchdownBearingData touchdown_data_of(const MachineParameters& parameters, const std::string& name,
                                       const TouchdownParameters& bearing);

/// The parts of a machine, for programs that add thermal models of their own, or replace parts, before they wire them with
/// `Machine(std::move(parts))`. Arguments as of build_machine().
Machine::Parts machine_parts(const MachineParameters& parameters, const Node& case_node,
                             FiniteElements* finite_elements = nullptr,
                             std::shared_ptr<const GrowthHistory> recorded = nullptr);

/// The machine of a case whose parameters were checked. @throws InputError, SolverError
/// @param finite_elements  the room's doors if the case has finite elements; takes the sections that are made
/// @param recorded         growth of an earlier run, if that drives
std::unique_ptr<Machine> build_machine(const MachineParameters& parameters, const Node& case_node,
                                       FiniteElements* finite_elements = nullptr,
                                       std::shared_ptr<const GrowthHistory> recorded = nullptr);

/// The section of every touchdown bearing by finite elements on few modes, by itself: good from a hundredth of a second to `longest` [s].
/// @param finite_elements  the room's doors
std::shared_ptr<const ThermalModel> reduced_fe_model(const MachineParameters& parameters,
                                                     FiniteElements& finite_elements, double longest);

/// Thermal models by themselves.
struct ThermalParts {
  std::vector<Machine::Parts::Thermal>
      models;  ///< "lumped"; "fe", unless its coupling is windowed: then it is a section of the finite elements
  std::size_t n_places = 0, place = 0;  ///< of the models, and the bearing's among them
};
/// The models of one touchdown bearing of a case whose parameters were checked, without a machine. Its section is the only one made.
/// @param ball_conduction  between balls and races; none: by the fixed R5, for there are no loads
/// @throws InputError, SolverError
ThermalParts build_thermal_models(const MachineParameters& parameters, const Node& case_node,
                                  const std::string& bearing, FiniteElements& finite_elements,
                                  const std::optional<BallConduction>& ball_conduction = {});

}  // namespace rotordrop
