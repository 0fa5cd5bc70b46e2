// Friction with sticking, on one body and one contact.
//
// AT REST below 0.8 mu N the bristle is a spring: a body m under the force F swings between 0 and 2 F/k and comes to rest at F/k, by the damping k/kappa.
// SLIDING the force is mu N along the slip, as in the regularised law at speeds far above its v_reg: from the first instant on where slip is fast, and never more.
// YIELDING begins at 0.8 z_max and is half done half way to z_max. In sliding it asks an integrator for no shorter steps than a bristle in the air does.
// PASSIVE: work on the bristle never falls short of what it stores.
#include "laws/sticking.h"

#include <gtest/gtest.h>

#include <random>

#include "laws/contact.h"

namespace rotordrop {
namespace {

const StickingFriction law{1e8, 2e-3};

/// A body on a contact, stepped by the classical Runge-Kutta method.
struct Body {
  double mass, limit, through = 0.;
  double x = 0, v = 0, z = 0, work = 0, heat = 0;

  struct Rates {
    double x, v, z, heat;
  };
  [[nodiscard]] Rates rates(double v_now, double z_now, double force) const {
    const auto r = law.evaluate({0., z_now}, {0., v_now}, limit, through);
    return {v_now, (force - r.force.x) / mass, r.bristle_rate.x, r.force.x * v_now - r.stored_rate};
  }
  void step(double h, double force) {
    const auto a = rates(v, z, force), b = rates(v + 0.5 * h * a.v, z + 0.5 * h * a.z, force),
               c = rates(v + 0.5 * h * b.v, z + 0.5 * h * b.z, force), d = rates(v + h * c.v, z + h * c.z, force);
    const double travel = h / 6. * (a.x + 2. * b.x + 2. * c.x + d.x);
    x += travel;
    work += force * travel;
    v += h / 6. * (a.v + 2. * b.v + 2. * c.v + d.v);
    z += h / 6. * (a.z + 2. * b.z + 2. * c.z + d.z);
    heat += h / 6. * (a.heat + 2. * b.heat + 2. * c.heat + d.heat);
  }
};

TEST(StickingFriction, HoldsAForceForASecondWithinAFractionOfAMicrometre) {
  // Of 10 kg, whose swing the damping takes within the second (rate k / (2 kappa m) = 50 1/s).
  Body body{10., 107.};
  double largest = 0., halfway = 0.;
  for (int i = 0; i < 250000; ++i) {
    body.step(4e-6, 20.);
    largest = std::max(largest, body.x);
    if (i == 125000) halfway = body.x;
  }
  EXPECT_LT(largest, 2. * 20. / law.stiffness * (1. + 1e-6)) << "m";
  EXPECT_NEAR(body.x, 20. / law.stiffness, 1e-11) << "m; the first swing yields by (v / kappa z_max)^2 / 2, 2e-5 of it";
  EXPECT_NEAR(body.x, halfway, 2e-12) << "m: no drift; half way exp(-25) of the swing is left";
  EXPECT_NEAR(body.work, 0.5 * body.mass * body.v * body.v + law.energy({0., body.z}) + body.heat, 1e-9 * body.work)
      << "J";
  // The regularised law creeps with v_reg F/L / sqrt(1 - (F/L)^2) = 9.5 mm/s instead.
  const CoulombFriction regularised{0.1, 0.05};
  const double share = 20. / 107., creep = 0.05 * share / std::sqrt(1. - share * share);
  EXPECT_NEAR(regularised.coefficient(creep) / 0.1, share, 1e-12);
  EXPECT_GT(creep * 0.2, 1e-3) << "m in 0.2 s";
}

TEST(StickingFriction, LetsGoBeyondItsLimitAndThenSlidesLikeCoulomb) {
  Body body{10., 50.};
  for (int i = 0; i < 20000; ++i) body.step(5e-6, 60.);
  const double v = body.v;
  for (int i = 0; i < 20000; ++i) body.step(5e-6, 60.);
  EXPECT_NEAR((body.v - v) / 0.1, (60. - 50.) / 10., 1e-6) << "m/s^2";
  EXPECT_NEAR(body.work, 0.5 * body.mass * body.v * body.v + law.energy({0., body.z}) + body.heat, 1e-8 * body.work)
      << "J";
}

TEST(StickingFriction, SlidesWithTheForceOfTheRegularisedLaw) {
  const CoulombFriction regularised{0.1, 0.05};
  for (const double speed : {5., 50.})
    for (const double through : {0., 55.}) {
      StickingFriction::Vector z;
      for (int i = 0; i < 20000; ++i) {
        const auto r = law.evaluate(z, {speed, 0.5 * speed}, 0.1 * 500., through);
        z.t += 1e-6 * r.bristle_rate.t;
        z.x += 1e-6 * r.bristle_rate.x;
      }
      const auto r = law.evaluate(z, {speed, 0.5 * speed}, 0.1 * 500., through);
      const double slip = speed * std::sqrt(1.25);
      // (v_reg / v)^2 / 2 is what the regularised law lacks.
      const double expected = regularised.coefficient(slip) * 500.;
      EXPECT_NEAR(std::hypot(r.force.t, r.force.x) / expected, 1., 1e-4);
      EXPECT_NEAR(r.force.x / r.force.t, 0.5, 1e-6) << "along the slip";
    }
}

TEST(StickingFriction, GivesItsLimitThroughoutAnImpact) {
  // A contact of 25 us under a slip of 40 m/s: |w| = kappa z_max but for (kappa z_max / v)^2 / 2 = 8e-7 of it, while the bristle bends to z_max in some 10 us.
  const double duration = 25e-6, h = 1e-8;
  StickingFriction::Vector z;
  double impulse = 0., of_coulomb = 0.;
  for (double t = 0.5 * h; t < duration; t += h) {
    const double limit = 50. * std::sin(3.141592653589793 * t / duration);
    const auto r = law.evaluate(z, {32., 24.}, limit, 0.);
    z.t += h * r.bristle_rate.t;
    z.x += h * r.bristle_rate.x;
    EXPECT_LE(std::hypot(r.force.t, r.force.x), limit * (1. + 1e-12)) << "N, at " << t;
    EXPECT_NEAR(r.force.x, 0.75 * r.force.t, 1e-9 * limit) << "along the slip";
    impulse += h * std::hypot(r.force.t, r.force.x);
    of_coulomb += h * limit;
  }
  EXPECT_NEAR(impulse, of_coulomb, 2e-6 * of_coulomb) << "N s";
}

TEST(StickingFriction, IsNeverAboveItsLimit) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto wide = [&](double size) { return size * normal(random) * std::pow(10., 2. * normal(random)); };
  for (int i = 0; i < 200000; ++i) {
    const double limit = std::fabs(wide(50.));
    const auto r = law.evaluate({wide(1e-6), wide(1e-6)}, {wide(0.1), wide(0.1)}, limit, std::fabs(wide(1.)));
    ASSERT_LE(std::hypot(r.force.t, r.force.x), limit * (1. + 1e-9)) << "N";
  }
}

TEST(StickingFriction, YieldsByHalfHalfWayBetweenItsElasticLimitAndItsLargestForce) {
  const double z_max = 50. / law.stiffness, slow = 1e-6;
  const auto yielding = [&](double share) {
    return 1. - law.evaluate({0., share * z_max}, {0., slow}, 50., 0.).bristle_rate.x / slow;
  };
  // Slow slip is bending but for (v / kappa z_max)^2 / 2, 2e-10 of it.
  EXPECT_NEAR(yielding(0.8), 0., 1e-9);
  EXPECT_NEAR(yielding(0.85), 5. / 32., 1e-9) << "s = 1/4";
  EXPECT_NEAR(yielding(0.9), 0.5, 1e-9);
  EXPECT_NEAR(yielding(0.95), 27. / 32., 1e-9);
  EXPECT_NEAR(yielding(1.), 1., 1e-9);
}

TEST(StickingFriction, IsNoStifferInSlidingThanInTheAir) {
  // How fast a bristle comes back that is off its place by a share of it; in the air with kappa.
  const double z_max = 50. / law.stiffness;
  for (const double speed : {0.01, 1., 50.})
    for (const double off : {1e-4, 1e-3, 5e-3}) {
      const double below = law.evaluate({0., (1. - off) * z_max}, {0., speed}, 50., 0.).bristle_rate.x;
      const double above = law.evaluate({0., (1. + off) * z_max}, {0., speed}, 50., 0.).bristle_rate.x;
      EXPECT_GT(below, 0.) << "towards its place";
      EXPECT_LT(below / (off * z_max), StickingFriction::rate) << "1/s, " << speed << " m/s";
      EXPECT_NEAR(above / (off * z_max), -StickingFriction::rate, 1e-9 * StickingFriction::rate) << "1/s";
    }
}

TEST(StickingFriction, CreepsWhereSurfacesRollThroughTheContact) {
  // A bristle lives l/V and gives k z and the damping force (k / kappa) v: a force F below the elastic limit needs the slip v = z V/l.
  Body body{10., 500., 55.};
  for (int i = 0; i < 100000; ++i) body.step(4e-6, 20.);
  const double k = law.stiffness, per_time = 55. / 2e-3;
  EXPECT_NEAR(body.v / (20. * per_time / (k + k / StickingFriction::rate * per_time)), 1., 1e-4)
      << "m/s; yielding (v / kappa z_max)^2 / 2";
}

TEST(StickingFriction, NeverGivesMoreThanItGot) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const auto wide = [&](double size) { return size * normal(random) * std::pow(10., 2. * normal(random)); };
  for (int i = 0; i < 200000; ++i) {
    const StickingFriction::Vector z{wide(1e-6), wide(1e-6)}, v{wide(0.1), wide(0.1)};
    const auto r = law.evaluate(z, v, std::max(0., 50. + 100. * normal(random)), std::fabs(wide(1.)));
    const double work = r.force.t * v.t + r.force.x * v.x;
    const double scale = std::fabs(r.force.t * v.t) + std::fabs(r.force.x * v.x) + std::fabs(r.stored_rate);
    ASSERT_GE(work - r.stored_rate, -1e-12 * scale) << "W";
  }
}

TEST(StickingFriction, StraightensWithoutContactAndGivesNoForceThere) {
  StickingFriction::Vector z{1e-6, -2e-6};
  for (int i = 0; i < 4000; ++i) {
    const auto r = law.evaluate(z, {3., -1.}, 0., 55.);
    ASSERT_EQ(r.force.t, 0.);
    ASSERT_EQ(r.force.x, 0.);
    z.t += 1e-6 * r.bristle_rate.t;
    z.x += 1e-6 * r.bristle_rate.x;
  }
  EXPECT_LT(std::hypot(z.t, z.x), 1e-17) << "m";
  EXPECT_GT(std::hypot(z.t, z.x), 1e-19) << "m: far from denormal numbers";
}

}  // namespace
}  // namespace rotordrop
