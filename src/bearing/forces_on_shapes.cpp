#include "bearing/forces_on_shapes.h"

#include <array>

#include "base/wide_vectors.h"

namespace rotordrop {
namespace {

/// Some vectors of shapes, from the first of them on. Even and odd points have their own sums, so that they do not wait for each other.
template <std::size_t vectors>
ROTORDROP_KERNEL void forces_on_shapes_at(const double* force, const double* by_point, std::size_t n, std::size_t row,
                                          double* sums) {
  std::array<Octet, vectors> even{}, odd{};
  for (std::size_t j = 0; j < whole_vectors(n); j += 2, by_point += 2 * row)
    for (std::size_t v = 0; v < vectors; ++v) {
      add_product(even[v], force[j], by_point + v * vector_length);
      add_product(odd[v], force[j + 1], by_point + row + v * vector_length);
    }
  for (std::size_t v = 0; v < vectors; ++v)
#pragma omp simd
    for (std::size_t i = 0; i < vector_length; ++i) sums[v * vector_length + i] = even[v][i] + odd[v][i];
}

ROTORDROP_KERNEL void forces_on_shapes_kernel(const double* force, const double* by_point, std::size_t n,
                                              std::size_t n_shapes, double* sums) {
  std::size_t k = 0;
  for (; k + 3 * vector_length <= n_shapes; k += 3 * vector_length)
    forces_on_shapes_at<3>(force, by_point + k, n, n_shapes, sums + k);
  for (; k < n_shapes; k += vector_length) forces_on_shapes_at<1>(force, by_point + k, n, n_shapes, sums + k);
}

}  // namespace

void forces_on_shapes(const double* force, const double* by_point, std::size_t n, std::size_t n_shapes, double* sums) {
  wide<forces_on_shapes_kernel>(force, by_point, n, n_shapes, sums);
}

}  // namespace rotordrop
