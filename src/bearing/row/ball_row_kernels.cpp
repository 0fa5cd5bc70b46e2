#include "bearing/row/ball_row_kernels.h"

#include "bearing/row/ball_row_bending.h"
#include "bearing/row/row_vectors.h"

// Compiled for every level of vectors, with ROTORDROP_LANE_FACTORY the name of the function that gives the kernels.
namespace rotordrop {
namespace {

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

template <GrooveMotion motion, bool is_bent>
ROTORDROP_KERNEL BallTerms<Balls> penetration(const KernelInput& in, const RowPlaceOf<Balls>& place,
                                              const Balls& cosine, const Balls& sine, const Balls& added,
                                              std::size_t j) {
  BallWidening<Balls> bent{0., 0., 0.};
  if constexpr (is_bent)
    bent = {Balls::load(&in.bent->width[j]), Balls::load(&in.bent->rate[j]), Balls::load(&in.bent->slope[j])};
  return ball_penetration<motion, is_bent>(place, cosine, sine, added, bent);
}

template <GrooveMotion motion, bool is_bent, bool is_wavy, bool with_tractions>
void sum_balls(const KernelInput& in, BallRowOutput& out, const TractionInput* with, RowTractions* tractions) {
  constexpr bool tilts = motion == GrooveMotion::all;
  const RowPlaceOf<Balls> place = in_all_lanes(in.place);
  ForceSumsOf<Sum> all_forces;
  [[maybe_unused]] TractionSumsOf<Sum> all_tractions;
  [[maybe_unused]] TractionInputOf<Balls> traction_input;
  [[maybe_unused]] Octet all_waviness;
  if constexpr (with_tractions) traction_input = in_all_lanes(*with);
  for (std::size_t first = 0; first < vector_length; first += at_once) {
    ForceSumsOf<Balls> forces;
    [[maybe_unused]] TractionSumsOf<Balls> traction_sums;
    [[maybe_unused]] Balls waviness = 0.;
    for (std::size_t j = first; j < in.n; j += vector_length) {
      const Balls cosine = Balls::load(in.cosine + j), sine = Balls::load(in.sine + j);
      Balls added = Balls::load(in.idle + j);
      if constexpr (is_wavy) added += some_of(*in.waves, j).added();
      BallTerms<Balls> b = penetration<motion, is_bent>(in, place, cosine, sine, added, j);
      press_ball(place, b);
      forces.add<motion>(place, b, cosine, sine);
      if constexpr (is_wavy) waviness += b.elastic * some_of(*in.waves, j).rate();
      if constexpr (is_bent) (b.F * b.cos_phi).store(&in.bent->force[j]);
      if constexpr (with_tractions) traction_sums.add<motion>(traction_input, b);
    }
    put_part(forces, first, all_forces);
    if constexpr (with_tractions) put_part(traction_sums, first, all_tractions);
    if constexpr (is_wavy) waviness.store(&all_waviness[first]);
  }
  put<tilts>(over_lanes<tilts>(all_forces), in.place, in.stiffness_root, out);
  if constexpr (with_tractions) put(over_lanes(all_tractions), *with, *tractions);
  out.waviness_power = is_wavy ? all_waviness.sum() : 0.;
}

template <GrooveMotion motion, bool is_bent, bool is_wavy>
void sum_with_or_without(const KernelInput& in, BallRowOutput& out, const TractionInput* with,
                         RowTractions* tractions) {
  with ? sum_balls<motion, is_bent, is_wavy, true>(in, out, with, tractions)
       : sum_balls<motion, is_bent, is_wavy, false>(in, out, with, tractions);
}
template <GrooveMotion motion, bool is_bent>
void sum_wavy_or_smooth(const KernelInput& in, BallRowOutput& out, const TractionInput* with, RowTractions* tractions) {
  in.waves ? sum_with_or_without<motion, is_bent, true>(in, out, with, tractions)
           : sum_with_or_without<motion, is_bent, false>(in, out, with, tractions);
}
template <GrooveMotion motion>
void sum_chosen(const KernelInput& in, BallRowOutput& out, const TractionInput* with, RowTractions* tractions) {
  in.bent ? sum_wavy_or_smooth<motion, true>(in, out, with, tractions)
          : sum_wavy_or_smooth<motion, false>(in, out, with, tractions);
}

template <bool is_bent>
double deflections(const KernelInput& in) {
  const RowPlaceOf<Balls> place = in_all_lanes(in.place);
  Octet all;
  for (std::size_t first = 0; first < vector_length; first += at_once) {
    Balls sum = 0.;
    for (std::size_t j = first; j < in.n; j += vector_length) {
      Balls added = Balls::load(in.idle + j);
      if (in.waves) added += some_of(*in.waves, j).added();
      const Balls delta = penetration<GrooveMotion::all, is_bent>(in, place, Balls::load(in.cosine + j),
                                                                  Balls::load(in.sine + j), added, j)
                              .delta;
      sum += delta * delta * sqrt(delta);
    }
    sum.store(&all[first]);
  }
  return all.sum();
}
double sum_deflections(const KernelInput& in) { return in.bent ? deflections<true>(in) : deflections<false>(in); }

constexpr RowKernels kernels{sum_chosen<GrooveMotion::in_plane>, sum_chosen<GrooveMotion::translating>,
                             sum_chosen<GrooveMotion::all>, sum_deflections};

}  // namespace

const RowKernels& ROTORDROP_LANE_FACTORY() { return kernels; }

}  // namespace rotordrop
