#pragma once
#include <vector>

#include "bearing/ball_row.h"

namespace rotordrop {

/// Position of an inner ring at rest in its balls under a constant radial force; standing cage, no growth.
/// Where the balls leave a direction free (a ring in its clearance on a single ball), it stays on the force's line.
/// @param force_y, force_z  [N]; zero force gives zero displacement
/// @throws SolverError if no equilibrium is found
RingDisplacement ring_equilibrium(const std::vector<BallRow>& rows, double force_y, double force_z);

}  // namespace rotordrop
