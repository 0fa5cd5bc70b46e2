#pragma once
#include <cstddef>

namespace rotordrop {

/// Sums of forces times shapes of a bent ring, from tables by points (of an arc, or balls).
/// @param force     at each point [n]
/// @param by_point  shapes at the points [n][n_shapes]; n and n_shapes are whole vectors (base/wide_vectors.h)
/// @param sums      [n_shapes]
void forces_on_shapes(const double* force, const double* by_point, std::size_t n, std::size_t n_shapes, double* sums);

}  // namespace rotordrop
