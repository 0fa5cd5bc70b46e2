// Roots by Newton's method from AVX-512's estimate, against those of long double.
#if defined(__x86_64__) && !defined(__clang__)
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl,fma")
#include "base/newton_root.h"

namespace rotordrop {
namespace {

void roots_of_eight(const double* x, double* root, double* inverse) {
  __m512d r, i;
  root_by_newton(_mm512_loadu_pd(x), r, i);
  _mm512_storeu_pd(root, r);
  _mm512_storeu_pd(inverse, i);
}

}  // namespace
}  // namespace rotordrop
#pragma GCC pop_options

namespace rotordrop {
namespace {

TEST(RootByNewton, IsWithinAboutAUnitInTheLastPlace) {
  if (!__builtin_cpu_supports("x86-64-v4")) GTEST_SKIP() << "this machine has no AVX-512";
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> digits(1., 4.), exponent(-300., 300.);
  // A half of the last place by the last sum, a quarter by the first product, which the series sees, and 0.27 by what the series leaves.
  constexpr double bound = 1.1 * std::numeric_limits<double>::epsilon();
  for (int i = 0; i < 100000; ++i) {
    double x[8], root[8], inverse[8];
    for (double& value : x) value = std::ldexp(digits(random), 2 * static_cast<int>(exponent(random)));
    roots_of_eight(x, root, inverse);
    for (int lane = 0; lane < 8; ++lane) {
      const long double right = std::sqrt(static_cast<long double>(x[lane]));
      ASSERT_LE(std::fabs(static_cast<double>(root[lane] / right - 1.L)), bound) << x[lane];
      ASSERT_LE(std::fabs(static_cast<double>(inverse[lane] * right - 1.L)), bound) << x[lane];
    }
  }
}

TEST(RootByNewton, LetsWhatIsNoNumberGoOnInItsLaneAlone) {
  if (!__builtin_cpu_supports("x86-64-v4")) GTEST_SKIP() << "this machine has no AVX-512";
  const double x[8] = {4., std::nan(""), 4., 4., 1e-200, 4., -1., 4.};
  double root[8], inverse[8];
  roots_of_eight(x, root, inverse);
  for (const int lane : {0, 2, 3, 5, 7}) {
    EXPECT_EQ(root[lane], 2.);
    EXPECT_EQ(inverse[lane], 0.5);
  }
  for (const int lane : {1, 6}) EXPECT_TRUE(std::isnan(root[lane]) && std::isnan(inverse[lane]));
  EXPECT_NEAR(inverse[4], 1e100, 1e85);  // what stands in for a load of zero, squared
}

}  // namespace
}  // namespace rotordrop
#endif
