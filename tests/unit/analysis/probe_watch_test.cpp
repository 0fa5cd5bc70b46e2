// A clearance c(t) = c_0 + k (t - t_0)^2 sampled at steps that miss t_0: the parabola through three samples is the function itself.
#include "analysis/watch/probe_watch.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rotordrop {
namespace {

TEST(ProbeScalars, FindTheSmallestClearanceBetweenSteps) {
  ProbeScalars s;
  const auto clearance = [](double t) { return 12e-6 + 3. * (t - 0.0123) * (t - 0.0123); };
  for (const double t : {0., 0.004, 0.009, 0.0117, 0.0131, 0.015, 0.02}) s.follow(t, clearance(t), 0.);
  EXPECT_NEAR(s.smallest_clearance(), 12e-6, 1e-16) << "m";
  EXPECT_NEAR(s.overlap.time, 0.0123, 1e-12) << "s";
  EXPECT_TRUE(std::isnan(s.first_touch_time));
  EXPECT_EQ(s.time_touching, 0.);
}

TEST(ProbeScalars, FindALowerBottomWhoseSamplesLieAboveAnEarlierOne) {
  ProbeScalars s;
  const double left[] = {20e-6, 10e-6, 10.1e-6, 20e-6, 15e-6, 8.9e-6, 9e-6, 20e-6};
  for (int k = 0; k < 8; ++k) s.follow(k, left[k], 0.);
  EXPECT_NEAR(s.smallest_clearance(), 8.9e-6 - 6e-6 * 6. / (8. * 6.2), 1e-18) << "m";
  EXPECT_NEAR(s.overlap.time, 5. + 6. / (2. * 6.2), 1e-12) << "s";
}

TEST(ProbeScalars, TellWhenAndHowLongTheRotorTouches) {
  ProbeScalars s;
  const double left[] = {2e-6, -2e-6, -4e-6, 4e-6, 1e-6};  // through zero at 0.5 ms and at 2.5 ms
  for (int k = 0; k < 5; ++k) s.follow(1e-3 * k, left[k], k == 2 ? 70. : 0.);
  EXPECT_NEAR(s.first_touch_time, 0.5e-3, 1e-15);
  EXPECT_NEAR(s.time_touching, 2e-3, 1e-15);
  EXPECT_EQ(s.contact_force.value, 70.);
  EXPECT_EQ(s.contact_force.time, 2e-3);
}

TEST(ProbeScalars, TellARotorThatTouchesFromTheStart) {
  ProbeScalars s;
  s.follow(0., -1e-6, 0.);
  s.follow(1e-3, -2e-6, 0.);
  EXPECT_EQ(s.first_touch_time, 0.);
  EXPECT_NEAR(s.time_touching, 1e-3, 1e-15);
}

}  // namespace
}  // namespace rotordrop
