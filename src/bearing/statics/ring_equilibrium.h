#pragma once
#include <vector>

#include "bearing/row/ball_row.h"
#include "model/ports.h"

namespace rotordrop {

/// Position of an inner ring at rest in its balls under a constant force; standing cage at an angle, no growth.
/// Where the balls leave a direction free (a ring in its clearance on a single ball), it stays where the load's line leads it.
/// @param force    [N, N m]; zero gives zero displacement
/// @param is_free  the ring also moves along x and tilts; otherwise force.x and the moments are left out
/// @throws SolverError if no equilibrium is found
RingDisplacement ring_equilibrium(const std::vector<BallRow>& rows, const Force& force, bool is_free = false,
                                  double cage_angle = 0.);

}  // namespace rotordrop
