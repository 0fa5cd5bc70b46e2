#pragma once
#include <span>
#include <vector>

#include "bearing/row/ball_row.h"
#include "model/ports.h"

namespace rotordrop {

struct RingAtRest : RingDisplacement {
  std::vector<double> shape = {};  ///< of bent rings, inner minus outer one: coefficients of their harmonics [m]
};

/// Position of an inner ring at rest in its balls under a constant force; standing cage at an angle, no growth.
/// Where the balls leave a direction free (a ring in its clearance on a single ball), it stays where the load's line leads it.
/// @param force            [N, N m]
/// @param is_free          the ring also moves along x and tilts; otherwise force.x and the moments are left out
/// @param shape_stiffness  of bent rings, of both in series: force per coefficient [N/m]; empty: rigid rings
/// @throws SolverError if no equilibrium is found
RingAtRest ring_equilibrium(const std::vector<BallRow>& rows, const Force& force, bool is_free = false,
                            double cage_angle = 0., std::span<const double> shape_stiffness = {});

}  // namespace rotordrop
