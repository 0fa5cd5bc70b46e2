#pragma once
#include <string>
#include <vector>

#include "machine/heat/local_rub.h"
#include "machine/machine_parameters.h"
#include "thermal/circuit/lumping.h"

namespace rotordrop {

/// The bodies of a touchdown bearing's circuit, with their numbers of Biot and Fourier.
std::vector<LumpedBody> lumped_bodies(const MachineParameters& parameters, const std::string& name,
                                      const TouchdownParameters& bearing);

/// Bore and rotor where they rub.
/// @param band_length  of the spot along the surface [m]
RubSurfaces rub_surfaces(const MachineParameters& parameters, const std::string& name,
                         const TouchdownParameters& bearing, double band_length);

/// The same as the case wants local temperatures and wear.
LocalRubSettings local_rub_settings(const MachineParameters& parameters, const std::string& name,
                                    const TouchdownParameters& bearing);

/// Half width of the contact of rotor and bore under a force [N], as cylinders of the ring's material [m].
double rub_half_width(const MachineParameters& parameters, const TouchdownParameters& bearing, double force);

}  // namespace rotordrop
