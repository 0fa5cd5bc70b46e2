// Balls with centrifugal force and gyroscopic moment.
//
// PEER. validation/ball_balance.py solves the 218 bearing of Harris' Rolling Bearing Analysis (Z = 16, d = 22.23 mm, d_m = 125.26 mm, 40 deg,
// f = 0.5232, 17800 N of thrust) from mechanics alone: kinematics of rolling as a linear system of vectors, the gyroscopic moment as the rate of
// the angular momentum, scipy's elliptic integrals and fsolve. The table below is what it prints; it shares no formula with the program.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "../bearing/numerical_derivative.h"
#include "../bearing/test_bearings.h"
#include "bearing/statics/bearing_statics.h"
#include "integrate/equilibrium.h"
#include "laws/ball_kinematics.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

BallRowGeometry harris_218() {
  auto g = row(16, 22.23e-3, 125.26e-3, 40 * deg, steel, EllipticIntegrals::exact);
  g.inner_conformity = g.outer_conformity = 0.5232;
  const double modulus = effective_modulus(steel, steel), projected = 0.5 * g.ball_diameter * std::cos(40 * deg);
  const auto race = [&](const ContactGeometry& c) {
    return RaceContact{hertz_stiffness(c, modulus, EllipticIntegrals::exact),
                       semi_major_axis_factor(c, modulus, EllipticIntegrals::exact),
                       contact_ellipse(c, EllipticIntegrals::exact).k};
  };
  g.inner = race(inner_race_contact(g.ball_diameter, 0.5 * g.pitch_diameter - projected, 0.5232));
  g.outer = race(outer_race_contact(g.ball_diameter, 0.5 * g.pitch_diameter + projected, 0.5232));
  g.stiffness = stiffness_in_series(g.inner.stiffness, g.outer.stiffness);
  return g;
}

/// What the peer found at a speed.
struct Line {
  double rpm, Q_i, Q_o, phi_i, phi_o, omega_m, F_c, M_g, x;
};

struct Rest {
  EquilibriumResult result;
  RingReport report;
  BallBalance balance;  // of the ball at the bottom; under thrust all are alike
};
Rest under_thrust(const BallRowGeometry& g, double rpm) {
  RingSurroundings around;
  around.has_inertia = true;
  around.speed = rpm * pi / 30.;
  BearingEquilibrium system(RingStatics({g}, around), {.x = 17800.});
  std::vector<double> x(system.size());
  const auto result = find_equilibrium(system, x);
  return {result, report_ring(system.ring(), system.place(x)), system.ring().balls(system.place(x))[0][3].balance};
}

TEST(BallInertia, JonesBalanceIsThatOfRollingAndMomentumAlone) {
  const std::array<Line, 5> peer = {
      {{1., 1677.9514034, 1677.9514077, 41.529904218, 41.529904034, 0.045403532, 0.0000058, 0.00000002, 36.786792},
       {5000., 1607.8232307, 1716.4737331, 43.783024252, 39.151462651, 228.628897131, 146.8778368, 0.41229821,
        35.240318},
       {10000., 1452.3467835, 1920.6642817, 49.996183730, 31.347431201, 476.369435273, 637.6491748, 1.47483538,
        15.556257},
       {12500., 1379.8996222, 2200.1609407, 53.728054659, 25.391925591, 623.110474356, 1090.9984366, 2.07996626,
        -11.360065},
       {15000., 1328.8923970, 2714.5544379, 56.841776707, 19.220552883, 791.446215841, 1760.0979563, 2.57616237,
        -47.368454}}};
  const auto g = harris_218();
  printf("   rpm   Q_i [N]   Q_o [N]  phi_i, phi_o [deg]   F_c [N]  p_i, p_o [GPa]   K_xx [N/um]\n");
  for (const auto& p : peer) {
    const auto [result, report, balance] = under_thrust(g, p.rpm);
    ASSERT_TRUE(result.found) << result.residual;
    const auto& ball = report.rows[0].balls[3];
    printf("%6.0f %9.2f %9.2f  %8.3f %8.3f  %9.2f  %6.3f %6.3f   %10.2f\n", p.rpm, ball.inner.load, ball.outer.load,
           ball.inner.angle / deg, ball.outer.angle / deg, ball.centrifugal_force, ball.inner.pressure * 1e-9,
           ball.outer.pressure * 1e-9, report.stiffness[0][0] * 1e-6);
    // The peer's digits; its fsolve ends at 1e-9 of the loads.
    EXPECT_NEAR(ball.inner.load, p.Q_i, 2e-6) << "N";
    EXPECT_NEAR(ball.outer.load, p.Q_o, 2e-6) << "N";
    EXPECT_NEAR(ball.inner.angle / deg, p.phi_i, 2e-8) << "deg";
    EXPECT_NEAR(ball.outer.angle / deg, p.phi_o, 2e-8) << "deg";
    EXPECT_NEAR(balance.orbit_speed, p.omega_m, 1e-7) << "rad/s";
    EXPECT_NEAR(ball.centrifugal_force, p.F_c, 1e-6) << "N";
    EXPECT_NEAR(ball.gyroscopic_moment, p.M_g, 1e-8) << "N m";
    EXPECT_NEAR(report.place[0] * 1e6, p.x, 1e-5) << "um";
    EXPECT_LT(ball.residual, 1e-9 * ball.outer.load) << "N";
  }
}

TEST(BallInertia, HalfTheGyroscopicMomentAtEachRaceIsThatOfMomentumAndFrictionAlone) {
  // The same peer, share 0.5 at the inner race: there friction also pushes the ring along the axis.
  const std::array<Line, 4> peer = {
      {{1., 1677.9514034, 1677.9514077, 41.529904192, 41.529904061, 0.045403532, 0.0000058, 0.00000002, 36.786792},
       {5000., 1606.3173467, 1714.7855573, 43.162906564, 39.820316348, 228.103667280, 146.2037661, 0.41626241,
        35.840720},
       {10000., 1433.9990279, 1885.6236530, 48.041053742, 34.032173977, 468.436361971, 616.5882207, 1.53422012,
        24.455143},
       {15000., 1269.0675031, 2510.3556811, 54.899404624, 23.325184461, 761.624129221, 1629.9542474, 2.86935517,
        -22.454403}}};
  auto g = harris_218();
  g.inner_gyroscopic_share = 0.5;
  for (const auto& p : peer) {
    const auto [result, report, balance] = under_thrust(g, p.rpm);
    ASSERT_TRUE(result.found) << result.residual;
    const auto& ball = report.rows[0].balls[3];
    // The peer's digits; its fsolve ends at 1e-9 of the loads.
    EXPECT_NEAR(ball.inner.load, p.Q_i, 4e-6) << "N";
    EXPECT_NEAR(ball.outer.load, p.Q_o, 4e-6) << "N";
    EXPECT_NEAR(ball.inner.angle / deg, p.phi_i, 2e-8) << "deg";
    EXPECT_NEAR(ball.outer.angle / deg, p.phi_o, 2e-8) << "deg";
    EXPECT_NEAR(balance.orbit_speed, p.omega_m, 1e-7) << "rad/s";
    EXPECT_NEAR(ball.gyroscopic_moment, p.M_g, 1e-8) << "N m";
    EXPECT_NEAR(ball.inner_traction, p.M_g / g.ball_diameter, 1e-6) << "N, M_g / d";
    EXPECT_NEAR(report.place[0] * 1e6, p.x, 2e-5) << "um";
    EXPECT_NEAR(report.rows[0].axial_force, -17800., 1e-5) << "N, friction included";
  }
}

TEST(BallInertia, StiffnessIsTheDerivativeOfThePullForEveryShare) {
  const auto g = row(23, 9.525e-3, 85e-3, 25 * deg, steel);
  const double l = 0.02 * g.ball_diameter, A = 2. * l;
  for (const double share : {0., 0.3, 0.5, 1.}) {
    const BallContacts c{g.inner.stiffness,
                         g.outer.stiffness,
                         l,
                         l,
                         g.ball_mass,
                         g.ball_diameter / g.pitch_diameter,
                         g.pitch_diameter,
                         share};
    for (const double x : {2 * um, 10 * um}) {
      const double B_x = A * std::sin(25 * deg) + x, B_r = A * std::cos(25 * deg);
      const auto at = [&](double dx, double dr) { return ball_balance(c, B_x + dx, B_r + dr, 0., 1592.); };
      const auto b = at(0., 0.);
      EXPECT_LT(b.residual, 1e-11 * b.load_o);
      const double pairs[4] = {derivative([&](double h) { return at(h, 0.).pull_x(); }, 1e-9),
                               derivative([&](double h) { return at(0., h).pull_x(); }, 1e-9),
                               derivative([&](double h) { return at(h, 0.).pull_r(); }, 1e-9),
                               derivative([&](double h) { return at(0., h).pull_r(); }, 1e-9)};
      for (int k = 0; k < 4; ++k)
        EXPECT_NEAR(b.stiffness[k], pairs[k], 1e-5 * b.stiffness[3]) << "N/m, share " << share;
    }
  }
}

TEST(BallInertia, PreloadAtSpeedOfThePairOf71914) {
  // validation/ball_balance.py: 1513.8921 N if the outer race balances all of the gyroscopic moment, 1292.9842 N if each takes half; races at their
  // mounted distance, 290 N cold, 15200 rpm.
  for (const auto& [share, preload] : {std::pair{0., 1513.8920662858595}, std::pair{0.5, 1292.9842482363088}}) {
    auto one = row(23, 9.525e-3, 85e-3, 25 * deg, steel, EllipticIntegrals::exact);
    one.inner_gyroscopic_share = share;
    RingSurroundings around;
    around.has_inertia = true;
    around.speed = 15200 * pi / 30.;
    const auto report = report_ring(RingStatics(pair(one, 290.), around), RingVector::Zero());
    printf("share %.1f at the inner race: %.4f N\n", share, report.preload);
    // The peer's offset by brentq, to 1e-12 um.
    EXPECT_NEAR(report.preload, preload, 1e-4) << "N";
  }
}

TEST(BallInertia, KinematicsAreThoseOfOuterRaceControl) {
  const auto g = harris_218();
  const BallContacts c{g.inner.stiffness,        g.outer.stiffness, 0.0232 * g.ball_diameter,
                       0.0232 * g.ball_diameter, g.ball_mass,       g.ball_diameter / g.pitch_diameter,
                       g.pitch_diameter};
  const double A = 0.0464 * g.ball_diameter;
  const auto b = ball_balance(c, A * std::sin(40 * deg) + 2e-5, A * std::cos(40 * deg), 0., 1000.);
  const double phi_i = std::atan2(b.sin_i, b.cos_i), phi_o = std::atan2(b.sin_o, b.cos_o);
  const double theta = pitch_angle_outer_race_control(phi_o, g.ball_diameter, g.pitch_diameter);
  EXPECT_NEAR(spin_speeds(1000., phi_i, phi_o, theta, g.ball_diameter, g.pitch_diameter).outer, 0., 1e-9) << "rad/s";
  // Eq. (13)'s omega_ci sin phi_i + omega_b sin(phi_i - theta) with this orbit speed.
  const double omega_b = b.orbit_speed *
                         std::sqrt(1. + 2. * c.diameter_ratio * b.cos_o + c.diameter_ratio * c.diameter_ratio) /
                         c.diameter_ratio;
  EXPECT_NEAR((1000. - b.orbit_speed) * std::sin(phi_i) + omega_b * std::sin(phi_i - theta),
              spin_speeds(1000., phi_i, phi_o, theta, g.ball_diameter, g.pitch_diameter).inner, 1e-8)
      << "rad/s";
}

TEST(BallInertia, ABallThatTheInnerRaceDoesNotReachLiesInTheBottomOfTheOuterOne) {
  const auto g = row(23, 9.525e-3, 85e-3, 25 * deg, steel);
  const double l = 0.02 * g.ball_diameter, A = 2. * l, omega = 1500.;
  const BallContacts c{g.inner.stiffness, g.outer.stiffness, l, l, g.ball_mass, g.ball_diameter / g.pitch_diameter,
                       g.pitch_diameter};
  const auto b = ball_balance(c, A * std::sin(25 * deg) - 60 * um, A * std::cos(25 * deg), 0., omega);
  EXPECT_EQ(b.load_i, 0.);
  EXPECT_NEAR(b.sin_o, 0., 1e-12);
  EXPECT_NEAR(b.load_o, 0.5 * g.ball_mass * g.pitch_diameter * b.orbit_speed * b.orbit_speed, 1e-9 * b.load_o) << "N";
}

// An outer ring that outgrows the inner one by more than a groove's radius exceeds the ball's: the inner groove's centre then lies behind the ball.
TEST(BallInertia, ABallFarFromTheInnerRaceRollsAsInLineContacts) {
  const auto g = row(14, 11.906e-3, 90e-3, 0., steel);
  const double l = 0.02 * g.ball_diameter, omega = 1500., ratio = g.ball_diameter / g.pitch_diameter;
  const BallContacts c{g.inner.stiffness, g.outer.stiffness, l, l, g.ball_mass, ratio, g.pitch_diameter};
  for (const double B_r : {0.9 * l, 0.5 * l}) {
    const auto b = ball_balance(c, 0., B_r, 0., omega);
    EXPECT_EQ(b.load_i, 0.);
    EXPECT_NEAR(b.orbit_speed, 0.5 * (1. - ratio) * omega, 1e-12 * omega) << "rad/s";
    EXPECT_NEAR(b.load_o, 0.5 * g.ball_mass * g.pitch_diameter * b.orbit_speed * b.orbit_speed, 1e-9 * b.load_o) << "N";
    for (const double k : b.stiffness) EXPECT_EQ(k, 0.) << "N/m";
  }
}

/// Grooves up to 0.3 mm from where they belong: loose balls between flank and bottom, balls past the inner groove's centre. Loads, normals and
/// tractions that are reported must cancel, and the ball must lie where its deflections put it.
TEST(BallInertia, ABallAnywhereBetweenItsGroovesComesToBalance) {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> one(-1, 1);
  const double d = 9.525e-3, l = 0.02 * d, K = 1e10;
  double worst = 0.;
  int n_past = 0, n_wedged = 0;
  for (int i = 0; i < 20000; ++i) {
    const BallContacts ball{K, K, l, l, 3.5e-3, d / 85e-3, 85e-3, i % 3 ? 0. : 0.5};
    const double angle = 25. * deg * one(random), speed = std::array{5., 50., 300., 1000., 3000.}[i % 5];
    const double B_x = 2. * l * std::sin(angle) + 300 * um * one(random),
                 B_r = 2. * l * std::cos(angle) + 300 * um * one(random);
    const BallBalance b = ball_balance(ball, B_x, B_r, 0., speed);
    const double F = b.centrifugal_force, T = 2. * b.gyroscopic_moment / d, T_i = b.inner_traction, T_o = T - T_i;
    const double along = b.load_i * b.sin_i - b.load_o * b.sin_o - T_o * b.cos_o + T_i * b.cos_i;
    const double across = b.load_i * b.cos_i - b.load_o * b.cos_o + F + T_o * b.sin_o - T_i * b.sin_i;
    worst = std::max(worst, std::hypot(along, across) / (b.load_o + F));
    EXPECT_NEAR(F, 0.5 * 3.5e-3 * 85e-3 * b.orbit_speed * b.orbit_speed, 1e-12 * F);
    EXPECT_LE(b.orbit_speed, speed) << "a ball that the inner race cannot drive is not driven faster than it";
    const double L_o = l + std::cbrt(b.load_o * b.load_o / (K * K)), x = B_x - L_o * b.sin_o, r = B_r - L_o * b.cos_o;
    if (b.load_i > 0.) {
      const double L_i = l + std::cbrt(b.load_i * b.load_i / (K * K));
      EXPECT_NEAR(x, L_i * b.sin_i, 1e-12) << "m";
      EXPECT_NEAR(r, L_i * b.cos_i, 1e-12) << "m";
    } else {
      EXPECT_LE(std::hypot(x, r), l + 1e-12) << "m";
    }
    n_past += b.sin_i * b.sin_o + b.cos_i * b.cos_o < 0.;
    n_wedged += b.iterations == 60;
  }
  printf("left over %.1e of the load; %d past the inner groove's centre, %d by halving\n", worst, n_past, n_wedged);
  EXPECT_LT(worst, 1e-9);
  EXPECT_GT(n_past, 100);
  EXPECT_GT(n_wedged, 100);
}

}  // namespace
}  // namespace rotordrop
