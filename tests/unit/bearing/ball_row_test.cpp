// Ball rows: properties that hold at any state.
#include "bearing/row/ball_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <stdexcept>

#include "../../verification/bearing/test_bearings.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

BallRowInput random_input(std::mt19937& random, bool tilting) {
  std::uniform_real_distribution<double> one(-1, 1);
  BallRowInput in;
  in.displacement = {0., 30 * um * one(random), 30 * um * one(random), 0., 0.};
  in.rate = {0., 0.5 * one(random), 0.5 * one(random), 0., 0.};
  if (tilting) {
    in.displacement.x = 10 * um * one(random);
    in.displacement.psi_y = 2e-4 * one(random);
    in.displacement.psi_z = 2e-4 * one(random);
    in.rate.x = 0.2 * one(random);
    in.rate.psi_y = 5. * one(random);
    in.rate.psi_z = 5. * one(random);
  }
  in.cage_angle = 10. * one(random);
  in.cage_cosine = std::cos(in.cage_angle);
  in.cage_sine = std::sin(in.cage_angle);
  in.cage_speed = 700. * one(random);
  in.ring_angle = 10. * one(random);
  in.ring_speed = 1500. * one(random);
  in.radial_growth = 2 * um * one(random);
  in.ball_growth = 1 * um * one(random);
  return in;
}

std::vector<BallRowGeometry> some_rows() {
  std::vector<BallRowGeometry> rows = {deep_groove_row()};
  for (const auto& g : angular_contact_pair(290.)) rows.push_back(g);
  for (const int n : {3, 7, 8, 9, 16, 256}) {  // around whole machine vectors
    auto g = deep_groove_row();
    g.n_balls = n;
    rows.push_back(g);
  }
  for (auto& g : rows) g.damping_beta = 2.5e-5;
  return rows;
}

const std::vector<RaceWave> waves = {{true, 2, 4e-6, 0.3}, {false, 5, 2e-6, 1.}};

std::vector<double> numbers(const BallRowOutput& o) {
  return {o.force_x,        o.force_y,        o.force_z,     o.moment_y,       o.moment_z,    o.damping_power,
          o.elastic_radial, o.elastic_normal, o.cage_torque, o.waviness_power, o.largest_load};
}

std::vector<double> numbers(const RowTractions& t) {
  return {t.inner_load,       t.outer_load,  t.gyroscopic, t.largest_gyroscopic_over_load,
          t.inner_gyroscopic, t.centrifugal, t.truncation};
}

TEST(BallRow, ShortKernelsAgreeWithTheGeneralOneWithoutTilt) {
  auto rows = some_rows();
  auto beside = deep_groove_row();
  beside.position = 0.01;  // where the rings' widths move the grooves apart
  EXPECT_TRUE(BallRow(deep_groove_row(), {}).is_radial());
  EXPECT_FALSE(BallRow(beside, {}).is_radial());
  rows.push_back(beside);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> one(-1, 1);
  for (const auto& g : rows)
    for (int i = 0; i < 30; ++i) {
      const BallRow row(g, i % 2 ? waves : std::vector<RaceWave>{});
      auto in = random_input(random, false);
      if (i % 3 == 0)
        in.displacement.y *= 60.;  // some balls have their inner groove's centre on the far side of the outer one's
      in.inner_strain = 1e-3 * one(random);
      in.outer_strain = 1e-3 * one(random);
      BallRowOutput all, translations;
      RowTractions all_tractions, tractions;
      row.evaluate(in, all, &all_tractions);
      row.evaluate_translations(in, translations, &tractions);
      auto a = numbers(all), b = numbers(translations);
      a[3] = a[4] = 0.;  // the short one leaves the moments at zero
      const double scale = 1. + std::fabs(all.elastic_normal);
      for (std::size_t k = 0; k < a.size(); ++k)
        EXPECT_NEAR(a[k], b[k], 1e-11 * scale) << "member " << k << " of " << g.n_balls << " balls";
      a = numbers(all_tractions), b = numbers(tractions);
      for (std::size_t k = 0; k < a.size(); ++k)
        EXPECT_NEAR(a[k], b[k], 1e-11 * scale) << "traction " << k << " of " << g.n_balls << " balls";
    }
}

TEST(BallRow, BallsNeverPull) {
  std::mt19937 random(2);
  bool clamped = false;
  for (const auto& g : some_rows()) {
    const BallRow row(g, waves);
    for (int i = 0; i < 200; ++i) {
      auto in = random_input(random, true);
      in.rate.y *= 100.;  // fast enough for the damping to exceed the elastic force of a parting ball
      std::vector<double> load(static_cast<std::size_t>(g.n_balls)), standing = load;
      row.ball_loads(in, load);
      in.rate = {};
      row.ball_loads(in, standing);
      for (std::size_t j = 0; j < load.size(); ++j) {
        ASSERT_GE(load[j], 0.) << "N";
        if (standing[j] == 0.) {
          ASSERT_EQ(load[j], 0.) << "a free ball carries nothing at any speed";
        }
        clamped |= standing[j] > 0. && load[j] == 0.;
      }
    }
  }
  EXPECT_TRUE(clamped) << "the states include balls that part faster than their elastic force follows";
}

TEST(BallRow, LoadsOfAllBallsAddUpToTheRowsForce) {
  std::mt19937 random(3);
  for (const auto& g : some_rows()) {
    const BallRow row(g, waves);
    const auto in = random_input(random, true);
    BallRowOutput out;
    row.evaluate(in, out);
    std::vector<double> load(static_cast<std::size_t>(g.n_balls));
    row.ball_loads(in, load);
    EXPECT_NEAR(out.largest_load, *std::max_element(load.begin(), load.end()), 1e-10 * out.largest_load) << "N";
    double fx = 0., fy = 0., fz = 0.;
    const double A = 0.04 * g.ball_diameter,
                 R_c = 0.5 * g.pitch_diameter + 0.02 * g.ball_diameter * std::cos(g.contact_angle),
                 x_c = g.position + g.direction * 0.02 * g.ball_diameter * std::sin(g.contact_angle);
    const auto& e = in.displacement;
    for (int j = 0; j < g.n_balls; ++j) {
      const double b = g.phase + 2. * pi * j / g.n_balls + in.cage_angle, c = std::cos(b), s = std::sin(b);
      const double Br = A * std::cos(g.contact_angle) - g.radial_clearance + in.radial_growth +
                        (e.y + x_c * e.psi_z) * c + (e.z - x_c * e.psi_y) * s;
      const double Bx =
          g.direction * (A * std::sin(g.contact_angle) + g.preload_offset) + e.x + R_c * (e.psi_y * s - e.psi_z * c);
      const double F = load[static_cast<std::size_t>(j)], B = std::hypot(Br, Bx);
      fx -= F * Bx / B;
      fy -= F * Br / B * c;
      fz -= F * Br / B * s;
    }
    const double scale = 1e-9 * (1. + out.elastic_normal);
    EXPECT_NEAR(out.force_x, fx, scale) << "N, " << g.n_balls << " balls";
    EXPECT_NEAR(out.force_y, fy, scale) << "N, " << g.n_balls << " balls";
    EXPECT_NEAR(out.force_z, fz, scale) << "N, " << g.n_balls << " balls";
  }
}

TEST(BallRow, LetsANumberThatIsNoneThrough) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& g : some_rows()) {
    const BallRow row(g, {});
    for (const int which : {0, 1, 2}) {
      std::mt19937 random(4);
      auto in = random_input(random, false);
      (which == 0 ? in.displacement.y : which == 1 ? in.displacement.z : in.radial_growth) = nan;
      BallRowOutput out;
      row.evaluate_translations(in, out);
      EXPECT_TRUE(std::isnan(out.force_y) || std::isnan(out.force_z))
          << "translations, input " << which << ", " << g.n_balls << " balls";
      row.evaluate(in, out);
      EXPECT_TRUE(std::isnan(out.force_y) || std::isnan(out.force_z))
          << "general, input " << which << ", " << g.n_balls << " balls";
      EXPECT_TRUE(std::isnan(row.energy(in)));
    }
    std::mt19937 random(4);
    auto in = random_input(random, false);
    in.displacement.y = 40 * um;  // some balls carry load
    in.rate.y = nan;
    BallRowOutput out;
    row.evaluate_translations(in, out);
    EXPECT_TRUE(std::isnan(out.force_y)) << "of a rate";
  }
}

TEST(BallRow, ForcesTurnWithTheDisplacementWhenBallsAndDisplacementTurnTogether) {
  const BallRow row(deep_groove_row(), {});
  const auto force = [&](double turn) {
    BallRowInput in;
    in.displacement.y = 25 * um * std::cos(turn);
    in.displacement.z = 25 * um * std::sin(turn);
    in.cage_angle = turn + 0.1;
    in.cage_cosine = std::cos(in.cage_angle);
    in.cage_sine = std::sin(in.cage_angle);
    BallRowOutput out;
    row.evaluate_translations(in, out);
    return std::pair{out.force_y * std::cos(turn) + out.force_z * std::sin(turn),
                     out.force_z * std::cos(turn) - out.force_y * std::sin(turn)};
  };
  const auto start = force(0.);
  EXPECT_LT(start.first, -100.) << "N: against the displacement";
  for (const double turn : {0.7, 2., -3.}) {
    EXPECT_NEAR(force(turn).first, start.first, 1e-8 * std::fabs(start.first)) << "N";
    EXPECT_NEAR(force(turn).second, start.second, 1e-8 * std::fabs(start.first)) << "N";
  }
}

TEST(BallRow, ARadialOrAxialPushComesBackOpposite) {
  const auto rows = angular_contact_pair(290.);
  for (const auto& g : rows) {
    const BallRow row(g, {});
    BallRowInput in;
    BallRowOutput rest, moved;
    row.evaluate(in, rest);
    EXPECT_LT(rest.force_x * g.direction, 0.) << "a row pushes the inner ring out of its groove";
    in.displacement.x = g.direction * um;
    row.evaluate(in, moved);
    EXPECT_GT(moved.largest_load, rest.largest_load) << "and is loaded by motion in its direction";
    in.displacement.x = -g.direction * 20 * um;
    row.evaluate(in, moved);
    EXPECT_EQ(moved.largest_load, 0.) << "and lets go the other way";
  }
}

TEST(BallRow, HoldsAtMost256Balls) {
  auto g = deep_groove_row();
  g.n_balls = 257;
  EXPECT_THROW(BallRow(g, {}), std::invalid_argument);
}

TEST(RaceContact, PressesAsHertzsSphereOnAPlane) {
  // a = (3 Q R/(4 E'))^(1/3), p_0 = (6 Q E'^2/(pi^3 R^2))^(1/3): Hertz 1881, with E' = E/(2 (1 - nu^2)) of two equal bodies.
  const double R = 0.006, E = 2.1e11 / (2. * (1. - 0.09)), Q = 2000.;
  const RaceContact contact{1., std::cbrt(3. * R / (4. * E)), 1.};
  EXPECT_NEAR(contact.largest_pressure(Q), std::cbrt(6. * Q * E * E / (std::pow(M_PI, 3) * R * R)), 1.) << "Pa";
  EXPECT_EQ(contact.largest_pressure(0.), 0.);
  EXPECT_EQ(contact.largest_pressure(-1.), 0.);
  EXPECT_NEAR(RaceContact({1., contact.axis_factor, 4.}).largest_pressure(Q), 4. * contact.largest_pressure(Q), 10.)
      << "Pa: as long an ellipse, a quarter as wide";
}

}  // namespace
}  // namespace rotordrop
