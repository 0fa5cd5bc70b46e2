// What is followed from step to step.
#include "analysis/drop_scalars.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace rotordrop {
namespace {

// The farthest that looks lie apart where steps stay short, with the top of a half-wave of 1 midway between two of them: docs/reference/results.md.
TEST(FollowedPeak, MeetsTheTopOfAHalfWaveBetweenLooks) {
  constexpr double apart = 14.4e-6, top = 1.;  // [s]: looks, and when the top is
  for (const auto& [frequency, allowed] : {std::pair{2e3, 3e-5}, {4e3, 4e-4}, {8e3, 6.5e-3}}) {
    const auto wave = [f = frequency](double t) {
      return std::fabs(t) < 0.25 / f ? std::cos(2. * std::numbers::pi * f * t) : 0.;
    };
    FollowedPeak peak;
    for (int k = -20; k <= 20; ++k) peak.follow(true, top + (k + 0.5) * apart, wave((k + 0.5) * apart));
    // The parabola through b, a, a has its vertex an eighth of a - b above a.
    const double a = wave(0.5 * apart), b = wave(1.5 * apart);
    EXPECT_NEAR(peak.value, a + (a - b) / 8., 1e-9) << frequency << " Hz: times near 1 s have 2e-16 s of roundoff";
    EXPECT_NEAR(peak.value, 1., allowed) << frequency << " Hz";
    EXPECT_NEAR(peak.time, top, 1e-10) << frequency << " Hz";
  }
}

/// Parabolas through three samples a second apart rise above the middle one by (d_1 - d_2)^2 / (8 (d_1 + d_2)), d the falls to its neighbours.
TEST(FollowedPeak, FindsAHigherTopWhoseSamplesLieBelowAnEarlierOne) {
  FollowedPeak peak;
  const double samples[] = {0., 10., 9.9, 0., 5., 11.1, 11., 0.};
  for (int k = 0; k < 8; ++k) {
    peak.follow(true, k, samples[k]);
    if (k == 4) {
      EXPECT_NEAR(peak.value, 10. + 9.9 * 9.9 / (8. * 10.1), 1e-13) << "the first top, 11.213";
    }
  }
  EXPECT_NEAR(peak.value, 11.1 + 6. * 6. / (8. * 6.2), 1e-13) << "the second one, 11.826";
  EXPECT_NEAR(peak.time, 5. + 6. / (2. * 6.2), 1e-14) << "s: (d_1 - d_2) / (2 (d_1 + d_2)) behind the middle";
}

TEST(FollowedDemand, CountsTheTimeAboveOneByStraightLines) {
  // 0 - 2 - 0 - 0 - 3 - 3 - 0.5 at whole seconds, the ring's speed 0 10 30 30 24 20 0.
  const double demand[] = {0, 2, 0, 0, 3, 3, 0.5}, speed[] = {0, 10, 30, 30, 24, 20, 0};
  FollowedDemand d;
  for (int k = 0; k < 7; ++k) d.follow(true, k, demand[k], speed[k]);
  EXPECT_NEAR(d.time_beyond, 0.5 + 0.5 + 2. / 3. + 1. + 0.8, 1e-14) << "s";
  EXPECT_NEAR(d.longest_beyond, 2. / 3. + 1. + 0.8, 1e-14) << "s";
  EXPECT_EQ(d.speed_change, 10. + 20. + 0. + 6. + 4. + 20.) << "rad/s";
  EXPECT_NEAR(d.speed_change_beyond, 5. + 10. + 4. + 4. + 16., 1e-13) << "rad/s, up and down";
  EXPECT_EQ(d.largest, 3.);
  EXPECT_EQ(d.largest_time, 4.);
}

TEST(FollowedDemand, HasNoTimeOfALargestDemandWhereNothingIsAsked) {
  FollowedDemand d;
  for (int k = 0; k < 3; ++k) d.follow(true, k, 0., 100. * k);
  EXPECT_EQ(d.largest, 0.);
  EXPECT_TRUE(std::isnan(d.largest_time));
  EXPECT_EQ(d.time_beyond, 0.);
}

}  // namespace
}  // namespace rotordrop
