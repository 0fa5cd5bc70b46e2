#pragma once

// Sums over the balls of a row: the hot loops of every drop.
#include <cstddef>

#include "bearing/row/ball_row.h"
#include "laws/skidding.h"

namespace rotordrop {

// Rows are filled up to whole vectors with balls too small to touch anything.
inline constexpr double idle_penetration = -1.;  // added to an idle ball's penetration [m]

/// Balls, races and displacement of a row as its kernels take them.
struct KernelInput {
  const double* cosine;
  const double* sine;
  const double* added;                                 // to every delta, by ball: waviness, or idle_penetration [n]
  std::size_t n;                                       // a multiple of vector_length
  double grown;                                        // added to every delta: 2 eps_b
  double A, radial, axial, arm, position, K, damping;  // damping = 1.5 beta
  double cage_cosine, cage_sine;
  RingDisplacement e, v;
  Widening* bent;  // of bent rings; of rigid ones none
};

// Raceways' edges as the tractions' sums need them. Beyond an edge lies 1/2 - r (sine cos phi - cosine |sin phi|) / (2 a) of the length 2 a, a = factor K^(1/3) root.
struct RaceEdge {
  double sine, cosine;  // times r / (2 factor K^(1/3))
  RaceEdge(const RaceContact& race, double stiffness_root) : sine(1e30), cosine(-1e30) {
    if (!race.has_edge()) return;
    const double per_axis = 0.5 * race.groove_radius / (race.axis_factor * stiffness_root);
    sine = per_axis * race.edge_sine;
    cosine = per_axis * race.edge_cosine;
  }
};
struct RaceEdges {
  RaceEdge inner, outer;
};

/// What the tractions of a row depend on besides.
struct TractionInput {
  double F_c;          // of a ball, at the cage's speed [N]
  double inner_share;  // of the gyroscopic traction
  RaceEdges edges;
};

/// Sums over the balls of a row whose ring only translates, or moves in all five ways; of rigid rings, or of bent ones.
/// @param with, tractions  if what skidding needs is asked for, too; an idle ball adds F_c to the outer loads
void sum_translations(const KernelInput& in, BallRowOutput& out, const TractionInput* with, RowTractions* tractions);
void sum_all_motions(const KernelInput& in, BallRowOutput& out, const TractionInput* with, RowTractions* tractions);
/// Sum of delta^(5/2) of a ring that moves in all five ways.
double sum_deflections(const KernelInput& in);

}  // namespace rotordrop
