// A cage of its own speed: power balance, rolling as the limit, and the closed form of a start with full slip.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "laws/free_cage.h"

namespace rotordrop {
namespace {

/// 6014 with ceramic balls.
FreeCage cage() {
  FreeCage c;
  c.n_balls = 14;
  c.ball_diameter = 11.906e-3;
  c.ball_mass = 3200. * M_PI / 6. * std::pow(c.ball_diameter, 3);
  c.pitch_radius = 45e-3;
  c.gamma = c.ball_diameter / (2. * c.pitch_radius);
  c.inertia = 1e-5;
  c.traction = 0.07;
  c.slip = 0.5;
  c.pocket_friction = 0.1;
  return c;
}

TEST(FreeCage, FindsEveryWattOfItsPowerBalance) {
  const FreeCage c = cage();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> one(-1, 1);
  for (int i = 0; i < 200; ++i) {
    CageDrive in{1500 * one(random), 700 * one(random), 6000 * one(random), 2000 * (1 + one(random)), 900,
                 0.3 * one(random)};
    const CageMotion m = cage_motion(c, in);
    const double kinetic =
        c.orbit_inertia() * in.cage_speed * m.cage_acceleration + c.spin_inertia() * in.ball_spin * m.ball_acceleration;
    const double heat = m.inner_heat + m.outer_heat + m.pocket_heat, from_ring = -m.ring_torque * in.ring_speed,
                 from_contacts = in.contact_torque * in.cage_speed;
    const double scale = std::fabs(kinetic) + heat + std::fabs(from_ring);
    EXPECT_NEAR(kinetic + heat, from_ring + from_contacts, 1e-13 * scale) << "W";
    EXPECT_GE(m.inner_heat, 0.);
    EXPECT_GE(m.outer_heat, 0.);
    EXPECT_GE(m.pocket_heat, 0.);
  }
}

TEST(FreeCage, RollingBallsNeitherSlipNorTakePower) {
  const FreeCage c = cage();
  const double ring = 1200., orbit = 0.5 * (1. - c.gamma) * ring, spin = 2. * c.pitch_radius * orbit / c.ball_diameter;
  const CageMotion m = cage_motion(c, {ring, orbit, spin, 3000, 900, 0.});
  EXPECT_NEAR(m.inner_slip, 0., 1e-12) << "m/s";
  EXPECT_NEAR(m.outer_slip, 0., 1e-12) << "m/s";
  EXPECT_NEAR(m.ring_torque, 0., 1e-9) << "N m";
  // Their kinetic energy is what they add to the ring's inertia.
  EXPECT_NEAR(c.energy(orbit, spin), 0.5 * c.rolling_inertia() * ring * ring, 1e-12);
}

/// Under a ring that turns fast above balls at rest the inner race slips with T_i = mu Q, the outer one rolls: T_o = 0.3/0.7 T_i (skidding.h) without cage.
TEST(FreeCage, StartsWithFullSlipAsInClosedForm) {
  FreeCage c = cage();
  c.inertia = 0.;
  c.pocket_friction = 0.;
  c.slip = 1e-3;
  const double Q = 500., end = 5e-3, step = 2e-8;
  double orbit = 0., spin = 0.;
  for (double t = 0.; t < end - 0.5 * step;
       t += step) {  // centrifugal forces enter the outer traction, which only has to be enough
    const CageMotion m = cage_motion(c, {3000., orbit, spin, Q, Q / 14., 0.});
    orbit += step * m.cage_acceleration;
    spin += step * m.ball_acceleration;
  }
  const double expected = c.traction * Q / 0.7 / (c.n_balls * c.ball_mass * c.pitch_radius) * end;
  EXPECT_NEAR(orbit, expected, 1e-3 * expected)
      << "rad/s; the outer race slips by 1e-3 m/s of 5 m/s to hold its traction";
}

TEST(FreeCage, PocketsOnlyRubWhereLoadedBallsCarryOthers) {
  const FreeCage c = cage();
  EXPECT_EQ(cage_motion(c, {1000., 100., 500., 1400., 100., 0.}).pocket_heat, 0.) << "all balls loaded alike";
  EXPECT_GT(cage_motion(c, {1000., 100., 500., 100., 100., 0.}).pocket_heat, 0.) << "one ball carries";
}

}  // namespace
}  // namespace rotordrop
