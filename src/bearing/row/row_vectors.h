#pragma once
// Balls of a row in the lanes of vectors: what its kernels, which are compiled for every level of vectors, share.
#include <cstring>

#include "base/drops.h"
#include "base/wide_vectors.h"
#include "bearing/row/ball_row_kernels.h"

namespace rotordrop {

/// Balls of a row in one register: more of them at a time would not leave room for their sums. Every eighth ball adds to the same element of a sum, at
/// every level, so that all levels add in the same order.
using Balls = OneRegister;
using Sum = EightDrops;
static_assert(n_lanes == vector_length);
constexpr std::size_t at_once = register_width;

ROTORDROP_KERNEL RowPlaceOf<Balls> in_all_lanes(const RowPlaceOf<double>& p) {
  const auto all = [](const RingDisplacementOf<double>& d) {
    return RingDisplacementOf<Balls>{d.x, d.y, d.z, d.psi_y, d.psi_z};
  };
  return {p.grown, p.A,       p.radial,      p.axial,     p.arm,    p.position,
          p.K,     p.damping, p.cage_cosine, p.cage_sine, all(p.e), all(p.v)};
}
ROTORDROP_KERNEL TractionInputOf<Balls> in_all_lanes(const TractionInput& with) {
  TractionInputOf<Balls> all{with.F_c, with.inner_share, {}};
  all.edges.inner.sine = with.edges.inner.sine;
  all.edges.inner.cosine = with.edges.inner.cosine;
  all.edges.outer.sine = with.edges.outer.sine;
  all.edges.outer.cosine = with.edges.outer.cosine;
  return all;
}

/// Those of the balls from j on.
ROTORDROP_KERNEL BallWavesOf<Balls> some_of(const WavesAtBalls& waves, std::size_t j) {
  return {Balls::load(&waves.inner[j]), Balls::load(&waves.outer[j]), Balls::load(&waves.inner_rate[j]),
          Balls::load(&waves.outer_rate[j])};
}

ROTORDROP_KERNEL double largest(const Sum& of) {
  Octet values;
  of.store(values.value.data());
  return values.largest();
}

ROTORDROP_KERNEL TractionSumsOf<double> over_lanes(const TractionSumsOf<Sum>& sum) {
  return {sum.inner.sum(), sum.outer.sum(), sum.gyroscopic.sum(), largest(sum.demand), largest(sum.truncation)};
}

/// The sums of some lanes among those of all. @tparam Sums  a struct of nothing but its scalar
template <template <class> class Sums>
ROTORDROP_KERNEL void put_part(const Sums<Balls>& part, std::size_t first_lane, Sums<Sum>& all) {
  constexpr std::size_t n = sizeof part / sizeof(Balls);
  static_assert(sizeof all == n * sizeof(Sum));
#pragma GCC unroll 32  // lest GCC makes one long copy of it
  for (std::size_t k = 0; k < n; ++k)
    std::memcpy(reinterpret_cast<unsigned char*>(&all) + k * sizeof(Sum) + first_lane * sizeof(double),
                reinterpret_cast<const unsigned char*>(&part) + k * sizeof(Balls), sizeof(Balls));
}

}  // namespace rotordrop
