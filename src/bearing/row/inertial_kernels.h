#pragma once

// Sums over the balls of a row whose balls have inertia.
#include <cstddef>

#include "bearing/row/ball_row_kernels.h"
#include "bearing/row/inertial_balls.h"

namespace rotordrop {

/// Balls, races and displacement of a row as its kernels take them.
struct InertialInput {
  RowPlaceOf<double> place;
  const InertialRow* row;
  double F_0;               // m d_m omega^2 / 2, > 0 [N]
  double added_i, added_o;  // to the contacts' deflections [m]
  double cage_speed;
  InertialStart starts;
  const double *cosine, *sine;
  const double* is_ball;      // 0 for balls that fill up the row, else 1
  std::size_t n;              // a multiple of vector_length
  const WavesAtBalls* waves;  // of a row without them none
  Widening* bent;             // of bent rings; of rigid ones none
  bool sums_roots;            // of the loads
};

struct InertialKernels {
  /// Sums over the balls of a row, inertia_per_speed being work per relative change of F_0 [W]. @param with, tractions  if what skidding needs is asked
  /// for, too
  using Sums = void(const InertialInput& in, BallRowOutput& out, const TractionInput* with, RowTractions* tractions);
  Sums* sum_in_plane;      ///< of a ring that only translates, its contact angles zero
  Sums* sum_translations;  ///< of a ring that only translates
  Sums* sum_all_motions;   ///< of one that moves in all five ways
  /// Loads on both races, of a ring that moves in all five ways. @param Q_i, Q_o  [n]
  void (*loads)(const InertialInput& in, double* Q_i, double* Q_o);
  /// Elastic energy of both contacts [J], of such a ring.
  double (*energy)(const InertialInput& in);
  void (*balance)(const InertialRow& row, double F_0, const InertialStart& starts, InertialBalls& balls);
};
// Nothing but these leaves the objects that inertial_kernels.cpp is compiled to (cmake/LaneEngine.cmake).
const InertialKernels& inertial_kernels_base();
const InertialKernels& inertial_kernels_v3();
const InertialKernels& inertial_kernels_v4();
const InertialKernels& inertial_kernels_v4_newton();
/// Those of this process.
const InertialKernels& inertial_kernels();

}  // namespace rotordrop
