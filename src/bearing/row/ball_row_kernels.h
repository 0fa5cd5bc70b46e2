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
  const double* added;                                 // to every delta: ball growth and waviness [n]
  std::size_t n;                                       // a multiple of vector_length
  double A, radial, axial, arm, position, K, damping;  // damping = 1.5 beta
  double cage_cosine, cage_sine;
  RingDisplacement e, v;
  Widening* bent;  // of bent rings; of rigid ones none
};

// Raceways' edges as sum_tractions() needs them. Beyond an edge lies 1/2 - r (sine cos phi - cosine |sin phi|) / (2 a) of the length 2 a, a = factor K^(1/3) root.
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

/// Forces of a ring that translates only, or moves in all five ways; of rigid rings, and of bent ones. Each is compiled for several kinds of machine.
void sum_translations(const KernelInput& in, BallRowOutput& out);
void sum_bent_translations(const KernelInput& in, BallRowOutput& out);
void sum_all(const KernelInput& in, BallRowOutput& out);
void sum_all_bent(const KernelInput& in, BallRowOutput& out);
/// Not for every evaluation: what skidding needs. An idle ball adds F_c to the outer loads.
void sum_tractions(const KernelInput& in, double F_c, double inner_share, const RaceEdges& edges, RowTractions& out);
void sum_bent_tractions(const KernelInput& in, double F_c, double inner_share, const RaceEdges& edges,
                        RowTractions& out);

}  // namespace rotordrop
