#include "thermal/section/modal_sums.h"

#include <algorithm>
#include <limits>

#include "base/wide_vectors.h"

namespace rotordrop {
namespace {

ROTORDROP_KERNEL TwoSums two_sums_kernel(const double* y, double zero, const double* a, const double* b,
                                         std::size_t n) {
  double sum_a = 0., sum_b = 0.;
#pragma omp simd reduction(+ : sum_a, sum_b)
  for (std::size_t i = 0; i < n; ++i) {
    const double z = y[i] - zero;
    sum_a += a[i] * z;
    sum_b += b[i] * z;
  }
  return {sum_a, sum_b};
}

ROTORDROP_KERNEL FiveSums five_sums_kernel(const double* y, double zero, const double* a, const double* b,
                                           const double* c, const double* d, const double* e, std::size_t n) {
  double sum_a = 0., sum_b = 0., sum_c = 0., sum_d = 0., sum_e = 0.;
#pragma omp simd reduction(+ : sum_a, sum_b, sum_c, sum_d, sum_e)
  for (std::size_t i = 0; i < n; ++i) {
    const double z = y[i] - zero;
    sum_a += a[i] * z;
    sum_b += b[i] * z;
    sum_c += c[i] * z;
    sum_d += d[i] * z;
    sum_e += e[i] * z;
  }
  return {sum_a, sum_b, sum_c, sum_d, sum_e};
}

ROTORDROP_KERNEL ThreeSums three_sums_kernel(const double* y, double zero, const double* a, const double* b,
                                             const double* c, std::size_t n) {
  double sum_a = 0., sum_b = 0., sum_c = 0.;
#pragma omp simd reduction(+ : sum_a, sum_b, sum_c)
  for (std::size_t i = 0; i < n; ++i) {
    const double z = y[i] - zero;
    sum_a += a[i] * z;
    sum_b += b[i] * z;
    sum_c += c[i] * z;
  }
  return {sum_a, sum_b, sum_c};
}

ROTORDROP_KERNEL void add_times_kernel(double factor, const double* row, double* to, std::size_t n) {
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) to[i] += factor * row[i];
}

ROTORDROP_KERNEL void modal_rates_kernel(const double* y, double zero, const double* rate, const ModalHeats& h,
                                         double* dydt, std::size_t n) {
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i)
    dydt[i] = -rate[i] * (y[i] - zero) + h.q_bore * h.bore[i] + h.q_shaft * h.shaft[i] + h.q_inner * h.inner[i] +
              h.q_outer * h.outer[i] + h.q_film * h.film[i];
}

ROTORDROP_KERNEL RiseRange extremes_kernel(const double* y, double zero, std::size_t n, const double* by_mode,
                                           const double* at_once, double watts, double* rises, std::size_t n_points) {
#pragma omp simd
  for (std::size_t k = 0; k < n_points; ++k) rises[k] = at_once[k] * watts;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = y[i] - zero;
    const double* shape = by_mode + i * n_points;
#pragma omp simd
    for (std::size_t k = 0; k < n_points; ++k) rises[k] += shape[k] * z;
  }
  double lowest = rises[0], highest = rises[0];
#pragma omp simd reduction(min : lowest) reduction(max : highest)
  for (std::size_t k = 0; k < n_points; ++k) {
    lowest = rises[k] < lowest ? rises[k] : lowest;
    highest = rises[k] > highest ? rises[k] : highest;
  }
  return {lowest, highest};
}

}  // namespace

TwoSums two_sums(const double* y, double zero, const double* a, const double* b, std::size_t n) {
  return wide<two_sums_kernel>(y, zero, a, b, n);
}
ThreeSums three_sums(const double* y, double zero, const double* a, const double* b, const double* c, std::size_t n) {
  return wide<three_sums_kernel>(y, zero, a, b, c, n);
}
FiveSums five_sums(const double* y, double zero, const double* a, const double* b, const double* c, const double* d,
                   const double* e, std::size_t n) {
  return wide<five_sums_kernel>(y, zero, a, b, c, d, e, n);
}
void add_times(double factor, const double* row, double* to, std::size_t n) {
  wide<add_times_kernel>(factor, row, to, n);
}
void modal_rates(const double* y, double zero, const double* rate, const ModalHeats& h, double* dydt, std::size_t n) {
  wide<modal_rates_kernel>(y, zero, rate, h, dydt, n);
}
RiseRange extremes(const double* y, double zero, std::size_t n, const double* by_mode, const double* at_once,
                   double watts, double* rises, std::size_t n_points) {
  return wide<extremes_kernel>(y, zero, n, by_mode, at_once, watts, rises, n_points);
}

}  // namespace rotordrop
