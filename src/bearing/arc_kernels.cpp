#include "bearing/arc_kernels.h"

#include <algorithm>

#include "base/wide_vectors.h"
#include "laws/vector_power.h"

namespace rotordrop {
namespace {

/// At some vectors of points, from the first of them on.
template <std::size_t vectors>
ROTORDROP_KERNEL void overlaps_at(const ArcPlace& in, std::size_t first, double* delta, double* rate) {
  std::array<Octet, vectors> bend{}, bend_rate{};
  const double* shapes = in.shapes + first;
  for (std::size_t k = 0; k < in.n_shapes; ++k, shapes += in.stride)
    for (std::size_t v = 0; v < vectors; ++v) {
      add_product(bend[v], in.shape[k], shapes + v * vector_length);
      add_product(bend_rate[v], in.rate[k], shapes + v * vector_length);
    }
  const double ey = in.ey, ez = in.ez, vy = in.vy, vz = in.vz, gap = in.gap;
  for (std::size_t v = 0; v < vectors; ++v) {
    const std::size_t at = first + v * vector_length;
    const double *cosine = in.cosine + at, *sine = in.sine + at;
#pragma omp simd
    for (std::size_t i = 0; i < vector_length; ++i) {
      delta[at + i] = ey * cosine[i] + ez * sine[i] - gap - bend[v][i];
      rate[at + i] = vy * cosine[i] + vz * sine[i] - bend_rate[v][i];
    }
  }
}

ROTORDROP_KERNEL double largest_of_vector(const double* values) {
  double largest = values[0];
#pragma omp simd reduction(max : largest)
  for (std::size_t i = 0; i < vector_length; ++i) largest = values[i] > largest ? values[i] : largest;
  return largest;
}

/// Overlaps and rates in one pass, since the tables are more than the nearest cache holds; two vectors at a time share the coefficients.
ROTORDROP_KERNEL ArcOverlap arc_overlaps_kernel(const ArcPlace& given, ArcValues& overlap, ArcValues& overlap_rate) {
  const ArcPlace in = given;  // a copy that no store can change
  double *delta = overlap.at.data(), *rate = overlap_rate.at.data();
  const std::size_t n = whole_vectors(in.n);
  std::size_t j = 0;
  for (; j + 2 * vector_length <= n; j += 2 * vector_length) overlaps_at<2>(in, j, delta, rate);
  if (j < n) overlaps_at<1>(in, j, delta, rate);
  if (in.waves)
#pragma omp simd
    for (std::size_t k = 0; k < n; ++k) delta[k] += in.waves[k];
  ArcOverlap found{delta[0], n, 0};
  for (j = 0; j < n; j += vector_length) {
    const double largest = largest_of_vector(delta + j);
    found.deepest = std::max(found.deepest, largest);
    if (largest <= 0.) continue;
    found.first = std::min(found.first, j);
    found.last = j + vector_length;
  }
  return found;
}

ROTORDROP_KERNEL ArcSums arc_forces_kernel(const ArcForce& law, const ArcPlace& place, const ArcValues& overlap,
                                           const ArcValues& overlap_rate, const ArcOverlap& where,
                                           ArcValues& normal_forces, ArcValues& elastic_forces) {
  const double exponent = law.exponent, f_0 = law.f_0, f_1 = law.f_1, f_2 = law.f_2, f_3 = law.f_3,
               damping = law.damping;
  const std::size_t first = where.first, n = whole_vectors(where.last - first);
  const double *cosine = place.cosine + first, *sine = place.sine + first, *delta = overlap.at.data() + first,
               *rate = overlap_rate.at.data() + first;
  double *N_of = normal_forces.at.data() + first, *E_of = elastic_forces.at.data() + first;
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

ArcOverlap arc_overlaps(const ArcPlace& place, ArcValues& overlap, ArcValues& rate) {
  return wide<arc_overlaps_kernel>(place, overlap, rate);
}
ArcSums arc_forces(const ArcForce& law, const ArcPlace& place, const ArcValues& overlap, const ArcValues& rate,
                   const ArcOverlap& where, ArcValues& normal, ArcValues& elastic) {
  return wide<arc_forces_kernel>(law, place, overlap, rate, where, normal, elastic);
}
double arc_energies(double exponent, const std::array<double, 4>& w, const ArcValues& overlap, std::size_t n) {
  return wide<arc_energies_kernel>(exponent, w, overlap, n);
}

}  // namespace rotordrop
