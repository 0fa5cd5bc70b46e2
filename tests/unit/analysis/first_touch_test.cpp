#include "analysis/facts/first_touch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "case/case.h"
#include "machine/speed_growth.h"

namespace rotordrop {
namespace {

CaseParameters reference(const std::vector<std::string>& settings) {
  return read_case(ROTORDROP_SOURCE_DIR "/params/neisi2019.toml", settings).parameters;
}
constexpr double tolerance = 1e-9;  // [s], within which the search ends

TEST(FirstTouch, OfARotorFromRestIsThatOfAFreeFall) {
  const auto t = first_touch(reference({}));
  ASSERT_TRUE(t);
  EXPECT_NEAR(t->earliest, std::sqrt(2. * 250e-6 / 9.81), tolerance);
}

TEST(FirstTouch, CountsOffsetAndVelocity) {
  // 100 um up, thrown up at 0.05 m/s: -250 um = 100 um + v t - g t^2 / 2.
  const double v = 0.05, g = 9.81;
  EXPECT_NEAR(
      first_touch(reference({"rotor.initial_offset=[\"100 um\", 0]", "rotor.initial_velocity=[\"0.05 m/s\", 0]"}))
          ->earliest,
      (v + std::sqrt(v * v + 2. * g * 350e-6)) / g, tolerance);
  // Sideways: |(v t, g t^2 / 2)| = gap.
  const double t = first_touch(reference({"rotor.initial_velocity=[0, \"0.1 m/s\"]"}))->earliest;
  EXPECT_NEAR(std::hypot(0.1 * t, 0.5 * g * t * t), 250e-6, 0.15 * tolerance);
}

TEST(FirstTouch, OfATiltedRotorIsThatOfItsLowerEnd) {
  const auto p = reference({"rotor.initial_tilt=[0, \"0.1 mrad\"]"});
  const double x =
      p.rotor.geometry.position(2) - rigid_body(p.rotor.geometry).centre_of_gravity;  // negative: TB1 is lower
  ASSERT_LT(x, 0.);
  EXPECT_NEAR(first_touch(p)->earliest, std::sqrt(2. * (250e-6 + 1e-4 * x) / 9.81), tolerance);
}

TEST(FirstTouch, ComesSoonerOfARotorThatGrowsByItsSpeed) {
  auto p = reference({"thermal.growth_by_speed=\"closed-form\""});
  // A solid shaft of radius r grows by rho omega^2 r^3 (1 - nu) / (4 E); the larger growth touches first.
  const double omega = p.run.initial_speed;
  double growth = 0.;
  for (const auto& entry : p.bearings) growth = std::max(growth, rotor_growth_by_speed(p, *entry.touchdown()));
  growth *= omega * omega;
  ASSERT_GT(growth, 0.3e-6);
  EXPECT_NEAR(first_touch(p)->earliest, std::sqrt(2. * (250e-6 - growth) / 9.81), tolerance);
}

TEST(FirstTouch, LiesBetweenCrestsAndTroughsOfAWavyBore) {
  const auto t = first_touch(reference({"bearings.TB1.waviness=[{surface=\"bore\", order=3, amplitude=\"20 um\"}]",
                                        "bearings.TB2.waviness=[{surface=\"bore\", order=3, amplitude=\"20 um\"}]"}));
  EXPECT_NEAR(t->earliest, std::sqrt(2. * 230e-6 / 9.81), tolerance);
  EXPECT_NEAR(t->latest, std::sqrt(2. * 270e-6 / 9.81), tolerance);
}

TEST(FirstTouch, MayBeAtAProbe) {
  const auto t =
      first_touch(reference({"rotor.probes.seal={node=9, clearance=\"100 um\", contact={stiffness=\"1e8 N/m\"}}"}));
  EXPECT_NEAR(t->earliest, std::sqrt(2. * 100e-6 / 9.81), tolerance);
  EXPECT_TRUE(t->is_probe);
  EXPECT_EQ(t->name, "seal");
}

TEST(FirstTouch, IsUnknownOfARotorThatFloatsOrIsHeld) {
  EXPECT_FALSE(first_touch(reference({"run.gravity=[0, 0, 0]"})));
  EXPECT_FALSE(
      first_touch(reference({"bearings.M={type=\"magnet\", node=5, stiffness=[[1e7,0],[0,1e7]], "
                             "release_time=[\"5 ms\", \"5 ms\"]}"})));
}

}  // namespace
}  // namespace rotordrop
