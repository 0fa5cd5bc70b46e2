// From parameters to a touchdown bearing's numbers.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "../../verification/bearing/test_bearings.h"
#include "bearing/touchdown_data.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

TouchdownParameters tb2() {
  TouchdownParameters p;
  p.contact_stiffness = 1.73e9;
  p.support.type = "linear";
  p.support.K_y = p.support.K_z = 1e9;
  p.support.C_y = p.support.C_z = 3e3;
  p.rows = 2;
  p.balls_per_row = 23;
  p.ball_diameter = 9.525e-3;
  p.pitch_diameter = 85e-3;
  p.conformity = {0.52, 0.52};
  p.contact_angle = 25 * deg;
  p.preload = 290.;
  p.row_phase = 0.5;
  p.width = 32e-3;
  p.inner_ring_diameters = {70e-3, 78e-3};
  return p;
}
const ContactParameters contact = {.friction_coefficient = 0.1,
                                   .air_gap = 250e-6,
                                   .exponent = 10. / 9.,
                                   .lambda = 0.08,
                                   .regularisation_speed = 0.05,
                                   .bore_radius = {},
                                   .static_friction_coefficient = {},
                                   .stribeck_speed = 0.5,
                                   .friction_over_speed = {},
                                   .friction_over_temperature = {}};
const TouchdownSurroundings around = {steel, steel, {-9.81, 0.}, 0., false, 0., {}};

TEST(TouchdownData, BallStiffnessOfTheReferenceBearings) {
  EXPECT_NEAR(touchdown_data("TB2", tb2(), contact, around).rows[0].stiffness, 9.923e9, 0.001e9) << "N/m^1.5";
  auto exact = tb2();
  exact.elliptic_integrals = EllipticIntegrals::exact;
  EXPECT_NEAR(touchdown_data("TB2", exact, contact, around).rows[0].stiffness, 9.819e9, 0.001e9) << "N/m^1.5";
  auto p = tb2();
  p.rows = 1;
  p.balls_per_row = 14;
  p.ball_diameter = 11.906e-3;
  p.pitch_diameter = 90e-3;
  p.contact_angle = p.preload = 0.;
  EXPECT_NEAR(
      touchdown_data("TB1", p, contact, {steel, silicon_nitride, {-9.81, 0.}, 0., false, 0., {}}).rows[0].stiffness,
      1.3439e10, 0.0001e10)
      << "N/m^1.5";
}

TEST(TouchdownData, HeatOfBallSpeedIsTheSpinOfARollingBallOverTheRings) {
  auto p = tb2();
  EXPECT_EQ(touchdown_data("TB2", p, contact, around).heat_over_work, 1.);
  p.internal_heat = InternalHeat::ball_speed;
  const double gamma = 9.525 * std::cos(25 * deg) / 85.;
  const auto d = touchdown_data("TB2", p, contact, around);
  EXPECT_NEAR(d.heat_over_work, 85. / 9.525 * (1. - gamma * gamma) / 2., 1e-12) << "4.41592";
  EXPECT_FALSE(d.add_spin_heat);
}

TEST(TouchdownData, RowsOfAPairStandSymmetricallyHalfABallSpacingApart) {
  const auto d = touchdown_data("TB2", tb2(), contact, around);
  ASSERT_EQ(d.rows.size(), 2u);
  EXPECT_NEAR(d.rows[0].position, -8e-3, 1e-15) << "m: width / rows = 16 mm apart";
  EXPECT_NEAR(d.rows[1].position, 8e-3, 1e-15) << "m";
  EXPECT_NEAR(d.rows[1].phase - d.rows[0].phase, pi / 23, 1e-14) << "rad";
  EXPECT_EQ(d.rows[0].preload_offset, d.rows[1].preload_offset);
}

TEST(TouchdownData, PreloadClampsXAndOPairsInBalanceAndEachArrangementActsAsItsName) {
  const auto tilt_stiffness = [](RowArrangement arrangement) {
    auto p = tb2();
    p.arrangement = arrangement;
    const auto d = touchdown_data("TB2", p, contact, around);
    double force = 0., stiffness = 0.;
    for (const auto& g : d.rows) {
      const BallRow row(g, {});
      BallRowOutput out;
      row.evaluate({}, out);
      EXPECT_NEAR(std::fabs(out.force_x), 290., 1e-4) << "N";
      force += out.force_x;
      for (const double psi : {-1e-6, 1e-6}) {
        BallRowInput in;
        in.displacement.psi_z = psi;
        row.evaluate(in, out);
        stiffness -= out.moment_z / (2. * psi);
      }
    }
    return std::pair{stiffness, force};
  };
  const auto [X, force_X] = tilt_stiffness(RowArrangement::face_to_face);
  const auto [O, force_O] = tilt_stiffness(RowArrangement::back_to_back);
  const auto tandem = tilt_stiffness(RowArrangement::tandem);
  EXPECT_NEAR(force_X, 0., 1e-6) << "N";
  EXPECT_NEAR(force_O, 0., 1e-6) << "N";
  EXPECT_NEAR(std::fabs(tandem.second), 580., 1e-3) << "N: tandem rows push the same way";
  EXPECT_GT(O, 3. * X) << "N m/rad: back to back resists tilting most";
}

TEST(TouchdownData, RotorRadiusIsTheBoreLessTheGap) {
  auto d = touchdown_data("TB2", tb2(), contact, around);
  EXPECT_NEAR(d.bore_radius, 35e-3, 1e-15) << "m: half of the ring's bore if nothing is said";
  EXPECT_NEAR(d.rotor_radius, 34.75e-3, 1e-15) << "m";
  auto own = tb2();
  own.bore_radius = 36e-3;
  own.air_gap = 300e-6;
  auto general = contact;
  general.bore_radius = 34e-3;
  d = touchdown_data("TB2", own, general, around);
  EXPECT_NEAR(d.bore_radius, 36e-3, 1e-15) << "m: the bearing's own first";
  EXPECT_NEAR(d.rotor_radius, 35.7e-3, 1e-15) << "m";
  d = touchdown_data("TB2", tb2(), general, around);
  EXPECT_NEAR(d.bore_radius, 34e-3, 1e-15) << "m: then that of [contact]";
}

TEST(TouchdownData, WavesGoToTheSurfaceThatIsNamed) {
  auto p = tb2();
  p.waviness = {{WavySurface::inner_race, 2, 1e-6, 0.1},
                {WavySurface::bore, 3, 2e-6, 0.2},
                {WavySurface::outer_race, 4, 3e-6, 0.3}};
  const auto d = touchdown_data("TB2", p, contact, around);
  ASSERT_EQ(d.race_waves.size(), 2u);
  ASSERT_EQ(d.bore_waves.size(), 1u);
  EXPECT_TRUE(d.race_waves[0].on_inner_race);
  EXPECT_FALSE(d.race_waves[1].on_inner_race);
  EXPECT_EQ(d.race_waves[1].order, 4);
  EXPECT_EQ(d.bore_waves[0].amplitude, 2e-6);
}

TEST(TouchdownData, StaticFrictionIsUsedOnlyIfGiven) {
  EXPECT_FALSE(touchdown_data("TB2", tb2(), contact, around).friction.has_stribeck);
  auto sticky = contact;
  sticky.static_friction_coefficient = 0.2;
  const auto d = touchdown_data("TB2", tb2(), sticky, around);
  EXPECT_TRUE(d.friction.has_stribeck);
  EXPECT_EQ(d.friction.static_mu, 0.2);
}

}  // namespace
}  // namespace rotordrop
