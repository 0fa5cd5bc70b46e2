// What is followed from step to step.
#include "analysis/drop_scalars.h"

#include <gtest/gtest.h>

namespace rotordrop {
namespace {

TEST(FollowedDemand, CountsTheTimeAboveOneByStraightLines) {
  // 0 - 2 - 0 - 0 - 3 - 3 - 0.5 at whole seconds, the ring's speed 0 10 30 30 24 20 0.
  const double demand[] = {0, 2, 0, 0, 3, 3, 0.5}, speed[] = {0, 10, 30, 30, 24, 20, 0};
  FollowedDemand d;
  for (int k = 0; k < 7; ++k) d.follow(k, demand[k], speed[k]);
  EXPECT_NEAR(d.time_beyond, 0.5 + 0.5 + 2. / 3. + 1. + 0.8, 1e-14) << "s";
  EXPECT_NEAR(d.longest_beyond, 2. / 3. + 1. + 0.8, 1e-14) << "s";
  EXPECT_EQ(d.speed_change, 10. + 20. + 0. + 6. + 4. + 20.) << "rad/s";
  EXPECT_NEAR(d.speed_change_beyond, 5. + 10. + 4. + 4. + 16., 1e-13) << "rad/s, up and down";
  EXPECT_EQ(d.largest, 3.);
  EXPECT_EQ(d.largest_time, 4.);
}

TEST(FollowedDemand, HasNoTimeOfALargestDemandWhereNothingIsAsked) {
  FollowedDemand d;
  for (int k = 0; k < 3; ++k) d.follow(k, 0., 100. * k);
  EXPECT_EQ(d.largest, 0.);
  EXPECT_TRUE(std::isnan(d.largest_time));
  EXPECT_EQ(d.time_beyond, 0.);
}

}  // namespace
}  // namespace rotordrop
