#pragma once
// What bent rings do to the balls of a row: arrays that ball_row_kernels.cpp and ball_row_inertial.cpp share.
#include <array>

#include "bearing/row/ball_row.h"

namespace rotordrop {

inline constexpr std::size_t max_ball_harmonics = 40;  // 2 to 41

/// cos and sin of n times the cage's angle, n = 2, 3, ...
struct CageTurns {
  CageTurns() {}  // unwritten
  std::array<double, max_ball_harmonics> cosine, sine;
};

/// By ball: what bending adds to B_r.
struct Widening {
  Widening() {}  // leaves everything unwritten: only rows of bent rings use it
  /// A little longer than a row can be, lest all arrays fall on the same lines of the cache.
  using Array = std::array<double, BallRow::max_balls + 8>;
  alignas(64) Array width;  ///< [m]
  alignas(64) Array rate;   ///< its rate at a standing cage [m/s]
  alignas(64) Array slope;  ///< its derivative by azimuth [m/rad]
  alignas(64) Array force;  ///< out: the ball's radial force on the inner ring, positive inwards [N]
  CageTurns turns;          ///< of the shapes, between the frames of space and cage
};

}  // namespace rotordrop
