// Powers from tables against the library's in long double, which has 64 bits: their error is below 1e-18.
#include "base/power_table.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "base/drops.h"
#include "base/exponent.h"

namespace rotordrop {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
/// What the tables promise; four roundings, of both entries, of their product and of the sum, make 4.5e-16.
constexpr double promised = 1e-15;

double error(double found, long double right) {
  return static_cast<double>(std::fabs((static_cast<long double>(found) - right) / right));
}

/// From far below to far beyond what the tables have.
std::vector<double> magnitudes() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> magnitude(-35., 15.);
  std::vector<double> list(200000);
  for (double& x : list) x = std::pow(10., magnitude(random));
  return list;
}

TEST(PowerTable, IsRightToFourUnitsOfTheLastDigitForAnyExponentToThree) {
  for (const double n : {0., 0.33, 0.5, 0.55, 1., 10. / 9., 1.5, 2.5, 3.}) {
    const PowerTable table(n);
    double worst = 0.;
    for (const double x : magnitudes())
      worst = std::max(worst, error(table.power(x), std::pow(static_cast<long double>(x), n)));
    EXPECT_LT(worst, promised) << n;
  }
}

TEST(PowerTable, IsRightOnBothSidesOfEveryBorderOfItsPieces) {
  const PowerTable table(10. / 9.);
  for (int exponent = -97; exponent <= 32; ++exponent)
    for (int piece = 0; piece <= 128; ++piece) {
      const double border = std::ldexp(1. + piece / 128., exponent);
      for (const double x : {std::nextafter(border, 0.), border, std::nextafter(border, infinity)})
        ASSERT_LT(error(table.power(x), std::pow(static_cast<long double>(x), static_cast<long double>(10. / 9.))),
                  promised)
            << x;
    }
}

TEST(PowerTable, LeavesWhatItDoesNotHaveToTheLibrary) {
  const PowerTable table(10. / 9.), steep(3.5), falling(-0.5);
  EXPECT_EQ(table.power(0.), 0.);
  EXPECT_EQ(table.power(infinity), infinity);
  EXPECT_TRUE(std::isnan(table.power(nan)));
  EXPECT_TRUE(std::isnan(table.power(-2.)));
  EXPECT_EQ(PowerTable(0.).power(0.), 1.);
  for (const double x : {1e-300, 1e-31, 1e-3, 2., 1e12, 1e80}) {
    EXPECT_EQ(steep.power(x), std::pow(x, 3.5)) << x;
    EXPECT_EQ(falling.power(x), std::pow(x, -0.5)) << x;
  }
}

TEST(CubeRoot, IsRightToFourUnitsOfTheLastDigitOnBothSidesOfZero) {
  double worst = 0.;
  for (const double x : magnitudes())
    for (const double signed_x : {x, -x})
      worst = std::max(worst, error(cbrt(signed_x), std::cbrt(static_cast<long double>(signed_x))));
  EXPECT_LT(worst, promised);
  EXPECT_EQ(cbrt(0.), 0.);
  EXPECT_EQ(cbrt(-infinity), -infinity);
  EXPECT_TRUE(std::isnan(cbrt(nan)));
}

TEST(Exponent, GivesThePowersOfOneDropAndOfEight) {
  using Real = EightDrops;
  const double x[] = {1e-9, 3e-6, 0.2, 0.7, 1., 1.3, 40., 5e3};
  for (const double y : {0.33, 0.5, 10. / 9.}) {
    const Real all = pow(Real::load(x), ExponentOf<Real>(Real(y)));
    for (int lane = 0; lane < n_lanes; ++lane) {
      EXPECT_LT(error(all[lane], std::pow(static_cast<long double>(x[lane]), y)), promised) << y;
      EXPECT_LT(error(pow(x[lane], ExponentOf<double>(y)), std::pow(static_cast<long double>(x[lane]), y)), promised)
          << y;
    }
  }
}

}  // namespace
}  // namespace rotordrop
