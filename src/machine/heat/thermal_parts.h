#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "machine/heat/finite_elements.h"
#include "machine/machine.h"
#include "machine/machine_parameters.h"

namespace rotordrop {

/// Adds the thermal models that a case chose, and what says whose growth is fed back.
/// @param elements  with the sections made, if a model meshes them
/// @param recorded  growth of an earlier run, if that drives
void add_thermal_models(const MachineParameters& parameters, const Node& case_node, FiniteElements* elements,
                        std::shared_ptr<const GrowthHistory> recorded, Machine::Parts& parts);

/// Thermal models by themselves.
struct ThermalParts {
  std::vector<Machine::Parts::Thermal>
      models;  ///< those of the case; one whose coupling is windowed is a section of the finite elements
  std::size_t n_places = 0, place = 0;  ///< of the models, and the bearing's among them
};
/// The models of one touchdown bearing of a case whose parameters were checked, without a machine. Its section is the only one made.
/// @param ball_conduction  between balls and races; none: by the fixed R5, for there are no loads
/// @throws InputError, SolverError
ThermalParts build_thermal_models(const MachineParameters& parameters, const Node& case_node,
                                  const std::string& bearing, FiniteElements& finite_elements,
                                  const std::optional<BallConduction>& ball_conduction = {});

}  // namespace rotordrop
