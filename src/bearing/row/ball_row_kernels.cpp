#include "bearing/row/ball_row_kernels.h"

#include <cstring>

#include "base/drops.h"
#include "base/wide_vectors.h"
#include "bearing/row/ball_row_bending.h"

// Compiled for every level of vectors, with ROTORDROP_LANE_FACTORY the name of the function that gives the kernels.
namespace rotordrop {
namespace {

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

ROTORDROP_KERNEL double largest(const Sum& of) {
  Octet values;
  of.store(values.value.data());
  return values.largest();
}

/// What is summed by balls, over all of them.
template <bool tilts>
ROTORDROP_KERNEL ForceSumsOf<double> over_lanes(const ForceSumsOf<Sum>& sum) {
  ForceSumsOf<double> all;
  double sums[8];
  Sum::sum_lanes(
      {sum.fx, sum.fy, sum.fz, sum.dissipated, sum.elastic_radial, sum.elastic_axial, sum.elastic_normal, sum.cage},
      sums);
  all.fx = sums[0];
  all.fy = sums[1];
  all.fz = sums[2];
  all.dissipated = sums[3];
  all.elastic_radial = sums[4];
  all.elastic_axial = sums[5];
  all.elastic_normal = sums[6];
  all.cage = sums[7];
  all.roots = sum.roots.sum();
  if constexpr (tilts) {
    all.my = sum.my.sum();
    all.mz = sum.mz.sum();
  }
  all.largest = largest(sum.largest);
  return all;
}
ROTORDROP_KERNEL TractionSumsOf<double> over_lanes(const TractionSumsOf<Sum>& sum) {
  return {sum.inner.sum(), sum.outer.sum(), sum.gyroscopic.sum(), largest(sum.demand), largest(sum.truncation)};
}

template <bool tilts, bool is_bent>
ROTORDROP_KERNEL BallTerms<Balls> penetration(const KernelInput& in, const RowPlaceOf<Balls>& place,
                                              const Balls& cosine, const Balls& sine, std::size_t j) {
  BallWidening<Balls> bent{0., 0., 0.};
  if constexpr (is_bent)
    bent = {Balls::load(&in.bent->width[j]), Balls::load(&in.bent->rate[j]), Balls::load(&in.bent->slope[j])};
  return ball_penetration<tilts, is_bent>(place, cosine, sine, Balls::load(in.added + j), bent);
}

/// The sums of some lanes among those of all. @tparam Sums  a struct of nothing but its scalar
template <template <class> class Sums>
ROTORDROP_KERNEL void put_part(const Sums<Balls>& part, std::size_t first_lane, Sums<Sum>& all) {
  constexpr std::size_t n = sizeof part / sizeof(Balls);
  static_assert(sizeof all == n * sizeof(Sum));
  for (std::size_t k = 0; k < n; ++k)
    std::memcpy(reinterpret_cast<unsigned char*>(&all) + k * sizeof(Sum) + first_lane * sizeof(double),
                reinterpret_cast<const unsigned char*>(&part) + k * sizeof(Balls), sizeof(Balls));
}

template <bool tilts, bool is_bent, bool with_tractions>
void sum_balls(const KernelInput& in, BallRowOutput& out, const TractionInput* with, RowTractions* tractions) {
  const RowPlaceOf<Balls> place = in_all_lanes(in.place);
  ForceSumsOf<Sum> all_forces;
  [[maybe_unused]] TractionSumsOf<Sum> all_tractions;
  [[maybe_unused]] TractionInputOf<Balls> traction_input;
  if constexpr (with_tractions) traction_input = in_all_lanes(*with);
  for (std::size_t first = 0; first < vector_length; first += at_once) {
    ForceSumsOf<Balls> forces;
    [[maybe_unused]] TractionSumsOf<Balls> traction_sums;
    for (std::size_t j = first; j < in.n; j += vector_length) {
      const Balls cosine = Balls::load(in.cosine + j), sine = Balls::load(in.sine + j);
      BallTerms<Balls> b = penetration<tilts, is_bent>(in, place, cosine, sine, j);
      press_ball(place, b);
      forces.add<tilts>(place, b, cosine, sine);
      if constexpr (is_bent) (b.F * b.cos_phi).store(&in.bent->force[j]);
      if constexpr (with_tractions) traction_sums.add(traction_input, b);
    }
    put_part(forces, first, all_forces);
    if constexpr (with_tractions) put_part(traction_sums, first, all_tractions);
  }
  put<tilts>(over_lanes<tilts>(all_forces), in.place, in.stiffness_root, out);
  if constexpr (with_tractions) put(over_lanes(all_tractions), *with, *tractions);
}

template <bool tilts>
void sum_chosen(const KernelInput& in, BallRowOutput& out, const TractionInput* with, RowTractions* tractions) {
  if (in.bent)
    with ? sum_balls<tilts, true, true>(in, out, with, tractions)
         : sum_balls<tilts, true, false>(in, out, with, tractions);
  else
    with ? sum_balls<tilts, false, true>(in, out, with, tractions)
         : sum_balls<tilts, false, false>(in, out, with, tractions);
}

template <bool is_bent>
double deflections(const KernelInput& in) {
  const RowPlaceOf<Balls> place = in_all_lanes(in.place);
  Octet all;
  for (std::size_t first = 0; first < vector_length; first += at_once) {
    Balls sum = 0.;
    for (std::size_t j = first; j < in.n; j += vector_length) {
      const Balls delta =
          penetration<true, is_bent>(in, place, Balls::load(in.cosine + j), Balls::load(in.sine + j), j).delta;
      sum += delta * delta * sqrt(delta);
    }
    sum.store(&all[first]);
  }
  return all.sum();
}
double sum_deflections(const KernelInput& in) { return in.bent ? deflections<true>(in) : deflections<false>(in); }

constexpr RowKernels kernels{sum_chosen<false>, sum_chosen<true>, sum_deflections};

}  // namespace

const RowKernels& ROTORDROP_LANE_FACTORY() { return kernels; }

}  // namespace rotordrop
