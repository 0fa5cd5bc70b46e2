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

/// How long rotor and bore touch along the axis [m]: contact_width. Of a crown's ellipse, under a tenth of C0, the length of the rectangle that has its area
/// and its half width around the circumference.
double rub_length(const MachineParameters& parameters, const TouchdownParameters& bearing);
/// Half width of their contact around the circumference under a force [N], by Hertz [m]. That of a crown's ellipse grows by the root of the force, too: its length stays.
double rub_half_width(const MachineParameters& parameters, const TouchdownParameters& bearing, double force);

}  // namespace rotordrop
