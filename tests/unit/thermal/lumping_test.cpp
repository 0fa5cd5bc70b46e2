// Numbers of Biot and Fourier against their closed forms.
#include "thermal/circuit/lumping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace rotordrop;
using std::numbers::pi;

BearingCircuitData steel_bearing() {
  BearingCircuitData b;
  b.name = "TB";
  b.ring = b.shaft = {40., 500., 8000., 1.2e-5, 0.3};  // a = 1e-5 m2/s
  b.ball = {20., 800., 2500., 3e-6, 0.26};             // a = 1e-5 m2/s
  b.width = 0.02;
  b.journal_radius = 0.03475;
  b.ring_mass = 0.3;
  b.inner_bore = 0.07;
  b.inner_outside = 0.078;
  b.outer_bore = 0.1;
  b.outer_outside = 0.11;
  b.housing_bore = 0.11;
  b.housing_outside = 0.13;
  b.housing_length = 0.025;
  b.shaft_length = 0.02;
  b.n_balls = 14;
  b.ball_diameter = 0.012;
  b.h_shaft = b.h_ball = 50.;
  b.fit_resistance = 0.005;
  b.contact_half_width = 4e-4;
  b.gap_resistance = 1.4;
  return b;
}

LumpedBody body(const BearingCircuitData& b, const std::string& name) {
  for (const auto& found : lumped_bodies(b))
    if (found.name == name) return found;
  ADD_FAILURE() << name;
  return {};
}

TEST(Lumping, FourierIsDiffusivityTimesTimeOverThicknessSquared) {
  const auto ring = body(steel_bearing(), "inner_ring");
  EXPECT_NEAR(ring.length, 0.004, 1e-15);
  EXPECT_NEAR(ring.fourier(0.16), 1e-5 * 0.16 / 16e-6, 1e-12);
  EXPECT_NEAR(ring.depth(2.5e-3), std::sqrt(2.5e-8), 1e-15);
  EXPECT_NEAR(body(steel_bearing(), "ball").length, 0.006, 1e-15);
}

// An insulated plate after a pulse on one side, over its mean: 1 + 2 sum cos(0) exp(-n^2 pi^2 Fo). At the evening time the rest is a tenth; the
// next term adds 2 * 0.05^4 = 1.25e-5.
TEST(Lumping, AfterTheEveningTimeATenthOfTheUnevennessIsLeft) {
  const auto ring = body(steel_bearing(), "inner_ring");
  const double Fo = ring.fourier(ring.evening_time());
  double rest = 0.;
  for (int n = 1; n < 20; ++n) rest += 2. * std::exp(-n * n * pi * pi * Fo);
  EXPECT_NEAR(rest, 0.1, 2e-5);
  // four digits
  EXPECT_NEAR(Fo, 0.3035, 5e-5);
}

// R2 = 1/(4 pi k W) over the bore's area alone would give Bi = 4 L/d_bore, and R5 adds its part.
TEST(Lumping, BiotOfTheInnerRingIsItsConductanceOverAreaTimesThicknessOverConductivity) {
  const auto b = steel_bearing();
  const double R5 = 2. / (pi * 20. * 0.012 * 14.) + 2. / (4. * 20. * 4e-4 * 14.);
  const double expected = 4. * 0.004 / 0.07 + 0.004 / (40. * pi * 0.07 * 0.02 * R5);
  EXPECT_NEAR(body(b, "inner_ring").biot, expected, 1e-12);
}

TEST(Lumping, BallsThatOnlyLoseHeatToTheAirHaveTheTextbookBiotNumber) {
  auto b = steel_bearing();
  b.contact_half_width = 1e-12;
  EXPECT_NEAR(body(b, "ball").biot, 50. * 0.006 / 20., 1e-9);
}

TEST(Lumping, ALinkInContactOnlyTakesTheGapIntoAccount) {
  auto b = steel_bearing();
  const double permanent = body(b, "shaft").biot;
  b.shaft_ring_link = BearingCircuitData::Link::in_contact;
  const double R3 = std::log(0.074 / 0.0695) / (2. * pi * 40. * 0.02), R1 = 1. / (50. * pi * 0.0695 * 0.02);
  const double per_conductance = 0.03475 / (40. * pi * 0.0695 * 0.02);
  EXPECT_NEAR(body(b, "shaft").biot, per_conductance * (1. / R1 + 1. / (R3 + 1.4)), 1e-12);
  EXPECT_NEAR(permanent, per_conductance * (1. / R1 + 1. / R3), 1e-12);
}

TEST(Lumping, AShaftIsOfItsOwnMaterial) {
  auto b = steel_bearing();
  const double of_steel = body(b, "shaft").biot * 40.;
  b.shaft = {10., 500., 4000., 1e-5, 0.3};  // a = 5e-6 m2/s
  EXPECT_NEAR(body(b, "shaft").biot * 10., of_steel, 1e-12);
  EXPECT_NEAR(body(b, "shaft").diffusivity, 5e-6, 1e-18);
  EXPECT_NEAR(body(b, "inner_ring").diffusivity, 1e-5, 1e-18);
}

TEST(Lumping, OuterRingAndHousingMeetAtTheFit) {
  const auto b = steel_bearing();
  const double R_ring = std::log(0.11 / 0.105) / (2. * pi * 40. * 0.02), film = 23. * pi * 0.13 * 0.025;
  EXPECT_NEAR(body(b, "housing").biot, (1. / (R_ring + 0.005) + film) * 0.01 / (40. * pi * 0.11 * 0.025), 1e-12);
  const double R_housing = std::log(0.12 / 0.11) / (2. * pi * 40. * 0.025),
               R5 = 2. / (pi * 20. * 0.012 * 14.) + 2. / (4. * 20. * 4e-4 * 14.);
  EXPECT_NEAR(body(b, "outer_ring").biot, (1. / R5 + 1. / (0.005 + R_housing)) * 0.005 / (40. * pi * 0.1 * 0.02),
              1e-12);
}

}  // namespace
