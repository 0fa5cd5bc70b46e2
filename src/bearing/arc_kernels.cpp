#include "bearing/arc_kernels.h"

#include <algorithm>

#include "base/wide_vectors.h"
#include "laws/vector_power.h"

namespace rotordrop {
namespace {

ROTORDROP_KERNEL void arc_overlaps_kernel(const ArcPlace& in, ArcValues& overlap, ArcValues& overlap_rate) {
  const double ey = in.ey, ez = in.ez, vy = in.vy, vz = in.vz, gap = in.gap;
  const double *cosine = in.cosine, *sine = in.sine;
  double *delta = overlap.at.data(), *rate = overlap_rate.at.data();
  const std::size_t n = whole_vectors(in.n);
#pragma omp simd
  for (std::size_t j = 0; j < n; ++j) {
    delta[j] = ey * cosine[j] + ez * sine[j] - gap;
    rate[j] = vy * cosine[j] + vz * sine[j];
  }
  std::size_t k = 0;
  for (; k + 4 <= in.n_shapes; k += 4) {
    const double *t_0 = in.shapes + k * in.stride, *t_1 = t_0 + in.stride, *t_2 = t_1 + in.stride,
                 *t_3 = t_2 + in.stride;
    const double a_0 = in.shape[k], a_1 = in.shape[k + 1], a_2 = in.shape[k + 2], a_3 = in.shape[k + 3];
    const double v_0 = in.rate[k], v_1 = in.rate[k + 1], v_2 = in.rate[k + 2], v_3 = in.rate[k + 3];
#pragma omp simd
    for (std::size_t j = 0; j < n; ++j) {
      delta[j] -= (a_0 * t_0[j] + a_1 * t_1[j]) + (a_2 * t_2[j] + a_3 * t_3[j]);
      rate[j] -= (v_0 * t_0[j] + v_1 * t_1[j]) + (v_2 * t_2[j] + v_3 * t_3[j]);
    }
  }
  for (; k < in.n_shapes; k += 2) {
    const double *t_0 = in.shapes + k * in.stride, *t_1 = t_0 + in.stride;
    const double a_0 = in.shape[k], a_1 = in.shape[k + 1], v_0 = in.rate[k], v_1 = in.rate[k + 1];
#pragma omp simd
    for (std::size_t j = 0; j < n; ++j) {
      delta[j] -= a_0 * t_0[j] + a_1 * t_1[j];
      rate[j] -= v_0 * t_0[j] + v_1 * t_1[j];
    }
  }
  if (!in.waves) return;
  const double* waves = in.waves;
#pragma omp simd
  for (std::size_t j = 0; j < n; ++j) delta[j] += waves[j];
}

ROTORDROP_KERNEL double deepest_overlap_kernel(const ArcValues& overlap, std::size_t n) {
  const double* delta = overlap.at.data();
  double deepest = delta[0];
  const std::size_t whole = whole_vectors(n);
#pragma omp simd reduction(max : deepest)
  for (std::size_t j = 0; j < whole; ++j) deepest = delta[j] > deepest ? delta[j] : deepest;
  return deepest;
}

ROTORDROP_KERNEL ArcSums arc_forces_kernel(const ArcForce& law, const ArcPlace& place, const ArcValues& overlap,
                                           const ArcValues& overlap_rate, std::size_t first, std::size_t last,
                                           ArcValues& normal_forces, ArcValues& elastic_forces) {
  const double exponent = law.exponent, f_0 = law.f_0, f_1 = law.f_1, f_2 = law.f_2, f_3 = law.f_3,
               damping = law.damping;
  const double *cosine = place.cosine + first, *sine = place.sine + first, *delta = overlap.at.data() + first,
               *rate = overlap_rate.at.data() + first;
  double *N_of = normal_forces.at.data() + first, *E_of = elastic_forces.at.data() + first;
  const std::size_t n = whole_vectors(last - first);
  double y = 0., z = 0., normal = 0., elastic = 0., dissipated = 0.;
#pragma omp simd reduction(+ : y, z, normal, elastic, dissipated)
  for (std::size_t j = 0; j < n; ++j) {
    // Written so that an overlap that is not a number goes on.
    const double d = !(delta[j] <= 0.) ? delta[j] : 0.;
    const double polynomial = f_0 + d * (f_1 + d * (f_2 + d * f_3));
    const double E = vector_power(d + 1e-300, exponent) * polynomial * (d == 0. ? 0. : 1.);
    const double N = std::max(E * (1. + damping * rate[j]), 0.);
    y += N * cosine[j];
    z += N * sine[j];
    normal += N;
    elastic += E;
    dissipated += (N - E) * rate[j];
    N_of[j] = N;
    E_of[j] = E;
  }
  return {y, z, normal, elastic, dissipated};
}

ROTORDROP_KERNEL double arc_energies_kernel(double exponent, const std::array<double, 4>& w, const ArcValues& overlap,
                                            std::size_t n) {
  const double* delta = overlap.at.data();
  const double w_0 = w[0], w_1 = w[1], w_2 = w[2], w_3 = w[3];
  double sum = 0.;
#pragma omp simd reduction(+ : sum)
  for (std::size_t j = 0; j < whole_vectors(n); ++j) {
    const double d = !(delta[j] <= 0.) ? delta[j] : 0.;
    sum += vector_power(d + 1e-300, exponent) * (w_0 + d * (w_1 + d * (w_2 + d * w_3))) * (d == 0. ? 0. : 1.);
  }
  return sum;
}

}  // namespace

void arc_overlaps(const ArcPlace& place, ArcValues& overlap, ArcValues& rate) {
  wide<arc_overlaps_kernel>(place, overlap, rate);
}
double deepest_overlap(const ArcValues& overlap, std::size_t n) { return wide<deepest_overlap_kernel>(overlap, n); }
ArcSums arc_forces(const ArcForce& law, const ArcPlace& place, const ArcValues& overlap, const ArcValues& rate,
                   std::size_t first, std::size_t last, ArcValues& normal, ArcValues& elastic) {
  return wide<arc_forces_kernel>(law, place, overlap, rate, first, last, normal, elastic);
}
double arc_energies(double exponent, const std::array<double, 4>& w, const ArcValues& overlap, std::size_t n) {
  return wide<arc_energies_kernel>(exponent, w, overlap, n);
}

}  // namespace rotordrop
