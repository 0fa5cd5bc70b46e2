#include "bearing/row/ball_row_kernels.h"

#include <algorithm>
#include <cmath>

#include "base/wide_vectors.h"
#include "bearing/row/ball_row_bending.h"

// The row kernel is compiled for several kinds of machine and chosen when the program starts. AVX-512 serves for its 32 registers: the
// loop keeps eight sums.
// Sanitizers cannot see through the chooser.
namespace rotordrop {

namespace {

/// The arrays of bent rings, which overlap with nothing else that a kernel reads.
struct BentArrays {
  const double* __restrict width;
  const double* __restrict rate;
  const double* __restrict slope;
  double* __restrict force;
};
template <bool is_bent>
ROTORDROP_KERNEL BentArrays bent_arrays(const KernelInput& in) {
  if constexpr (is_bent)
    return {in.bent->width.data(), in.bent->rate.data(), in.bent->slope.data(), in.bent->force.data()};
  return {};
}

// The two kernels differ in the tilt and axial terms only; kept apart because the short one is the hot loop of every drop.
template <bool is_bent>
ROTORDROP_KERNEL void translations(const KernelInput& in, BallRowOutput& out) {
  const BentArrays bent = bent_arrays<is_bent>(in);
  double fy = 0, fz = 0, fx = 0, dissipated = 0, elastic_radial = 0, elastic_axial = 0, elastic_normal = 0, cage = 0;
  double largest = 0, roots = 0;
  const double C = in.cage_cosine, S = in.cage_sine, ey = in.e.y, ez = in.e.z, vy = in.v.y, vz = in.v.z;
  const double radial = in.radial, Bx = in.axial, Bx2 = Bx * Bx, A = in.A, K = in.K, damping = in.damping;
#pragma omp simd reduction(+ : fy, fz, fx, dissipated, elastic_radial, elastic_axial, elastic_normal, cage, roots) reduction(max : largest)
  for (std::size_t j = 0; j < in.n; ++j) {
    const double c = C * in.cosine[j] - S * in.sine[j];
    const double s = S * in.cosine[j] + C * in.sine[j];
    double Br = radial + ey * c + ez * s, Br_rate = vy * c + vz * s;
    if constexpr (is_bent) {
      Br += bent.width[j];
      Br_rate += bent.rate[j];
    }
    const double distance = std::sqrt(Br * Br + Bx2);
    const double inverse = 1. / distance;
    const double cos_phi = Br * inverse;
    const double delta = std::max(distance - A + in.added[j], 0.);
    const double rate = cos_phi * Br_rate;
    const double root = std::sqrt(delta);
    const double stiffness = K * root;
    const double elastic = stiffness * delta;
    const double F = std::max(stiffness * (delta + damping * rate), 0.);
    const double F_radial = F * cos_phi;
    if constexpr (is_bent) bent.force[j] = F_radial;
    fy -= F_radial * c;
    fz -= F_radial * s;
    fx -= F * inverse;
    dissipated += (F - elastic) * rate;
    elastic_radial += elastic * cos_phi;
    elastic_axial += elastic * inverse;
    elastic_normal += elastic;
    double Br_turn = ez * c - ey * s;
    if constexpr (is_bent) Br_turn += bent.slope[j];
    cage += elastic * cos_phi * Br_turn;
    largest = std::max(largest, F);
    roots += root;
  }
  out.force_x = fx * Bx;
  out.force_y = fy;
  out.force_z = fz;
  out.moment_y = out.moment_z = 0;
  out.damping_power = dissipated;
  out.elastic_radial = elastic_radial;
  out.elastic_axial = elastic_axial * Bx;
  out.elastic_normal = elastic_normal;
  out.elastic_outer_surplus = 0;
  out.cage_torque = cage;
  out.largest_load = out.largest_outer_load = largest;
  out.inner_load_roots = roots;
  out.inner_loads = out.outer_loads = elastic_normal;
  out.inertia_power = out.inertia_per_speed = 0;
}

template <bool is_bent>
ROTORDROP_KERNEL void all_motions(const KernelInput& in, BallRowOutput& out) {
  const BentArrays bent = bent_arrays<is_bent>(in);
  double fy = 0, fz = 0, fx = 0, my = 0, mz = 0, dissipated = 0, elastic_radial = 0, elastic_normal = 0, cage = 0;
  double elastic_axial = 0, largest = 0, roots = 0;
  const double C = in.cage_cosine, S = in.cage_sine, arm = in.arm, xr = in.position;
  const RingDisplacement e = in.e, v = in.v;
#pragma omp simd reduction(+ : fy, fz, fx, my, mz, dissipated, elastic_radial, elastic_axial, elastic_normal, cage, roots) reduction(max : largest)
  for (std::size_t j = 0; j < in.n; ++j) {
    const double c = C * in.cosine[j] - S * in.sine[j];
    const double s = S * in.cosine[j] + C * in.sine[j];
    double Br = in.radial + (e.y + xr * e.psi_z) * c + (e.z - xr * e.psi_y) * s;
    double Br_rate = (v.y + xr * v.psi_z) * c + (v.z - xr * v.psi_y) * s;
    double Br_turn = (e.z - xr * e.psi_y) * c - (e.y + xr * e.psi_z) * s;
    if constexpr (is_bent) {
      Br += bent.width[j];
      Br_rate += bent.rate[j];
      Br_turn += bent.slope[j];
    }
    const double Bx = in.axial + e.x + arm * (e.psi_y * s - e.psi_z * c);
    const double distance = std::sqrt(Br * Br + Bx * Bx);
    const double inverse = 1. / distance;
    const double cos_phi = Br * inverse, sin_phi = Bx * inverse;
    const double delta = std::max(distance - in.A + in.added[j], 0.);
    const double rate = cos_phi * Br_rate + sin_phi * (v.x + arm * (v.psi_y * s - v.psi_z * c));
    const double root = std::sqrt(delta);
    const double stiffness = in.K * root;
    const double elastic = stiffness * delta;
    const double F = std::max(stiffness * (delta + in.damping * rate), 0.);
    const double F_radial = F * cos_phi, F_axial = F * sin_phi;
    if constexpr (is_bent) bent.force[j] = F_radial;
    fy -= F_radial * c;
    fz -= F_radial * s;
    fx -= F_axial;
    my += F_radial * xr * s - F_axial * arm * s;
    mz += F_axial * arm * c - F_radial * xr * c;
    dissipated += (F - elastic) * rate;
    elastic_radial += elastic * cos_phi;
    elastic_axial += elastic * sin_phi;
    elastic_normal += elastic;
    cage += elastic * (cos_phi * Br_turn + sin_phi * arm * (e.psi_y * c + e.psi_z * s));
    largest = std::max(largest, F);
    roots += root;
  }
  out.force_x = fx;
  out.force_y = fy;
  out.force_z = fz;
  out.moment_y = my;
  out.moment_z = mz;
  out.damping_power = dissipated;
  out.elastic_radial = elastic_radial;
  out.elastic_axial = elastic_axial;
  out.elastic_normal = elastic_normal;
  out.elastic_outer_surplus = 0;
  out.cage_torque = cage;
  out.largest_load = out.largest_outer_load = largest;
  out.inner_load_roots = roots;
  out.inner_loads = out.outer_loads = elastic_normal;
  out.inertia_power = out.inertia_per_speed = 0;
}

template <bool is_bent>
ROTORDROP_KERNEL void tractions_of(const KernelInput& in, double F_c, double inner_share, const RaceEdges& edges,
                                   RowTractions& out) {
  const BentArrays bent = bent_arrays<is_bent>(in);
  double inner = 0, outer = 0, gyroscopic = 0, largest = 0, truncation = 0;
  constexpr double nothing = 1e-100;  // [N]
  const RaceEdge inner_edge = edges.inner, outer_edge = edges.outer;
  const double C = in.cage_cosine, S = in.cage_sine, arm = in.arm, xr = in.position;
  const RingDisplacement e = in.e, v = in.v;
#pragma omp simd reduction(+ : inner, outer, gyroscopic) reduction(max : largest, truncation)
  for (std::size_t j = 0; j < in.n; ++j) {
    const double c = C * in.cosine[j] - S * in.sine[j];
    const double s = S * in.cosine[j] + C * in.sine[j];
    double Br = in.radial + (e.y + xr * e.psi_z) * c + (e.z - xr * e.psi_y) * s;
    double Br_rate = (v.y + xr * v.psi_z) * c + (v.z - xr * v.psi_y) * s;
    if constexpr (is_bent) {
      Br += bent.width[j];
      Br_rate += bent.rate[j];
    }
    const double Bx = in.axial + e.x + arm * (e.psi_y * s - e.psi_z * c);
    const double distance = std::sqrt(Br * Br + Bx * Bx);
    const double inverse = 1. / distance;
    const double cos_phi = Br * inverse, sin_phi = Bx * inverse;
    const double delta = std::max(distance - in.A + in.added[j], 0.);
    const double rate = cos_phi * Br_rate + sin_phi * (v.x + arm * (v.psi_y * s - v.psi_z * c));
    const double F = std::max(in.K * std::sqrt(delta) * (delta + in.damping * rate), 0.);
    const OuterContact o = outer_contact(F, sin_phi, cos_phi, F_c);
    const double T_g = gyroscopic_traction(F_c, o.sine);
    inner += F;
    outer += o.load;
    gyroscopic += T_g;
    const double inner_demand = inner_share * T_g / (F + nothing), outer_demand = (1. - inner_share) * T_g * o.per_load;
    largest = std::max(largest, std::max(inner_demand, outer_demand));
    // Without damping, Q^(1/3) = K^(1/3) delta^(1/2).
    const double sine = std::fabs(sin_phi), per_root = 1. / (std::sqrt(delta) + 1e-30);
    const double inner_margin = (inner_edge.sine * cos_phi - inner_edge.cosine * sine) * per_root;
    const double outer_margin = (outer_edge.sine * cos_phi - outer_edge.cosine * sine) * per_root;
    const double margin = inner_margin < outer_margin ? inner_margin : outer_margin;
    const double beyond = delta > 0. ? 0.5 - margin : 0.;
    truncation = truncation > beyond ? truncation : beyond;
  }
  out = {inner, outer, (1. - inner_share) * gyroscopic, largest, inner_share * gyroscopic};
  out.truncation = std::min(truncation, 1.);
}

}  // namespace

void sum_translations(const KernelInput& in, BallRowOutput& out) { wide<translations<false>>(in, out); }
void sum_bent_translations(const KernelInput& in, BallRowOutput& out) { wide<translations<true>>(in, out); }
void sum_all(const KernelInput& in, BallRowOutput& out) { wide<all_motions<false>>(in, out); }
void sum_all_bent(const KernelInput& in, BallRowOutput& out) { wide<all_motions<true>>(in, out); }
void sum_tractions(const KernelInput& in, double F_c, double inner_share, const RaceEdges& edges, RowTractions& out) {
  wide<tractions_of<false>>(in, F_c, inner_share, edges, out);
}
void sum_bent_tractions(const KernelInput& in, double F_c, double inner_share, const RaceEdges& edges,
                        RowTractions& out) {
  wide<tractions_of<true>>(in, F_c, inner_share, edges, out);
}

}  // namespace rotordrop
