#pragma once

// Sums over the balls of a row: the hot loops of every drop.
#include <cstddef>

#include "bearing/row/ball_terms.h"

namespace rotordrop {

// Rows are filled up to whole vectors with balls too small to touch anything.
inline constexpr double idle_penetration = -1.;  // added to an idle ball's penetration [m]

/// Balls, races and displacement of a row as its kernels take them.
struct KernelInput {
  RowPlaceOf<double> place;
  double stiffness_root;  // K^(1/3)
  const double* cosine;
  const double* sine;
  const double* idle;         // added to every delta: nothing, or idle_penetration [n]
  std::size_t n;              // a multiple of vector_length
  const WavesAtBalls* waves;  // of a row without them none
  Widening* bent;             // of bent rings; of rigid ones none
};
using TractionInput = TractionInputOf<double>;

/// The hot loops of a row, compiled for one level of vectors.
struct RowKernels {
  /// Sums over the balls of a row. @param with, tractions  if what skidding needs is asked for, too; an idle ball adds F_c to the outer loads
  using Sums = void(const KernelInput& in, BallRowOutput& out, const TractionInput* with, RowTractions* tractions);
  Sums* sum_in_plane;      ///< of a ring that only translates, in a row that is radial
  Sums* sum_translations;  ///< of a ring that only translates
  Sums* sum_all_motions;   ///< of one that moves in all five ways
  /// Sum of delta^(5/2) of a ring that moves in all five ways.
  double (*sum_deflections)(const KernelInput& in);
};
// Nothing but these leaves the objects that ball_row_kernels.cpp is compiled to (cmake/LaneEngine.cmake).
const RowKernels& row_kernels_base();
const RowKernels& row_kernels_v3();
const RowKernels& row_kernels_v4();
const RowKernels& row_kernels_v4_newton();
/// Those of this process.
const RowKernels& row_kernels();

}  // namespace rotordrop
