#include "laws/fatigue/rating_estimates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rotordrop {
namespace {

// Bearings as SKF's catalogue has them (rolling bearings, 2018); balls of the 6205 and 6310 as literature on their fault frequencies gives them.
TEST(RatingEstimates, AreNearThoseOfCatalogues) {
  const auto small = estimated_ratings(1, 9, 7.938e-3, 0.);  // 6205: C = 14.8 kN, C0 = 7.8 kN
  EXPECT_NEAR(small.dynamic_load / 14.8e3, 1., 0.3);
  EXPECT_NEAR(small.static_load / 7.8e3, 1., 0.3);
  const auto medium = estimated_ratings(1, 8, 19.05e-3, 0.);  // 6310: C = 65 kN, C0 = 38 kN
  EXPECT_NEAR(medium.dynamic_load / 65e3, 1., 0.3);
  EXPECT_NEAR(medium.static_load / 38e3, 1., 0.3);
}

TEST(RatingEstimates, GrowWithRowsAndShrinkWithTheAngleAsTheStandardsSay) {
  const auto one = estimated_ratings(1, 20, 10e-3, 0.), pair = estimated_ratings(2, 20, 10e-3, 0.),
             steep = estimated_ratings(1, 20, 10e-3, std::numbers::pi / 3.);
  EXPECT_NEAR(pair.static_load, 2. * one.static_load, 1e-9 * one.static_load);
  EXPECT_NEAR(pair.dynamic_load, std::pow(2., 0.7) * one.dynamic_load, 1e-9 * one.dynamic_load);
  EXPECT_NEAR(steep.static_load, 0.5 * one.static_load, 1e-9 * one.static_load);
  EXPECT_NEAR(one.static_load, 15. * 20. * 100., 1e-6);  // f0 Z D^2
  EXPECT_NEAR(one.dynamic_load, 1.3 * 55. * std::pow(20., 2. / 3.) * std::pow(10., 1.8), 1e-6);
  // Both forms of the size meet at an inch: 25.4^0.4 = 3.647.
  const auto below = estimated_ratings(1, 8, 25.39e-3, 0.), above = estimated_ratings(1, 8, 25.41e-3, 0.);
  EXPECT_NEAR(above.dynamic_load / below.dynamic_load, 1., 2e-3);
}

}  // namespace
}  // namespace rotordrop
