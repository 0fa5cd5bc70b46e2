// Tractions that rolling asks for.
//
// Plane of a ball: axial direction x, radial direction r, direction of travel t = x cross r; contacts at -+ (d/2) n, n = (sin phi, cos phi). The ball
// turns with omega_c x - omega_b a, a = (cos phi, -sin phi) square to n, and travels with r_m omega_c t. Everything is done with cross products and
// the speed ratios of laws/ball_kinematics.h, then compared.
//
// AT phi = 0 a ball travels with v = r_i omega_i / 2 and rolls with 2 v / d, so its energy m v^2 / 2 + (m d^2 / 10) (2 v / d)^2 / 2 = 0.7 m v^2 is that of
// 0.35 m r_i^2 more of the ring's spin inertia. The inner race drives the row with Z T_i at r_i, so T_i = 0.35 m r_i omega_i'.
#include "laws/skidding.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>

#include "laws/ball_kinematics.h"

namespace rotordrop {
namespace {

using Eigen::Vector3d;  // components along x, r, t
constexpr double deg = std::numbers::pi / 180.;
constexpr double m = 3.5e-3, d = 9.525e-3, d_m = 85e-3, J = 0.1 * m * d * d;

double acceleration(double phi, double ring_acceleration) {
  return 0.5 * d_m * cage_speed_ratio(d, d_m, phi) * ring_acceleration;
}

TEST(RollingTractions, BalanceTheBallsForcesAndMoments) {
  const double omega = 2e4;  // of the ring, per second
  for (const double phi : {0., 15. * deg, 25. * deg, 40. * deg}) {
    const auto T = rolling_tractions(m, acceleration(phi, omega));
    const Vector3d x(1, 0, 0), t(0, 0, 1), n(std::sin(phi), std::cos(phi), 0), a(std::cos(phi), -std::sin(phi), 0);
    const Vector3d spin_rate = omega * (cage_speed_ratio(d, d_m, phi) * x - ball_spin_ratio(d, d_m, phi) * a);
    const Vector3d moment = (-0.5 * d * n).cross(T.inner * t) + (0.5 * d * n).cross(T.outer * t);
    EXPECT_NEAR(T.inner + T.outer, m * acceleration(phi, omega), 1e-14) << "N";
    EXPECT_NEAR(moment.dot(a), J * spin_rate.dot(a), 1e-14 * T.inner) << "N m";
  }
}

TEST(RollingTractions, DoTheWorkThatTheBallsTakeUp) {
  const int Z = 23;
  const double speed = 900., rate = 2e4, r_i = 0.5 * (d_m - d);
  const auto T = rolling_tractions(m, acceleration(0., rate));
  const double J_balls = Z * 0.35 * m * r_i * r_i;
  EXPECT_NEAR(Z * T.inner * r_i * speed / (J_balls * speed * rate), 1., 1e-14) << "the outer race stands and does none";
  EXPECT_NEAR(T.inner, 0.35 * m * r_i * rate, 1e-14) << "N";

  for (const double phi : {15. * deg, 25. * deg, 40. * deg}) {
    // Kinetic energy of travel and of rolling; what is left, spin about the normal, no traction along t can change.
    const double v = 0.5 * d_m * cage_speed_ratio(d, d_m, phi) * speed;
    const double W = (ball_spin_ratio(d, d_m, phi) - cage_speed_ratio(d, d_m, phi) * std::cos(phi)) * speed;
    const double race = 0.5 * (d_m - d * std::cos(phi)) * speed;
    EXPECT_NEAR(rolling_tractions(m, acceleration(phi, rate)).inner * race / ((m * v * v + J * W * W) * rate / speed),
                1., 1e-13);
  }
}

TEST(GyroscopicTraction, TurnsTheBallsMomentum) {
  const double orbit = 700.;
  for (const double phi : {5. * deg, 25. * deg, 40. * deg}) {
    const double theta = pitch_angle_outer_race_control(phi, d, d_m);
    const double spin = orbit * (d_m + d * std::cos(phi)) / (d * std::cos(phi - theta));  // rolling on the outer race
    const Vector3d x(1, 0, 0), momentum = J * (orbit * x - spin * Vector3d(std::cos(theta), -std::sin(theta), 0));
    const double moment = (orbit * x).cross(momentum).norm();
    EXPECT_NEAR(gyroscopic_traction(0.5 * m * d_m * orbit * orbit, std::sin(phi)) / (2. * moment / d), 1., 1e-13);
  }
}

TEST(GyroscopicTraction, IsAtMostAFifthOfTheTangentOfHalfTheContactAngle) {
  const double F_c = 76.;
  for (const double phi : {15. * deg, 25. * deg, 40. * deg}) {
    const auto ratio = [&](double Q) {
      const auto o = outer_contact(Q, std::sin(phi), std::cos(phi), F_c);
      return gyroscopic_traction(F_c, o.sine) / o.load;
    };
    const double bound = 0.2 * std::tan(0.5 * phi);
    EXPECT_NEAR(ratio(F_c), bound, 1e-15);
    for (const double Q : {0.01, 1., 30., 60., 75., 77., 100., 1e3, 1e4}) EXPECT_LT(ratio(Q), bound);
  }
}

TEST(OuterContact, TakesTheInnerLoadAndTheCentrifugalForce) {
  // 3-4-5: 30 N axially; 10 N radially from the inner race and 30 N from the turning.
  const auto o = outer_contact(std::hypot(30., 10.), 30. / std::hypot(30., 10.), 10. / std::hypot(30., 10.), 30.);
  EXPECT_NEAR(o.load, 50., 1e-13) << "N";
  EXPECT_NEAR(o.sine, 0.6, 1e-15);
  EXPECT_EQ(outer_contact(0., 0.4, 0.9, 0.).sine, 0.);
}

TEST(RollingDemand, ComparesWhatARowAsksForWithItsFriction) {
  // Ten balls of 1 kg at 1 m/s2: 7 N inside, 3 N outside.
  EXPECT_NEAR(rolling_demand({140., 1e9, 0., 0., 0., 0., 0.}, 10, 1., 1., 0.1), 0.5, 1e-15) << "7 N of 14 N";
  EXPECT_NEAR(rolling_demand({1e9, 100., 4., 0., 0., 0., 0.}, 10, 1., 1., 0.1), 0.5, 1e-15)
      << "3 N along, 4 N across, of 10 N";
}

TEST(TractionDemand, IsFiniteWithoutLoadOrFriction) {
  EXPECT_EQ(traction_demand(0., 0.1, 0.), 0.) << "nothing is asked";
  EXPECT_EQ(traction_demand(1e-9, 0.1, 0.), largest_traction_demand);
  EXPECT_EQ(traction_demand(1., 0., 1e3), largest_traction_demand);
  EXPECT_EQ(traction_demand(1e6, 0.1, 1.), largest_traction_demand);
  EXPECT_NEAR(traction_demand(3., 0.1, 20.), 1.5, 1e-15);
}

}  // namespace
}  // namespace rotordrop
