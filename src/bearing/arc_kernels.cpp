#include "bearing/arc_kernels.h"

#include <algorithm>

#include "base/wide_vectors.h"
#include "laws/vector_power.h"

namespace rotordrop {
namespace {

/// A radial motion less what the bore bends, at some vectors of points, from the first of them on: e_y cos + e_z sin - less - sum_k coefficient_k shape_k.
template <std::size_t vectors>
ROTORDROP_KERNEL void beyond_bore_at(const ArcPlace& in, double e_y, double e_z, double less,
                                     const double* coefficients, std::size_t first, double* out) {
  std::array<Octet, vectors> bend{};
  const double* shapes = in.shapes + first;
  for (std::size_t k = 0; k < in.n_shapes; ++k, shapes += in.stride)
    for (std::size_t v = 0; v < vectors; ++v) add_product(bend[v], coefficients[k], shapes + v * vector_length);
  for (std::size_t v = 0; v < vectors; ++v) {
    const std::size_t at = first + v * vector_length;
    const double *cosine = in.cosine + at, *sine = in.sine + at;
#pragma omp simd
    for (std::size_t i = 0; i < vector_length; ++i) out[at + i] = e_y * cosine[i] + e_z * sine[i] - less - bend[v][i];
  }
}
/// At whole vectors of points from `first` to `last` - 1. Four at a time share the coefficients and do not wait for each other.
ROTORDROP_KERNEL void beyond_bore(const ArcPlace& in, double e_y, double e_z, double less, const double* coefficients,
                                  std::size_t first, std::size_t last, double* out) {
  constexpr std::size_t four = 4 * vector_length;
  for (; first + four <= last; first += four) beyond_bore_at<4>(in, e_y, e_z, less, coefficients, first, out);
  for (; first < last; first += vector_length) beyond_bore_at<1>(in, e_y, e_z, less, coefficients, first, out);
}

ROTORDROP_KERNEL double largest_of_vector(const double* values) {
  double largest = values[0];
#pragma omp simd reduction(max : largest)
  for (std::size_t i = 0; i < vector_length; ++i) largest = values[i] > largest ? values[i] : largest;
  return largest;
}

/// Rates where surfaces overlap, which is a small part of where they might.
ROTORDROP_KERNEL ArcOverlap arc_overlaps_kernel(const ArcPlace& given, ArcValues& overlap, ArcValues& overlap_rate) {
  const ArcPlace in = given;  // a copy that no store can change
  double* delta = overlap.at.data();
  const std::size_t n = whole_vectors(in.n);
  beyond_bore(in, in.ey, in.ez, in.gap, in.shape, 0, n, delta);
  if (in.waves)
#pragma omp simd
    for (std::size_t k = 0; k < n; ++k) delta[k] += in.waves[k];
  ArcOverlap found{delta[0], n, 0};
  for (std::size_t j = 0; j < n; j += vector_length) {
    const double largest = largest_of_vector(delta + j);
    found.deepest = std::max(found.deepest, largest);
    if (largest <= 0.) continue;
    found.first = std::min(found.first, j);
    found.last = j + vector_length;
  }
  beyond_bore(in, in.vy, in.vz, 0., in.rate, found.first, found.last, overlap_rate.at.data());
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
