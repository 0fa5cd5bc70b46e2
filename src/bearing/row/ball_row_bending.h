#pragma once
// What bent rings do to the balls of a row: arrays that ball_row_kernels.cpp and ball_row_inertial.cpp share.
#include <array>

#include "bearing/row/ball_row.h"

namespace rotordrop {

/// By ball: what bending adds to B_r.
struct Widening {
  Widening() {}  // leaves everything unwritten: only rows of bent rings use it
  /// A little longer than a row can be, lest all arrays fall on the same lines of the cache.
  using Array = std::array<double, BallRow::max_balls + 8>;
  alignas(64) Array width;  ///< [m]
  alignas(64) Array rate;   ///< its rate at a standing cage [m/s]
  alignas(64) Array slope;  ///< its derivative by azimuth [m/rad]
  alignas(64) Array force;  ///< out: the ball's radial force on the inner ring, positive inwards [N]
};

}  // namespace rotordrop
