#pragma once
#include <memory>
#include <vector>

#include "machine/heat/finite_elements.h"
#include "machine/machine_parameters.h"
#include "thermal/section/reduced_sections.h"

namespace rotordrop {

/// Meshes the section of every touchdown bearing; reduces it unless it is to run in windows.
/// @param of_a_drop  growth is judged by elasticity where formulas are fed back, if the section's elasticity is linear: its fit no clearance; rows that may carry different
///                   loads are heated apart
void make_sections(const MachineParameters& parameters, FiniteElements& elements, ReductionSettings reduction = {},
                   bool of_a_drop = false);

/// The sections on their modes, of sections that were made and reduced.
std::vector<ReducedSection> reduced_sections(const MachineParameters& parameters, const FiniteElements& elements);

/// The section of every touchdown bearing by finite elements on few modes, by itself: good from a hundredth of a second to `longest` [s].
/// @param finite_elements  the room's doors
std::shared_ptr<const ThermalModel> reduced_fe_model(const MachineParameters& parameters,
                                                     FiniteElements& finite_elements, double longest);

}  // namespace rotordrop
