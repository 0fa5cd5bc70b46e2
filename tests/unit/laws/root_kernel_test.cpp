// A sum of exponentials against the root that it stands for, at times from a fifth of the shortest interval to the duration.
#include "laws/root_kernel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using rotordrop::RootKernel;

double largest_error(double duration, double shortest_interval) {
  const RootKernel kernel(duration, shortest_interval);
  constexpr int n = 2000;
  const double first = 0.2 * shortest_interval;
  double largest = 0.;
  for (int i = 0; i <= n; ++i) {
    const double s = first * std::pow(duration / first, static_cast<double>(i) / n);
    double sum = 0.;
    for (std::size_t k = 0; k < kernel.rate.size(); ++k) sum += kernel.weight[k] * std::exp(-kernel.rate[k] * s);
    largest = std::fmax(largest, std::fabs(sum * std::sqrt(s) - 1.));
  }
  return largest;
}

// 2 sqrt(2) exp(-pi^2/1.1) = 3.6e-4 by the trapezoid rule; both ends may add a tenth of it.
TEST(RootKernel, IsMetFromAFifthOfTheShortestIntervalToTheDuration) {
  for (const double duration : {1e-3, 0.3, 10., 1000.})
    for (const double shortest : {2e-5, 5e-5, 0.5e-3}) EXPECT_LT(largest_error(duration, shortest), 4e-4) << duration;
}

// Each term costs every cell of a track: a term for a factor of e^1.1 = 3 in time, and a few at the ends.
TEST(RootKernel, HasFewTerms) {
  EXPECT_LE(RootKernel(0.3, 5e-5).rate.size(), 16U);
  EXPECT_LE(RootKernel(10., 5e-5).rate.size(), 19U);
}

}  // namespace
