#pragma once
#include <string>

#include "machine/machine_parameters.h"

namespace rotordrop {

/// What the balls of a bearing conduct by the law of rolling contacts when all of them carry the same load.
/// @param ball_load   normal force of each ball on both races [N]
/// @param ring_speed  of the inner ring [rad/s]; 0: at rest
BallConduction given_conduction(const MachineParameters& parameters, const std::string& bearing, double ball_load,
                                double ring_speed);

}  // namespace rotordrop
