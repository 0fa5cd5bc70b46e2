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
  const double* cosine;
  const double* sine;
  const double* added;  // to every delta, by ball: waviness, or idle_penetration [n]
  std::size_t n;        // a multiple of vector_length
  Widening* bent;       // of bent rings; of rigid ones none
};
using RaceEdge = RaceEdgeOf<double>;
using TractionInput = TractionInputOf<double>;

/// Sums over the balls of a row whose ring only translates, or moves in all five ways; of rigid rings, or of bent ones.
/// @param with, tractions  if what skidding needs is asked for, too; an idle ball adds F_c to the outer loads
void sum_translations(const KernelInput& in, BallRowOutput& out, const TractionInput* with, RowTractions* tractions);
void sum_all_motions(const KernelInput& in, BallRowOutput& out, const TractionInput* with, RowTractions* tractions);
/// Sum of delta^(5/2) of a ring that moves in all five ways.
double sum_deflections(const KernelInput& in);

}  // namespace rotordrop
