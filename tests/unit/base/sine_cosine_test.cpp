// Sine and cosine against the library's in long double, which has 64 bits: their error is below 1e-18.
#include "base/sine_cosine.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

namespace rotordrop {
namespace {

double error(double angle) {
  const auto [sine, cosine] = sine_cosine(angle);
  const long double x = angle;
  return static_cast<double>(std::max(std::fabs(sine - std::sin(x)), std::fabs(cosine - std::cos(x))));
}

TEST(SineCosine, IsRightToTheLastDigitInEveryQuarterOfManyTurns) {
  std::mt19937_64 random(1);
  for (const double range : {1., 1e3, 0.99e6}) {
    std::uniform_real_distribution<double> angle(-range, range);
    for (int i = 0; i < 200000; ++i) {
      const double x = angle(random);
      ASSERT_LT(error(x), 2.3e-16) << x;
    }
  }
}

TEST(SineCosine, IsRightAtQuarterTurnsAndJustBesideThem) {
  for (int quarter = -4000; quarter <= 4000; ++quarter)
    for (const double beside : {-1e-9, 0., 1e-9}) {
      const double x = 0.5 * std::numbers::pi * quarter + beside;
      ASSERT_LT(error(x), 2.3e-16) << x;
    }
}

TEST(SineCosine, GoesOnBeyondAMillionRadiansAndPassesOnWhatIsNoNumber) {
  for (const double x : {1e6, -3.7e9, 1e300}) EXPECT_LT(error(x), 2.3e-16) << x;
  EXPECT_TRUE(std::isnan(sine_cosine(std::numeric_limits<double>::quiet_NaN()).sine));
  EXPECT_TRUE(std::isnan(sine_cosine(std::numeric_limits<double>::infinity()).cosine));
}

}  // namespace
}  // namespace rotordrop
