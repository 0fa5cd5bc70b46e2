#pragma once
#include "machine/machine_parameters.h"

// Growth by speed in closed form, of thin discs (laws/ring_growth.h). In the mean over the length it is exact for free rings and shafts of any
// length.
namespace rotordrop {

/// Whether rings and rotor of a drop grow by their speed. What an earlier run recorded holds such growth if that run had it.
bool drop_grows_by_speed(const MachineParameters& parameters);

/// Bore, inner raceway and width of a touchdown bearing's inner ring as one of rectangular section, per square of its speed [m s^2]. The raceway's
/// growth counts where thermal.expansion takes it.
Expansion ring_growth_by_speed(const MachineParameters& parameters, const TouchdownParameters& bearing);

/// The rotor's surface under a touchdown bearing, solid or hollow as its beam elements there, per square of the rotor's speed [m s^2]. Several
/// layers count as one body of the outermost one's material.
double rotor_growth_by_speed(const MachineParameters& parameters, const TouchdownParameters& bearing);

}  // namespace rotordrop
