// Contact of rotor and bore: Hunt-Crossley normal force and regularised Coulomb friction.
//
// RESTITUTION. A mass m meets F = K delta^n (1 + c v), v = delta', c = 1.5 lambda, with speed v_0. From m v dv = -F d(delta):
//   m v dv / (1 + c v) = -K delta^n d(delta).
// Indentation and rebound pass the same delta, so with G(v) = int v/(1 + c v) dv = v/c - ln(1 + c v)/c^2 the speeds at delta = 0 obey
//   G(v_0) = G(-e v_0),
// whatever K, n and m. Expanded in c v_0: e = 1 - x + x^2 - ..., x = (2/3) c v_0 = lambda v_0.
//
// COULOMB, regularised: mu(v) = mu v / sqrt(v^2 + v_reg^2): odd, mu / sqrt(2) at v_reg, slope mu / v_reg at rest, and
// 1 - (v_reg / v)^2 / 2 of mu far from it.
#include "laws/contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace rotordrop {
namespace {

/// Restitution of one impact of a mass: classical Runge-Kutta with the step cut to end on delta = 0.
double restitution(const HuntCrossley& law, double mass, double speed) {
  const double omega = std::sqrt(law.K * std::pow(speed * std::sqrt(mass / law.K), law.n - 1.) / mass);
  const double h = 1e-3 / omega;
  double x = 0., v = speed;
  const auto acceleration = [&](double position, double rate) {
    return -law.total(law.elastic(position), rate) / mass;
  };
  const auto step = [&](double dt, double& x1, double& v1) {
    const double a1 = acceleration(x, v), v2 = v + 0.5 * dt * a1, a2 = acceleration(x + 0.5 * dt * v, v2);
    const double v3 = v + 0.5 * dt * a2, a3 = acceleration(x + 0.5 * dt * v2, v3), v4 = v + dt * a3;
    const double a4 = acceleration(x + dt * v3, v4);
    x1 = x + dt / 6. * (v + 2. * v2 + 2. * v3 + v4);
    v1 = v + dt / 6. * (a1 + 2. * a2 + 2. * a3 + a4);
  };
  for (int i = 0; i < 1000000; ++i) {
    double x1 = 0., v1 = 0.;
    step(h, x1, v1);
    if (x1 <= 0.) return -v1 / speed;  // the force is nearly zero here: the speed no longer changes
    x = x1;
    v = v1;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double exact_restitution(double lambda, double speed) {
  const double c = 1.5 * lambda;
  const auto G = [&](double v) { return v / c - std::log1p(c * v) / (c * c); };
  double low = 0., high = std::min(1., 1. / (c * speed));
  for (int i = 0; i < 200; ++i) {
    const double e = 0.5 * (low + high);
    (G(-e * speed) < G(speed) ? low : high) = e;
  }
  return 0.5 * (low + high);
}

TEST(HuntCrossley, LosesLambdaTimesSpeedOfTheReboundWhenImpactsAreSlow) {
  const double lambda = 0.08;
  for (const double speed : {0.01, 0.07, 0.5}) {
    const double e = restitution({1.144e9, 10. / 9., lambda}, 55., speed);
    const double order = lambda * speed;
    // The next terms of the expansion are order^2 and less than 2 order^3; 2e-8 is the step's error.
    EXPECT_NEAR(e, 1. - order + order * order, 2. * order * order * order + 2e-8) << "at " << speed << " m/s";
  }
}

TEST(HuntCrossley, RestitutionDoesNotDependOnStiffnessExponentOrMass) {
  for (const double lambda : {0.08, 0.32})
    for (const double speed : {0.07, 2.}) {
      const double expected = exact_restitution(lambda, speed);
      for (const HuntCrossley law :
           {HuntCrossley{1.144e9, 10. / 9., lambda}, HuntCrossley{2e7, 1., lambda}, HuntCrossley{1e10, 1.5, lambda}})
        for (const double mass : {0.2, 55.})
          EXPECT_NEAR(restitution(law, mass, speed), expected, 3e-6) << "the integration's error";
    }
}

TEST(HuntCrossley, NeverPullsASeparatingRotorBack) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> depth(-1e-4, 1e-4), rate(-100., 100.);
  const HuntCrossley law{1.144e9, 10. / 9., 0.08};
  bool clamped = false;
  for (int i = 0; i < 10000; ++i) {
    const double delta = depth(random), v = rate(random), F = law.total(law.elastic(delta), v);
    ASSERT_GE(F, 0.) << "at delta = " << delta << " m, rate " << v << " m/s";
    if (delta <= 0.) {
      ASSERT_EQ(F, 0.);
    }
    clamped |= delta > 0. && F == 0.;
  }
  EXPECT_TRUE(clamped) << "the states include some beyond 1/(1.5 lambda) = 8.3 m/s";
}

TEST(HuntCrossley, LetsANumberThatIsNoneThrough) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const HuntCrossley law{1.144e9, 10. / 9., 0.08};
  EXPECT_TRUE(std::isnan(law.total(nan, 0.1)));
  EXPECT_TRUE(std::isnan(law.total(1000., nan)));
}

TEST(HuntCrossley, ForceIsTheSlopeOfItsEnergy) {
  const HuntCrossley law{1.73e9, 10. / 9., 0.08};
  for (const double delta : {1e-6, 1e-5, 5e-5}) {
    const double h = 1e-3 * delta;
    const double slope = (8. * (law.energy(delta + h) - law.energy(delta - h)) - law.energy(delta + 2. * h) +
                          law.energy(delta - 2. * h)) /
                         (12. * h);
    EXPECT_NEAR(slope / law.elastic(delta), 1., 1e-10);
  }
  EXPECT_EQ(law.energy(-1e-5), 0.);
  EXPECT_EQ(law.elastic(-1e-5), 0.);
}

TEST(HuntCrossley, FollowsThePublishedForceByHand) {
  // delta = 1e-5 m = 10^-5: delta^(10/9) = 10^(-50/9) = 10^-5.5555... = 2.78256e-6.
  EXPECT_NEAR((HuntCrossley{1.144e9, 10. / 9., 0.08}.elastic(1e-5)), 1.144e9 * 2.782559e-6, 1e-3) << "N";
  // 0.5 m/s adds 1.5 * 0.08 * 0.5 = 6 %.
  EXPECT_NEAR((HuntCrossley{1.144e9, 10. / 9., 0.08}.total(1000., 0.5)), 1060., 1e-9) << "N";
  EXPECT_NEAR((HuntCrossley{1.144e9, 10. / 9., 0.08}.total(1000., -0.5)), 940., 1e-9) << "N";
}

TEST(CoulombFriction, HasItsLimitsAtRestAndAtSpeed) {
  const CoulombFriction law{0.1, 0.05, 0., 1., false};
  EXPECT_EQ(law.coefficient(0.), 0.);
  EXPECT_NEAR(law.coefficient(0.05), 0.1 / std::sqrt(2.), 1e-15);
  // It falls short of the slope at rest by (v / v_reg)^2 / 2 = 2e-10 of it.
  EXPECT_NEAR(law.coefficient(1e-6) / 1e-6, 0.1 / 0.05, 1e-9);
  for (const double v : {1., 10., 55.}) {
    // The next term is 3/8 (v_reg / v)^4.
    EXPECT_NEAR(law.coefficient(v), 0.1 * (1. - 0.5 * (0.05 / v) * (0.05 / v)), 0.1 * std::pow(0.05 / v, 4));
    EXPECT_EQ(law.coefficient(-v), -law.coefficient(v));
  }
}

TEST(CoulombFriction, TurnsHeatOutNeverIn) {
  for (const bool stribeck : {false, true}) {
    const CoulombFriction law{0.1, 0.05, 0.05, 0.5, stribeck};
    for (double v = -60.; v <= 60.; v += 0.37) EXPECT_GE(law.coefficient(v) * v, 0.);
  }
}

TEST(CoulombFriction, FollowsItsTablesOverSpeedAndTemperature) {
  CoulombFriction law{0.3, 1e-9, 0.16, 0.5, false, true};  // sharp, to see the coefficient alone
  law.over_speed = {{1., 0.2}, {11., 0.1}, {51., 0.06}};
  for (const auto& [v, mu] :
       {std::pair{0.5, 0.2}, {1., 0.2}, {6., 0.15}, {11., 0.1}, {31., 0.08}, {51., 0.06}, {80., 0.06}}) {
    EXPECT_NEAR(law.coefficient(v), mu, 1e-14) << v;
    EXPECT_EQ(law.coefficient(-v), -law.coefficient(v));
  }
  law.over_temperature = {{300., 1.}, {400., 0.5}};
  EXPECT_NEAR(law.per_speed(36., 350.) * 6., 0.15 * 0.75, 1e-14);
  EXPECT_NEAR(law.per_speed(36., 200.) * 6., 0.15, 1e-14);
  EXPECT_NEAR(law.largest(36., 350.), 0.15 * 0.75, 1e-15);
  EXPECT_EQ(law.largest(0., 400.), 0.1) << "at rest too: what a sticking contact holds";
  law.over_speed.clear();
  EXPECT_NEAR(law.per_speed(36., 500.) * 6., 0.3 * 0.5, 1e-14) << "a factor on friction_coefficient";
}

TEST(CoulombFriction, StribeckLeadsFromStaticToDynamic) {
  const CoulombFriction law{0.1, 1e-9, 0.16, 0.5, true};  // sharp, to see the coefficient alone
  EXPECT_NEAR(law.coefficient(1e-4), 0.16, 1e-8);
  EXPECT_NEAR(law.coefficient(0.5), 0.1 + 0.06 * std::exp(-1.), 1e-12);
  EXPECT_NEAR(law.coefficient(5.), 0.1, 1e-12);
}

}  // namespace
}  // namespace rotordrop
