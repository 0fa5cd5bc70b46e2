#pragma once
// Rests where steady temperatures fold back over their heat.
//
// Balls that conduct by their load make T(Q) fold: a loaded state may end at a heat Q_1 and another one begin at a heat Q_2 < Q_1, with a third
// between them that no search over Q comes to. It holds all the same if the heat follows the load: what the state would do under a held heat does
// not matter. Over the growth that closes the balls, s, nothing folds: s says what the balls carry, and so their heat and conductance, and one
// temperature field follows from these, T(s). Rests are the roots of
//   h(s) = c . growth(T(s)) - s,
// c the direction in which balls conduct better the fastest. Growth across c follows from T(s) by repetition.
#include <optional>
#include <vector>

#include "analysis/preload/preload_loop.h"

namespace rotordrop {

/// Temperatures of all rests, Q = Phi(T), that close the balls by more than one state and less than another, from a to b.
/// @param a, b  steady states beside a jump of T(Q)
std::vector<std::vector<double>> rests_between(const PreloadLoop& loop, std::span<const double> a,
                                               std::span<const double> b);

/// By how much the balls conduct better per growth of each surface, as a direction of length 1; nothing without load.
std::optional<Expansion> closing_direction(const PreloadLoop& loop, std::span<const double> T);

/// What balls conduct on all ways [W/K].
inline double sum_of(const BallConduction& b) { return b.inner_to_ball + b.outer_to_ball + b.inner_to_outer; }

}  // namespace rotordrop
