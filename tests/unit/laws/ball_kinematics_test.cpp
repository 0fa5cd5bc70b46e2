// Kinematics of balls and cage with the outer ring at rest.
//
// Plane of a ball: axial direction x, radial direction r, direction of travel t = x cross r. Contacts at -+ (d/2) (sin phi, cos phi) from the
// ball's centre, inner and outer. In the cage's frame the inner ring turns with omega_ci about x, the outer with -omega_co, the ball with -omega_b
// about an axis pitched by theta. Surfaces roll: their velocities agree at the contacts. Spin is the relative angular velocity along a contact's normal.
// Everything below is done with cross products, then compared.
//
// AT phi = 0 the ball is a plane rigid body whose instantaneous centre is the outer contact: it turns with omega_i r_i / d about it, backwards, and has
//   T = 1/2 (2/5 m (d/2)^2 + m (d/2)^2) (omega_i r_i / d)^2 = 1/2 (0.35 m r_i^2) omega_i^2,
// so it adds 0.35 m r_i^2 to the ring's spin inertia.
#include "laws/ball_kinematics.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace rotordrop {
namespace {

using Eigen::Vector3d;  // components along x, r, t
using std::numbers::pi;
constexpr double deg = pi / 180.;

struct Rolling {
  double omega_c, omega_b;  // of the cage; of the ball relative to it
  SpinSpeeds spin;
};

Rolling rolling(double omega_i, double phi_i, double phi_o, double theta, double d, double d_m) {
  const Vector3d x(1, 0, 0), centre(0, 0.5 * d_m, 0), axis(std::cos(theta), -std::sin(theta), 0);
  const Vector3d n_i(std::sin(phi_i), std::cos(phi_i), 0), n_o(std::sin(phi_o), std::cos(phi_o), 0);
  const Vector3d at_i = -0.5 * d * n_i, at_o = 0.5 * d * n_o;  // from the ball's centre
  // Relative to the cage: rings (omega_i - omega_c) x and -omega_c x, ball -omega_b axis. Unknown omega_c, omega_b.
  const auto t = [](const Vector3d& v) { return v[2]; };
  Eigen::Matrix2d A;
  Eigen::Vector2d b;
  A << -t(x.cross(centre + at_i)), t(axis.cross(at_i)), -t(x.cross(centre + at_o)), t(axis.cross(at_o));
  b << -omega_i * t(x.cross(centre + at_i)), 0.;
  const Eigen::Vector2d solution = A.colPivHouseholderQr().solve(b);
  const double omega_c = solution[0], omega_b = solution[1];
  const Vector3d ball = -omega_b * axis;
  return {omega_c, omega_b, {((omega_i - omega_c) * x - ball).dot(n_i), -(-omega_c * x - ball).dot(n_o)}};
}

TEST(BallKinematics, CageAndBallRollWithoutSlip) {
  for (const double phi : {0., 15. * deg, 25. * deg, 40. * deg}) {
    const double d = 9.525e-3, d_m = 85e-3;
    const auto expected = rolling(1., phi, phi, phi, d, d_m);  // axis square to the contacts' normal
    EXPECT_NEAR(cage_speed_ratio(d, d_m, phi), expected.omega_c, 1e-14);
    EXPECT_NEAR(ball_spin_ratio(d, d_m, phi), expected.omega_b, 1e-13);
  }
}

TEST(BallKinematics, CageOfADeepGrooveBearingTurnsAtTheMeanOfTheRaceSpeeds) {
  // Speed of a ball's centre is half the speed of the inner race: omega_c d_m/2 = omega_i (d_m - d)/4. TB1: (90 - 11.906)/180.
  EXPECT_NEAR(cage_speed_ratio(11.906e-3, 90e-3, 0.), 78.094 / 180., 1e-14);
  EXPECT_NEAR(cage_speed_ratio(9.525e-3, 85e-3, 90. * deg), 0.5, 1e-14)
      << "a thrust bearing's cage turns at half speed";
}

TEST(BallKinematics, SpinsAgreeWithRollingInSpace) {
  for (const double theta : {0., 5. * deg, 20. * deg, -10. * deg})
    for (const double phi_i : {18. * deg, 25. * deg, 33. * deg})
      for (const double phi_o : {12. * deg, 25. * deg}) {
        const double omega_i = 1591.74, d = 9.525e-3, d_m = 85e-3;
        const auto expected = rolling(omega_i, phi_i, phi_o, theta, d, d_m).spin;
        const auto spin = spin_speeds(omega_i, phi_i, phi_o, theta, d, d_m);
        EXPECT_NEAR(spin.inner, expected.inner, 1e-9 * omega_i);
        EXPECT_NEAR(spin.outer, expected.outer, 1e-9 * omega_i);
      }
}

TEST(BallKinematics, SpinsAddUpToTheRingsSpeedAlongTheNormalWhateverThePitch) {
  for (const double phi : {5. * deg, 15. * deg, 25. * deg, 40. * deg})
    for (double theta = -40. * deg; theta < 45. * deg; theta += 7. * deg) {
      const auto spin = spin_speeds(1591.74, phi, phi, theta, 9.525e-3, 85e-3);
      EXPECT_NEAR(spin.inner + spin.outer, 1591.74 * std::sin(phi), 1e-9) << "rad/s";
    }
}

TEST(BallKinematics, OuterRaceControlLeavesNoSpinOutside) {
  for (const double phi : {0., 5. * deg, 15. * deg, 25. * deg, 40. * deg}) {
    const double theta = pitch_angle_outer_race_control(phi, 9.525e-3, 85e-3);
    const auto spin = spin_speeds(1591.74, phi, phi, theta, 9.525e-3, 85e-3);
    EXPECT_NEAR(spin.outer, 0., 1e-9) << "rad/s";
    EXPECT_NEAR(spin.inner, 1591.74 * std::sin(phi), 1e-9) << "rad/s: all of it inside";
  }
}

}  // namespace
}  // namespace rotordrop
