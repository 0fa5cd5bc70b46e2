#include "bearing/forces_on_shapes.h"

#include "base/wide_vectors.h"

namespace rotordrop {
namespace {

ROTORDROP_KERNEL void forces_on_shapes_kernel(const double* force, const double* by_point, std::size_t n,
                                              std::size_t n_shapes, double* sums) {
  const std::size_t row = whole_vectors(n_shapes);
#pragma omp simd
  for (std::size_t k = 0; k < row; ++k) sums[k] = 0.;
  for (std::size_t j = 0; j < n; j += 4) {
    const double F_0 = force[j], F_1 = force[j + 1], F_2 = force[j + 2], F_3 = force[j + 3];
    const double *t_0 = by_point + j * row, *t_1 = t_0 + row, *t_2 = t_1 + row, *t_3 = t_2 + row;
#pragma omp simd
    for (std::size_t k = 0; k < row; ++k) sums[k] += (F_0 * t_0[k] + F_1 * t_1[k]) + (F_2 * t_2[k] + F_3 * t_3[k]);
  }
}

}  // namespace

void forces_on_shapes(const double* force, const double* by_point, std::size_t n, std::size_t n_shapes, double* sums) {
  wide<forces_on_shapes_kernel>(force, by_point, n, n_shapes, sums);
}

}  // namespace rotordrop
