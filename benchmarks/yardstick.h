#pragma once
// What the balls cost at least: a yardstick beside the program's rows, written for benchmarks only. Rigid rings that translate, no waves, no
// inertia; the sums that motion and energy need, and nothing else.
#include <array>
#include <cmath>
#include <cstddef>

#include "base/wide_vectors.h"

namespace yardstick {

using rotordrop::Octet;
using rotordrop::vector_length;

constexpr std::size_t most_balls = 32;

/// A row of at most most_balls balls, the rest idle.
struct Row {
  alignas(64) std::array<double, most_balls> cosine{}, sine{}, idle{};
  std::size_t n_vectors = 0;
  double A = 0, radial = 0, axial = 0, K = 0, damping = 0;
};

struct Motion {
  double y = 0, z = 0, vy = 0, vz = 0, cage_cosine = 1, cage_sine = 0;
};

/// On the inner ring.
struct Sums {
  double fy = 0, fz = 0, dissipated = 0, radial = 0, cage = 0;
};

/// All rows of a machine in one call.
template <std::size_t n_rows>
ROTORDROP_KERNEL void sum_rows(const Row* rows, const Motion& m, Sums* sums) {
  const double C = m.cage_cosine, S = m.cage_sine, ey = m.y, ez = m.z, vy = m.vy, vz = m.vz;
  for (std::size_t r = 0; r < n_rows; ++r) {
    const Row& row = rows[r];
    const double axial_squared = row.axial * row.axial;
    Octet fy, fz, dissipated, radial, cage;
    for (std::size_t v = 0; v < row.n_vectors; ++v)
#pragma omp simd
      for (std::size_t i = 0; i < vector_length; ++i) {
        const std::size_t j = v * vector_length + i;
        const double c = C * row.cosine[j] - S * row.sine[j], s = S * row.cosine[j] + C * row.sine[j];
        const double Br = row.radial + ey * c + ez * s;
        const double distance = std::sqrt(Br * Br + axial_squared), cos_phi = Br / distance;
        const double delta = std::max(distance - row.A + row.idle[j], 0.);
        const double rate = cos_phi * (vy * c + vz * s);
        const double stiffness = row.K * std::sqrt(delta), elastic = stiffness * delta;
        const double F = std::max(stiffness * (delta + row.damping * rate), 0.), pull = F * cos_phi;
        fy[i] -= pull * c;
        fz[i] -= pull * s;
        dissipated[i] += (F - elastic) * rate;
        radial[i] += elastic * cos_phi;
        cage[i] += elastic * cos_phi * (ez * c - ey * s);
      }
    sums[r] = {fy.sum(), fz.sum(), dissipated.sum(), radial.sum(), cage.sum()};
  }
}

}  // namespace yardstick
