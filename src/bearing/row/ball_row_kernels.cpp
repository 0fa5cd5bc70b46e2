#include "bearing/row/ball_row_kernels.h"

#include <algorithm>
#include <cmath>

#include "base/wide_vectors.h"
#include "bearing/row/ball_row_bending.h"

// The row kernel is compiled for several kinds of machine and chosen when the program starts.
namespace rotordrop {

namespace {

/// Sums over a row's balls, kept by lane.
struct ForceSums {
  Lanes fx, fy, fz, my, mz, dissipated, elastic_radial, elastic_axial, elastic_normal, cage, largest, roots;
};
struct TractionSums {
  Lanes inner, outer, gyroscopic, largest, truncation;
};

/// One ball's contact with the races.
struct BallContact {
  double sin_phi, cos_phi, delta, root, F;
};

ROTORDROP_KERNEL void add_tractions(const TractionInput& with, const BallContact& b, std::size_t l, TractionSums& sum) {
  constexpr double nothing = 1e-100;  // [N]
  const OuterContact o = outer_contact(b.F, b.sin_phi, b.cos_phi, with.F_c);
  const double T_g = gyroscopic_traction(with.F_c, o.sine);
  sum.inner[l] += b.F;
  sum.outer[l] += o.load;
  sum.gyroscopic[l] += T_g;
  const double inner_demand = with.inner_share * T_g / (b.F + nothing),
               outer_demand = (1. - with.inner_share) * T_g * o.per_load;
  sum.largest[l] = std::max(sum.largest[l], std::max(inner_demand, outer_demand));
  // Without damping, Q^(1/3) = K^(1/3) delta^(1/2).
  const auto &inner_edge = with.edges.inner, &outer_edge = with.edges.outer;
  const double sine = std::fabs(b.sin_phi), per_root = 1. / (b.root + 1e-30);
  const double inner_margin = (inner_edge.sine * b.cos_phi - inner_edge.cosine * sine) * per_root;
  const double outer_margin = (outer_edge.sine * b.cos_phi - outer_edge.cosine * sine) * per_root;
  const double margin = inner_margin < outer_margin ? inner_margin : outer_margin;
  const double beyond = b.delta > 0. ? 0.5 - margin : 0.;
  sum.truncation[l] = sum.truncation[l] > beyond ? sum.truncation[l] : beyond;
}

// A ring that only translates leaves out the terms of tilt and axial motion: the hot loop of every drop.
template <bool tilts, bool is_bent, bool with_tractions>
ROTORDROP_KERNEL void sum_balls(const KernelInput& in, BallRowOutput& out, const TractionInput* with,
                                RowTractions* tractions) {
  ForceSums sum;
  TractionSums traction_sum;
  const double C = in.cage_cosine, S = in.cage_sine, arm = in.arm, xr = in.position;
  const RingDisplacement e = in.e, v = in.v;
  const double radial = in.radial, A = in.A, grown = in.grown, K = in.K, damping = in.damping;
  const std::size_t n = whole_vectors(in.n);
  for (std::size_t first = 0; first < n; first += vector_length) {
#pragma omp simd
    for (std::size_t l = 0; l < vector_length; ++l) {
      const std::size_t j = first + l;
      const double c = C * in.cosine[j] - S * in.sine[j];
      const double s = S * in.cosine[j] + C * in.sine[j];
      double e_y = e.y, e_z = e.z, v_y = v.y, v_z = v.z, Bx = in.axial, Bx_rate = 0., Bx_turn = 0.;
      if constexpr (tilts) {
        e_y += xr * e.psi_z;
        e_z -= xr * e.psi_y;
        v_y += xr * v.psi_z;
        v_z -= xr * v.psi_y;
        Bx += e.x + arm * (e.psi_y * s - e.psi_z * c);
        Bx_rate = v.x + arm * (v.psi_y * s - v.psi_z * c);
        Bx_turn = arm * (e.psi_y * c + e.psi_z * s);
      }
      double Br = radial + e_y * c + e_z * s, Br_rate = v_y * c + v_z * s, Br_turn = e_z * c - e_y * s;
      if constexpr (is_bent) {
        Br += in.bent->width[j];
        Br_rate += in.bent->rate[j];
        Br_turn += in.bent->slope[j];
      }
      const double distance = std::sqrt(Br * Br + Bx * Bx);
      const double inverse = 1. / distance;
      const double cos_phi = Br * inverse, sin_phi = Bx * inverse;
      const double delta = std::max(distance - A + (grown + in.added[j]), 0.);
      double rate = cos_phi * Br_rate;
      if constexpr (tilts) rate += sin_phi * Bx_rate;
      const double root = std::sqrt(delta);
      const double stiffness = K * root;
      const double elastic = stiffness * delta;
      const double F = std::max(stiffness * (delta + damping * rate), 0.);
      const double F_radial = F * cos_phi, F_axial = F * sin_phi;
      if constexpr (is_bent) in.bent->force[j] = F_radial;
      sum.fx[l] -= F_axial;
      sum.fy[l] -= F_radial * c;
      sum.fz[l] -= F_radial * s;
      if constexpr (tilts) {
        sum.my[l] += F_radial * xr * s - F_axial * arm * s;
        sum.mz[l] += F_axial * arm * c - F_radial * xr * c;
      }
      sum.dissipated[l] += (F - elastic) * rate;
      sum.elastic_radial[l] += elastic * cos_phi;
      sum.elastic_axial[l] += elastic * sin_phi;
      sum.elastic_normal[l] += elastic;
      sum.cage[l] += elastic * (cos_phi * Br_turn + sin_phi * Bx_turn);
      sum.largest[l] = std::max(sum.largest[l], F);
      sum.roots[l] += root;
      if constexpr (with_tractions) add_tractions(*with, {sin_phi, cos_phi, delta, root, F}, l, traction_sum);
    }
  }
  out.force_x = sum.fx.sum();
  out.force_y = sum.fy.sum();
  out.force_z = sum.fz.sum();
  out.moment_y = tilts ? sum.my.sum() : 0.;
  out.moment_z = tilts ? sum.mz.sum() : 0.;
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
  Lanes sum;
  const double C = in.cage_cosine, S = in.cage_sine, arm = in.arm, xr = in.position;
  const RingDisplacement e = in.e;
  const double e_y = e.y + xr * e.psi_z, e_z = e.z - xr * e.psi_y;
  const std::size_t n = whole_vectors(in.n);
  for (std::size_t first = 0; first < n; first += vector_length) {
#pragma omp simd
    for (std::size_t l = 0; l < vector_length; ++l) {
      const std::size_t j = first + l;
      const double c = C * in.cosine[j] - S * in.sine[j];
      const double s = S * in.cosine[j] + C * in.sine[j];
      double Br = in.radial + e_y * c + e_z * s;
      if constexpr (is_bent) Br += in.bent->width[j];
      const double Bx = in.axial + e.x + arm * (e.psi_y * s - e.psi_z * c);
      const double delta = std::max(std::sqrt(Br * Br + Bx * Bx) - in.A + (in.grown + in.added[j]), 0.);
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
