#pragma once
// Complex numbers in vectors, for kernels that are compiled for several widths (base/wide_vectors.h).
#include <bit>
#include <cstdint>

#include "base/exponential_series.h"
#include "base/sine_cosine.h"
#include "base/split_exponential.h"
#include "base/wide_vectors.h"

namespace rotordrop {

/// Complex numbers, one for each element of a vector.
struct ComplexOctet {
  Octet re, im;
};

ROTORDROP_KERNEL Octet octet_at(const double* list) {
  Octet a;
#pragma omp simd
  for (std::size_t i = 0; i < vector_length; ++i) a[i] = list[i];
  return a;
}
ROTORDROP_KERNEL void store(const Octet& a, double* list) {
#pragma omp simd
  for (std::size_t i = 0; i < vector_length; ++i) list[i] = a.value[i];
}
ROTORDROP_KERNEL ComplexOctet product(const ComplexOctet& a, const ComplexOctet& b) {
  ComplexOctet r;
#pragma omp simd
  for (std::size_t i = 0; i < vector_length; ++i) {
    r.re[i] = a.re.value[i] * b.re.value[i] - a.im.value[i] * b.im.value[i];
    r.im[i] = a.re.value[i] * b.im.value[i] + a.im.value[i] * b.re.value[i];
  }
  return r;
}
/// f a + g
ROTORDROP_KERNEL ComplexOctet scaled(double f, const ComplexOctet& a, double g = 0.) {
  ComplexOctet r;
#pragma omp simd
  for (std::size_t i = 0; i < vector_length; ++i) {
    r.re[i] = f * a.re.value[i] + g;
    r.im[i] = f * a.im.value[i];
  }
  return r;
}
/// to += f a
ROTORDROP_KERNEL void add(ComplexOctet& to, double f, const ComplexOctet& a) {
#pragma omp simd
  for (std::size_t i = 0; i < vector_length; ++i) {
    to.re[i] += f * a.re.value[i];
    to.im[i] += f * a.im.value[i];
  }
}
ROTORDROP_KERNEL ComplexOctet inverse(const ComplexOctet& a) {
  ComplexOctet r;
#pragma omp simd
  for (std::size_t i = 0; i < vector_length; ++i) {
    const double square = a.re.value[i] * a.re.value[i] + a.im.value[i] * a.im.value[i];
    r.re[i] = a.re.value[i] / square;
    r.im[i] = -a.im.value[i] / square;
  }
  return r;
}
/// exp(f z), whose real part is at most zero, and whose imaginary one up to a million radians.
ROTORDROP_KERNEL ComplexOctet exponential(double f, const ComplexOctet& z) {
  constexpr double round = 6755399441055744.;  // adding 1.5 * 2^52 rounds to an integer
  ComplexOctet r;
#pragma omp simd
  for (std::size_t i = 0; i < vector_length; ++i) {
    const double decay = f * z.re.value[i];
    const SplitExponential e = split_exponential(decay > -700. ? decay : -700.);
    const double size = e.power * (1. + (e.rest + e.rest * e.rest * exponential_tail(e.rest)));
    const double angle = f * z.im.value[i], shifted = angle * quarter_turns::per_radian + round;
    const double rest = quarter_turns::rest(angle, shifted - round);
    const double s = quarter_turns::sine(rest), c = quarter_turns::cosine(rest);
    const auto k = std::bit_cast<std::uint64_t>(shifted);
    const double sine = (k & 1U) != 0 ? c : s, cosine = (k & 1U) != 0 ? s : c;
    r.im[i] = (k & 2U) != 0 ? -size * sine : size * sine;
    r.re[i] = ((k + 1U) & 2U) != 0 ? -size * cosine : size * cosine;
  }
  return r;
}

}  // namespace rotordrop
