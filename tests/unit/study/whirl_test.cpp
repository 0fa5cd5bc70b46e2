// Orbits whose whirl is known by construction.
//
// A point on a circle of radius r with speed W sweeps W r^2 dt twice over, whatever r: the speed is W at each sample and a turn takes 2 pi / W.
// A rotor that bounces along the chords of a regular polygon and touches at its corners only has no arc of contact; its angle still goes around.
// Friction that sustains a whirl, by the equations of a mass m on a rigid circle of radius c with a spring k and a damper b to the centre, spin
// against the whirl: inward m c W^2 = N + k c, along the path m c W' = mu N - b c W. So W' > 0 where b W < mu (m W^2 - k): with w^2 = k/m and
// zeta = b/(2 m w) beyond W = w (zeta/mu + sqrt((zeta/mu)^2 + 1)).
// Loop the loop: without friction u = c a'^2 / g = u_0 - 2 (1 - cos a), and u + cos a > 0 at the top asks for u_0 > 5.
#include "study/drop/whirl.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

namespace rotordrop {
namespace {

constexpr double pi = std::numbers::pi;

struct Path {
  std::vector<double> time, y, z, penetration, spin;
  void add(double t, double y_now, double z_now, bool touches, double spin_now = 1600.) {
    time.push_back(t);
    y.push_back(y_now);
    z.push_back(z_now);
    penetration.push_back(touches ? 1e-6 : -1e-6);
    spin.push_back(spin_now);
  }
  [[nodiscard]] ContactWhirl whirl() const { return find_whirl({time, y, z, penetration, spin}); }
};

/// [0, 0.1 s] every 50 us, on a circle with speed W.
Path circle(double speed, double spin = 1600.) {
  Path path;
  for (int k = 0; k <= 2000; ++k) {
    const double t = k * 50e-6;
    path.add(t, 250e-6 * std::cos(speed * t), 250e-6 * std::sin(speed * t), true, spin);
  }
  return path;
}

TEST(Whirl, OfACircleWithTheSpinIsForward) {
  const ContactWhirl w = circle(2. * pi * 80.).whirl();
  ASSERT_EQ(w.stretches.size(), 1u);
  EXPECT_EQ(w.longest()->direction, WhirlDirection::forward);
  EXPECT_NEAR(w.longest()->frequency(), 80., 1e-9) << "Hz";
  EXPECT_NEAR(w.longest()->turns, 8., 1e-9);
  EXPECT_NEAR(w.forward_time, 0.1, 1e-12) << "s";
  EXPECT_EQ(w.backward_time, 0.);
  EXPECT_EQ(w.fastest_backward(), nullptr);
  EXPECT_FALSE(w.has_full_backward_rub());
  // roundoff of the swept areas, whose differences are taken
  for (const double speed : w.speed) EXPECT_NEAR(speed, 2. * pi * 80., 1e-9);
}

TEST(Whirl, OfACircleAgainstTheSpinIsABackwardFullRub) {
  const ContactWhirl w = circle(-2. * pi * 80.).whirl();
  ASSERT_EQ(w.stretches.size(), 1u);
  EXPECT_EQ(w.longest()->direction, WhirlDirection::backward);
  EXPECT_NEAR(w.fastest_backward()->fastest, 2. * pi * 80., 1e-6) << "rad/s";
  EXPECT_NEAR(w.backward_whirl_time, 0.1, 1e-12) << "s";
  EXPECT_TRUE(w.has_full_backward_rub());
}

TEST(Whirl, DirectionIsThatRelativeToTheSpin) {
  EXPECT_EQ(circle(500., -1600.).whirl().longest()->direction, WhirlDirection::backward);
  EXPECT_EQ(circle(-500., -1600.).whirl().longest()->direction, WhirlDirection::forward);
  EXPECT_EQ(circle(500., 0.).whirl().longest(), nullptr) << "a rotor that does not spin has neither";
}

TEST(Whirl, FastestTurnOfAnAcceleratingRubIsItsLast) {
  // angle = -b t^2: the last turn of 0.1 s began where b (0.01 - t^2) = 2 pi.
  Path path;
  const double b = 4e3;  // 6.4 turns
  for (int k = 0; k <= 20000; ++k) {
    const double t = k * 5e-6;
    path.add(t, 250e-6 * std::cos(b * t * t), -250e-6 * std::sin(b * t * t), true);
  }
  const double begin = std::sqrt(0.01 - 2. * pi / b);
  const double expected = 2. * pi / (0.1 - begin);
  // The turn that ends with the last sample begins between two: up to 5 us of 8 ms.
  EXPECT_NEAR(path.whirl().fastest_backward()->fastest, expected, 1e-3 * expected);
}

TEST(Whirl, OfHopsBetweenPointsThatStandStillIsNone) {
  // Corners of a square against the spin, each touched for 0.2 ms after a chord of 1.8 ms: a turn takes 8 ms.
  Path path;
  for (int k = 0; k <= 2000; ++k) {
    const double t = k * 50e-6;
    const int corner = k / 40;
    const double along = std::max(0, k % 40 - 4) / 36.;
    const auto y = [&](int c) { return 250e-6 * std::cos(-0.5 * pi * c); };
    const auto z = [&](int c) { return 250e-6 * std::sin(-0.5 * pi * c); };
    path.add(t, y(corner) + along * (y(corner + 1) - y(corner)), z(corner) + along * (z(corner + 1) - z(corner)),
             k % 40 <= 4);
  }
  const ContactWhirl w = path.whirl();
  // While it touches, it stands still: no rub moves the point of contact.
  EXPECT_EQ(w.backward_time, 0.);
  EXPECT_EQ(w.longest(), nullptr);
  EXPECT_NEAR(w.contact_time, 50. * 0.2e-3, 1e-9) << "s";
}

TEST(Whirl, LostContactForAMomentLeavesItSustainedAndEndsTheFullRub) {
  // A backward circle of 100 Hz that loses contact for 1 ms of every 5: two flights in each turn.
  Path path;
  for (int k = 0; k <= 2000; ++k) {
    const double t = k * 50e-6, a = -2. * pi * 100. * t;
    path.add(t, 250e-6 * std::cos(a), 250e-6 * std::sin(a), k % 100 >= 20);
  }
  const ContactWhirl w = path.whirl();
  ASSERT_EQ(w.stretches.size(), 1u);
  EXPECT_NEAR(w.fastest_backward()->fastest, 2. * pi * 100., 1e-6) << "rad/s";
  EXPECT_FALSE(w.has_full_backward_rub());
  EXPECT_NEAR(w.backward_whirl_time, w.contact_time, 1e-12) << "s";
}

TEST(Whirl, LongFlightsBreakIt) {
  // Half a turn in contact, then 6 ms of flight: longer than the window.
  Path path;
  for (int k = 0; k <= 2000; ++k) {
    const double t = k * 50e-6, a = -2. * pi * 100. * t;
    path.add(t, 250e-6 * std::cos(a), 250e-6 * std::sin(a), k % 220 >= 120);
  }
  EXPECT_TRUE(path.whirl().stretches.empty());
}

TEST(Whirl, BeginsAndEndsInContactThoughTheWindowSeesItFromTheFlight) {
  // Goes around at the bore's radius all the time, and touches it from 20 to 80 ms only.
  Path path;
  for (int k = 0; k <= 2000; ++k) {
    const double t = k * 50e-6, a = -2. * pi * 100. * t;
    path.add(t, 250e-6 * std::cos(a), 250e-6 * std::sin(a), k >= 400 && k <= 1600);
  }
  const ContactWhirl w = path.whirl();
  ASSERT_EQ(w.stretches.size(), 1u);
  EXPECT_NEAR(w.longest()->start, 20e-3, 1e-12) << "s, first contact; the window of 5 ms sees it from 17.5 ms on";
  EXPECT_NEAR(w.longest()->end, 80e-3, 1e-12) << "s, last contact";
  EXPECT_NEAR(w.longest()->turns, 6., 1e-9);
  EXPECT_NEAR(w.longest()->frequency(), 100., 1e-6) << "Hz";
}

TEST(Whirl, SwingingAtTheBottomIsNone) {
  // 31.5 Hz, 40 degrees each way.
  Path path;
  for (int k = 0; k <= 2000; ++k) {
    const double t = k * 50e-6, a = pi + 0.7 * std::sin(2. * pi * 31.5 * t);
    path.add(t, 250e-6 * std::cos(a), 250e-6 * std::sin(a), true);
  }
  const ContactWhirl w = path.whirl();
  EXPECT_TRUE(w.stretches.empty());
  EXPECT_NEAR(w.backward_time, 0.05, 0.005) << "s, half the time but for what counts as rest";
  EXPECT_EQ(w.backward_whirl_time, 0.);
}

TEST(Whirl, AtRestIsNone) {
  Path path;
  for (int k = 0; k <= 2000; ++k) path.add(k * 50e-6, -250e-6, 1e-9 * std::sin(0.3 * k), true);
  const ContactWhirl w = path.whirl();
  EXPECT_TRUE(w.stretches.empty());
  EXPECT_EQ(w.backward_time, 0.);
  EXPECT_EQ(w.forward_time, 0.);
  EXPECT_NEAR(w.contact_time, 0.1, 1e-12) << "s";
}

TEST(Whirl, InFreeFallHasNoSpeed) {
  Path path;
  for (int k = 0; k <= 100; ++k) path.add(k * 50e-6, -9.81 / 2. * std::pow(k * 50e-6, 2), 0., false);
  const ContactWhirl w = path.whirl();
  EXPECT_EQ(w.contact_time, 0.);
  for (const double speed : w.speed) EXPECT_TRUE(std::isnan(speed));
}

TEST(Whirl, OfNoSamplesIsNone) {
  EXPECT_TRUE(Path{}.whirl().stretches.empty());
  const std::vector<double> one(1, 0.), two(2, 0.);
  EXPECT_THROW((void)find_whirl({two, two, one, two, two}), std::invalid_argument);
}

TEST(FullRub, WithoutFrictionIsTheLoopTheLoop) {
  EXPECT_NEAR(full_rub_speed(0., 250e-6, 9.81), std::sqrt(5. * 9.81 / 250e-6), 1e-6) << "rad/s";
}

TEST(FullRub, NeedsLessSpeedWithMoreFrictionAndNoneBeyondItsThreshold) {
  const double threshold = full_rub_friction();
  double last = full_rub_speed(0., 250e-6, 9.81);
  for (double mu = 0.05; mu < threshold; mu += 0.05) {
    const double speed = full_rub_speed(mu, 250e-6, 9.81);
    EXPECT_LT(speed, last) << mu;
    last = speed;
  }
  EXPECT_GT(full_rub_speed(threshold - 1e-6, 250e-6, 9.81), 0.);
  EXPECT_EQ(full_rub_speed(threshold + 1e-6, 250e-6, 9.81), 0.);
}

/// The same motion step by step: c a'' = mu N / m - g sin a, Runge-Kutta of order 4 in a.
bool goes_around(double mu, double u_0) {
  const auto slope = [mu](double a, double u) { return 2. * mu * u + 2. * (mu * std::cos(a) - std::sin(a)); };
  double u = u_0;
  const int n = 20000;
  const double h = 2. * pi / n;
  for (int i = 0; i < n; ++i) {
    const double a = i * h;
    const double k_1 = slope(a, u), k_2 = slope(a + h / 2., u + h / 2. * k_1),
                 k_3 = slope(a + h / 2., u + h / 2. * k_2), k_4 = slope(a + h, u + h * k_3);
    u += h / 6. * (k_1 + 2. * k_2 + 2. * k_3 + k_4);
    if (u < 0. || u + std::cos(a + h) <= 0.) return false;
  }
  return true;
}

TEST(FullRub, IsThatOfTheMotionItself) {
  for (const double mu : {0.05, 0.1, 0.3, 0.5}) {
    const double u_0 = std::pow(full_rub_speed(mu, 250e-6, 9.81), 2) * 250e-6 / 9.81;
    EXPECT_TRUE(goes_around(mu, u_0 * 1.001)) << mu;
    EXPECT_FALSE(goes_around(mu, u_0 * 0.999)) << mu;
  }
  EXPECT_TRUE(goes_around(full_rub_friction() * 1.001, 0.));
  EXPECT_FALSE(goes_around(full_rub_friction() * 0.999, 0.));
}

using Complex = std::complex<double>;
constexpr double no_friction_does = std::numeric_limits<double>::infinity();

/// Mass, spring and damper to ground: displacement over a force that turns with W.
Complex receptance(double mass, double stiffness, double damping, double W) {
  return 1. / Complex(stiffness - mass * W * W, damping * W);
}

TEST(SustainedWhirl, OfAFreeRotorOnARigidStatorNeedsNoFriction) {
  for (const double W : {-3000., -300., -10.}) EXPECT_EQ(friction_that_sustains_whirl(-1. / (55. * W * W)), 0.) << W;
}

TEST(SustainedWhirl, OfAJeffcottRotorBeginsAtItsClosedForm) {
  const double m = 55., k = 5e7, w = std::sqrt(k / m), mu = 0.1;
  for (const double zeta : {0.005, 0.05, 0.2}) {
    const double b = 2. * zeta * m * w;
    const double begin = w * (zeta / mu + std::sqrt(std::pow(zeta / mu, 2) + 1.));
    EXPECT_NEAR(friction_that_sustains_whirl(receptance(m, k, b, -begin)), mu, 1e-12) << zeta;
    EXPECT_LT(friction_that_sustains_whirl(receptance(m, k, b, -1.001 * begin)), mu) << zeta;
    EXPECT_GT(friction_that_sustains_whirl(receptance(m, k, b, -0.999 * begin)), mu) << zeta;
    // Below its natural frequency the rotor's spring takes it off the bore: no friction holds it there.
    EXPECT_EQ(friction_that_sustains_whirl(receptance(m, k, b, -0.99 * w)), no_friction_does) << zeta;
  }
}

TEST(SustainedWhirl, EndsAtTheNaturalFrequencyOfRotorAndStatorTogether) {
  // A stator without mass on a spring: above sqrt((k + k_s)/m) both would part. With damping it ends a little before.
  const double m = 55., k = 5e7, k_s = 2e8, end = std::sqrt((k + k_s) / m);
  const auto both = [&](double W, double b) { return receptance(m, k, b, W) + 1. / k_s; };
  EXPECT_EQ(friction_that_sustains_whirl(both(-0.9999 * end, 0.)), 0.);
  EXPECT_EQ(friction_that_sustains_whirl(both(-1.0001 * end, 0.)), no_friction_does);
  // Damped: with x = m W^2 - k and y = b W the condition is |y| + mu (x^2 + y^2)/k_s <= mu x.
  const double b = 2e3, mu = 0.1;
  const auto margin = [&](double W) {
    const double x = m * W * W - k, y = b * W;
    return mu * x - std::fabs(y) - mu * (x * x + y * y) / k_s;
  };
  for (double W = -1.2 * end; W < -100.; W += 13.7)
    EXPECT_EQ(friction_that_sustains_whirl(both(W, b)) <= mu, margin(W) >= 0.) << W;
}

/// Whirl speed after 0.2 s of the mass on its rigid circle (top of this file), by Runge-Kutta of order 4; 0 if it leaves the bore.
double whirl_after(double W, double mu, double m, double k, double b) {
  const auto rate = [&](double v) { return mu * (v * v - k / m) - b / m * v; };
  const double h = 1e-5;
  for (int i = 0; i < 20000 && std::fabs(W) < 1e5; ++i) {
    if (m * W * W <= k) return 0.;
    const double k_1 = rate(W), k_2 = rate(W + h / 2. * k_1), k_3 = rate(W + h / 2. * k_2), k_4 = rate(W + h * k_3);
    W += h / 6. * (k_1 + 2. * k_2 + 2. * k_3 + k_4);
  }
  return W;
}

TEST(SustainedWhirl, GrowsWhereLessFrictionWouldDoAndDecaysWhereMoreIsNeeded) {
  const double m = 55., k = 5e7, w = std::sqrt(k / m), mu = 0.1;
  for (const double zeta : {0.005, 0.05, 0.2}) {
    const double b = 2. * zeta * m * w;
    for (double W = 1.02 * w; W < 6. * w; W *= 1.1) {
      const bool is_sustained = friction_that_sustains_whirl(receptance(m, k, b, -W)) < mu;
      EXPECT_EQ(whirl_after(W, mu, m, k, b) > W, is_sustained) << W / w << " at zeta " << zeta;
    }
  }
}

}  // namespace
}  // namespace rotordrop
