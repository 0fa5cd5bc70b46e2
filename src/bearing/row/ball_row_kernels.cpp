#include "bearing/row/ball_row_kernels.h"

#include <algorithm>
#include <cmath>

#include "base/wide_vectors.h"
#include "bearing/row/ball_row_bending.h"

// The row kernel is compiled for several kinds of machine and chosen when the program starts.
namespace rotordrop {

namespace {

/// Sums over a row's balls, kept element by element.
struct ForceSums {
  Octet fx, fy, fz, my, mz, dissipated, elastic_radial, elastic_axial, elastic_normal, cage, largest, roots;
};
struct TractionSums {
  Octet inner, outer, gyroscopic, largest, truncation;
};

ROTORDROP_KERNEL void add_tractions(const TractionInput& with, const BallTerms<double>& b, std::size_t l,
                                    TractionSums& sum) {
  const TractionTerms<double> t = traction_terms(with, b);
  sum.inner[l] += b.F;
  sum.outer[l] += t.outer;
  sum.gyroscopic[l] += t.gyroscopic;
  sum.largest[l] = std::max(sum.largest[l], t.demand);
  sum.truncation[l] = sum.truncation[l] > t.beyond ? sum.truncation[l] : t.beyond;
}

template <bool tilts, bool is_bent, bool with_tractions>
ROTORDROP_KERNEL void sum_balls(const KernelInput& in, BallRowOutput& out, const TractionInput* with,
                                RowTractions* tractions) {
  ForceSums sum;
  TractionSums traction_sum;
  const RowPlaceOf<double>& place = in.place;
  const std::size_t n = whole_vectors(in.n);
  for (std::size_t first = 0; first < n; first += vector_length) {
#pragma omp simd
    for (std::size_t l = 0; l < vector_length; ++l) {
      const std::size_t j = first + l;
      BallWidening<double> bent{};
      if constexpr (is_bent) bent = {in.bent->width[j], in.bent->rate[j], in.bent->slope[j]};
      const double c = in.cosine[j], s = in.sine[j];
      BallTerms<double> b = ball_penetration<tilts, is_bent>(place, c, s, in.added[j], bent);
      press_ball(place, b);
      const double F_radial = b.F * b.cos_phi, F_axial = b.F * b.sin_phi;
      if constexpr (is_bent) in.bent->force[j] = F_radial;
      sum.fx[l] -= F_axial;
      sum.fy[l] -= F_radial * c;
      sum.fz[l] -= F_radial * s;
      if constexpr (tilts) {
        sum.my[l] += F_radial * place.position * s - F_axial * place.arm * s;
        sum.mz[l] += F_axial * place.arm * c - F_radial * place.position * c;
      }
      sum.dissipated[l] += (b.F - b.elastic) * b.rate;
      sum.elastic_radial[l] += b.elastic * b.cos_phi;
      sum.elastic_axial[l] += b.elastic * b.sin_phi;
      sum.elastic_normal[l] += b.elastic;
      sum.cage[l] += b.cage;
      sum.largest[l] = std::max(sum.largest[l], b.F);
      sum.roots[l] += b.root;
      if constexpr (with_tractions) add_tractions(*with, b, l, traction_sum);
    }
  }
  out.force_x = sum.fx.sum();
  out.force_y = sum.fy.sum();
  out.force_z = sum.fz.sum();
  out.moment_y = tilts ? sum.my.sum() : 0.;
  out.moment_z = tilts ? sum.mz.sum() : 0.;
  place.turn_back(out.force_y, out.force_z);
  if constexpr (tilts) place.turn_back(out.moment_y, out.moment_z);
  out.damping_power = sum.dissipated.sum();
  out.elastic_radial = sum.elastic_radial.sum();
  out.elastic_axial = sum.elastic_axial.sum();
  out.elastic_normal = sum.elastic_normal.sum();
  out.elastic_outer_surplus = 0;
  out.cage_torque = sum.cage.sum();
  out.largest_load = out.largest_outer_load = sum.largest.largest();
  out.inner_load_roots = sum.roots.sum();
  out.inner_loads = out.outer_loads = out.elastic_normal;
  out.inertia_power = out.inertia_per_speed = 0;
  if constexpr (with_tractions) {
    const double gyroscopic = traction_sum.gyroscopic.sum();
    tractions->inner_load = traction_sum.inner.sum();
    tractions->outer_load = traction_sum.outer.sum();
    tractions->gyroscopic = (1. - with->inner_share) * gyroscopic;
    tractions->largest_gyroscopic_over_load = traction_sum.largest.largest();
    tractions->inner_gyroscopic = with->inner_share * gyroscopic;
    tractions->centrifugal = with->F_c;
    tractions->truncation = std::min(traction_sum.truncation.largest(), 1.);
  }
}

template <bool is_bent>
ROTORDROP_KERNEL double deflections(const KernelInput& in) {
  Octet sum;
  const RowPlaceOf<double>& place = in.place;
  const std::size_t n = whole_vectors(in.n);
  for (std::size_t first = 0; first < n; first += vector_length) {
#pragma omp simd
    for (std::size_t l = 0; l < vector_length; ++l) {
      const std::size_t j = first + l;
      BallWidening<double> bent{};
      if constexpr (is_bent) bent.width = in.bent->width[j];
      const double delta = ball_penetration<true, is_bent>(place, in.cosine[j], in.sine[j], in.added[j], bent).delta;
      sum[l] += delta * delta * std::sqrt(delta);
    }
  }
  return sum.sum();
}

template <bool tilts>
void sum_chosen(const KernelInput& in, BallRowOutput& out, const TractionInput* with, RowTractions* tractions) {
  if (in.bent)
    with ? wide<sum_balls<tilts, true, true>>(in, out, with, tractions)
         : wide<sum_balls<tilts, true, false>>(in, out, with, tractions);
  else
    with ? wide<sum_balls<tilts, false, true>>(in, out, with, tractions)
         : wide<sum_balls<tilts, false, false>>(in, out, with, tractions);
}

}  // namespace

void sum_translations(const KernelInput& in, BallRowOutput& out, const TractionInput* with, RowTractions* tractions) {
  sum_chosen<false>(in, out, with, tractions);
}
void sum_all_motions(const KernelInput& in, BallRowOutput& out, const TractionInput* with, RowTractions* tractions) {
  sum_chosen<true>(in, out, with, tractions);
}
double sum_deflections(const KernelInput& in) {
  return in.bent ? wide<deflections<true>>(in) : wide<deflections<false>>(in);
}

}  // namespace rotordrop
