#include "integrate/vector_operations.h"

#include <algorithm>
#include <cmath>

#include "base/wide_vectors.h"

namespace rotordrop {
namespace {

// Straight to the members: calls into the library cost as much as the loops here.
double* data(N_Vector v) { return NV_DATA_S(v); }
long size(N_Vector v) { return static_cast<long>(NV_LENGTH_S(v)); }

// In all of these the result may be one of the operands, at the same place: "omp simd" needs no more.

ROTORDROP_KERNEL void sum_of_two(long n, double a, const double* x, double b, const double* y, double* z) {
#pragma omp simd
  for (long i = 0; i < n; ++i) z[i] = a * x[i] + b * y[i];
}

ROTORDROP_KERNEL void sum_of_three(long n, const double* c, const double* x0, const double* x1, const double* x2,
                                   double* z) {
#pragma omp simd
  for (long i = 0; i < n; ++i) z[i] = c[0] * x0[i] + c[1] * x1[i] + c[2] * x2[i];
}

ROTORDROP_KERNEL void scaled(long n, double c, const double* x, double* z) {
#pragma omp simd
  for (long i = 0; i < n; ++i) z[i] = c * x[i];
}

ROTORDROP_KERNEL double weighted_square_sum(long n, const double* x, const double* w) {
  double sum = 0.;
#pragma omp simd reduction(+ : sum)
  for (long i = 0; i < n; ++i) sum += (x[i] * w[i]) * (x[i] * w[i]);
  return sum;
}

void linear_sum(realtype a, N_Vector x, realtype b, N_Vector y, N_Vector z) {
  wide<sum_of_two>(size(x), a, data(x), b, data(y), data(z));
}

void scale(realtype c, N_Vector x, N_Vector z) {
  if (c == 1.) {
    if (x != z) std::copy_n(data(x), size(x), data(z));
    return;
  }
  wide<scaled>(size(x), c, data(x), data(z));
}

void constant(realtype c, N_Vector z) { std::fill_n(data(z), size(z), c); }

// c[0] x[0] + ... + c[n-1] x[n-1] in passes of two operands more each. SUNDIALS lets only x[0] be z.
int linear_combination(int n_vectors, realtype* c, N_Vector* x, N_Vector z) {
  const long n = size(z);
  if (n_vectors == 1) {
    scale(c[0], x[0], z);
    return 0;
  }
  int next = 2;
  if (n_vectors == 2)
    wide<sum_of_two>(n, c[0], data(x[0]), c[1], data(x[1]), data(z));
  else {
    wide<sum_of_three>(n, c, data(x[0]), data(x[1]), data(x[2]), data(z));
    next = 3;
  }
  while (next < n_vectors) {
    if (n_vectors - next >= 2) {
      const double more[3] = {1., c[next], c[next + 1]};
      wide<sum_of_three>(n, more, data(z), data(x[next]), data(x[next + 1]), data(z));
      next += 2;
    } else {
      wide<sum_of_two>(n, 1., data(z), c[next], data(x[next]), data(z));
      ++next;
    }
  }
  return 0;
}

void absolute(N_Vector x, N_Vector z) {
  std::transform(data(x), data(x) + size(x), data(z), [](double value) { return std::fabs(value); });
}

void inverse(N_Vector x, N_Vector z) {
  std::transform(data(x), data(x) + size(x), data(z), [](double value) { return 1. / value; });
}

void add_constant(N_Vector x, realtype c, N_Vector z) {
  std::transform(data(x), data(x) + size(x), data(z), [c](double value) { return value + c; });
}

realtype smallest(N_Vector x) { return *std::min_element(data(x), data(x) + size(x)); }

realtype weighted_norm(N_Vector x, N_Vector w) {
  return std::sqrt(wide<weighted_square_sum>(size(x), data(x), data(w)) / static_cast<double>(size(x)));
}

}  // namespace

void use_vectorised_operations(N_Vector vector) {
  vector->ops->nvlinearsum = linear_sum;
  vector->ops->nvscale = scale;
  vector->ops->nvconst = constant;
  vector->ops->nvlinearcombination = linear_combination;
  vector->ops->nvwrmsnorm = weighted_norm;
  vector->ops->nvabs = absolute;
  vector->ops->nvinv = inverse;
  vector->ops->nvaddconst = add_constant;
  vector->ops->nvmin = smallest;
}

}  // namespace rotordrop
