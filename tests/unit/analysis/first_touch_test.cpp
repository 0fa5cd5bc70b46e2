#include "analysis/facts/first_touch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "case/case.h"

namespace rotordrop {
namespace {

CaseParameters reference(const std::vector<std::string>& settings) {
  return read_case(ROTORDROP_SOURCE_DIR "/params/neisi2019.toml", settings).parameters;
}
constexpr double tolerance = 2e-9;  // of the search [s]

TEST(FirstTouch, OfARotorFromRestIsThatOfAFreeFall) {
  const auto t = first_touch(reference({}));
  ASSERT_TRUE(t);
  EXPECT_NEAR(*t, std::sqrt(2. * 250e-6 / 9.81), tolerance);
}

TEST(FirstTouch, CountsOffsetAndVelocity) {
  // 100 um up, thrown up at 0.05 m/s: -250 um = 100 um + v t - g t^2 / 2.
  const double v = 0.05, g = 9.81;
  EXPECT_NEAR(
      *first_touch(reference({"rotor.initial_offset=[\"100 um\", 0]", "rotor.initial_velocity=[\"0.05 m/s\", 0]"})),
      (v + std::sqrt(v * v + 2. * g * 350e-6)) / g, tolerance);
  // Sideways: |(v t, g t^2 / 2)| = gap.
  const double t = *first_touch(reference({"rotor.initial_velocity=[0, \"0.1 m/s\"]"}));
  EXPECT_NEAR(std::hypot(0.1 * t, 0.5 * g * t * t), 250e-6, 0.15 * tolerance);
}

TEST(FirstTouch, OfATiltedRotorIsThatOfItsLowerEnd) {
  const auto p = reference({"rotor.initial_tilt=[0, \"0.1 mrad\"]"});
  const double x =
      p.rotor.geometry.position(2) - rigid_body(p.rotor.geometry).centre_of_gravity;  // negative: TB1 is lower
  ASSERT_LT(x, 0.);
  EXPECT_NEAR(*first_touch(p), std::sqrt(2. * (250e-6 + 1e-4 * x) / 9.81), tolerance);
}

TEST(FirstTouch, IsUnknownOfARotorThatFloatsOrIsHeld) {
  EXPECT_FALSE(first_touch(reference({"run.gravity=[0, 0, 0]"})));
  EXPECT_FALSE(
      first_touch(reference({"bearings.M={type=\"magnet\", node=5, stiffness=[[1e7,0],[0,1e7]], "
                             "release_time=[\"5 ms\", \"5 ms\"]}"})));
}

}  // namespace
}  // namespace rotordrop
