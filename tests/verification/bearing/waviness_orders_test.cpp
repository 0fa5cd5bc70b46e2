// Wardle's orders: which waves of the inner race shake a bearing.
//
// A row of Z equal balls under a pure axial preload, ring undisplaced: every delta_j = delta_0 + A sin(m (b_j - theta_i) + p), b_j = b_0 + 2 pi j/Z.
// To first order in A the loads change by f sin(m (b_j - theta_i) + p), f = 1.5 K sqrt(delta_0) A, and
//   sum_j exp(i m b_j) = Z exp(i m b_0) if m = kZ, else 0.
// So the axial force, sin phi times the sum of loads, changes for m = kZ only, by Z f sin phi; the radial force, with another exp(-+ i b_j), for m = kZ +- 1 only,
// by (Z/2) f cos phi, as a vector of constant length. It turns m times per ring turn: with the ring for m = kZ + 1, against it for m = kZ - 1.
//
// Second order: A^2 (3/8) K delta_0^-0.5 sin^2 brings order 2m, a part A/(4 delta_0) of the first. The amplitude is 1e-7 delta_0, so what remains at
// other orders is below 1e-7 of what the right ones excite, and roundoff (1e-16 of the mean, whose change is 1e-7) below 1e-8.
#include <gtest/gtest.h>

#include <complex>

#include "test_bearings.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;
using Complex = std::complex<double>;

struct Response {
  double axial;               // amplitude of the axial force over a ring turn [N]
  double radial;              // largest radial force over a ring turn [N]
  Complex forward, backward;  // of F_y + i F_z: parts that turn +m and -m times per ring turn [N]
};

Response response(const BallRowGeometry& g, int order, double amplitude, double cage_angle, bool inner) {
  const BallRow row(g, {{inner, order, amplitude, 0.7}});
  constexpr int n = 720;
  Response r{};
  BallRowOutput undisturbed;
  BallRow(g, {}).evaluate({}, undisturbed);
  double largest_axial = 0.;
  for (int i = 0; i < n; ++i) {
    BallRowInput in;
    const double turn = 2. * pi * i / n;
    in.ring_angle = inner ? turn : 0.3;
    in.cage_angle = inner ? cage_angle : turn;
    in.cage_cosine = std::cos(in.cage_angle);
    in.cage_sine = std::sin(in.cage_angle);
    BallRowOutput out;
    row.evaluate(in, out);
    largest_axial = std::max(largest_axial, std::fabs(out.force_x - undisturbed.force_x));
    const Complex F(out.force_y, out.force_z);
    r.radial = std::max(r.radial, std::abs(F));
    r.forward += F * std::polar(1. / n, -order * turn);
    r.backward += F * std::polar(1. / n, order * turn);
  }
  r.axial = largest_axial;
  return r;
}

TEST(Waviness, OfTheInnerRaceExcitesOnlyOrdersNextToMultiplesOfTheBallCount) {
  const auto g = angular_contact_pair(290.)[1];
  const int Z = g.n_balls;
  const double A = 0.04 * 9.525e-3, Br = A * std::cos(25 * deg), Bx = A * std::sin(25 * deg) + g.preload_offset,
               B = std::hypot(Br, Bx);
  const double delta_0 = B - A, amplitude = 1e-7 * delta_0, f = 1.5 * g.stiffness * std::sqrt(delta_0) * amplitude;
  const double axial = Z * f * Bx / B, radial = 0.5 * Z * f * Br / B;
  for (const double cage_angle : {0., 0.4, 2.9})
    for (int m = 1; m <= 3 * Z; ++m) {
      const auto r = response(g, m, amplitude, cage_angle, true);
      if (m % Z == 0) {
        EXPECT_NEAR(r.axial, axial, 2e-4 * axial) << "order " << m << ": largest of 720 places";
      } else {
        EXPECT_LT(r.axial, 1e-6 * axial) << "order " << m;
      }
      const bool above = m % Z == 1, below = m % Z == Z - 1;
      EXPECT_NEAR(std::abs(r.forward), above ? radial : 0., 1e-6 * radial) << "order " << m;
      EXPECT_NEAR(std::abs(r.backward), below ? radial : 0., 1e-6 * radial) << "order " << m;
      EXPECT_NEAR(r.radial, above || below ? radial : 0., 1e-6 * radial) << "order " << m;
    }
}

TEST(Waviness, OfTheOuterRaceExcitesTheSameOrdersAsTheCageTurns) {
  const auto g = angular_contact_pair(290.)[0];
  const int Z = g.n_balls;
  const double A = 0.04 * 9.525e-3,
               delta_0 = std::hypot(A * std::cos(25 * deg), A * std::sin(25 * deg) + g.preload_offset) - A;
  const double amplitude = 1e-7 * delta_0, f = 1.5 * g.stiffness * std::sqrt(delta_0) * amplitude;
  for (int m = 1; m <= 2 * Z + 1; ++m) {
    const auto r = response(g, m, amplitude, 0., false);
    EXPECT_EQ(r.axial > 1e-6 * Z * f, m % Z == 0) << "order " << m;
    EXPECT_EQ(r.radial > 1e-6 * Z * f, m % Z == 1 || m % Z == Z - 1) << "order " << m;
  }
}

TEST(Waviness, OfTheInnerRaceDoesNothingWhenRingAndCageTurnTogether) {
  const auto g = angular_contact_pair(290.)[1];
  const BallRow row(g, {{true, 24, 0.5e-6, 0.2}});
  const auto axial = [&](double angle) {
    BallRowInput in;
    in.ring_angle = in.cage_angle = angle;
    in.cage_cosine = std::cos(angle);
    in.cage_sine = std::sin(angle);
    BallRowOutput out;
    row.evaluate(in, out);
    return std::pair{out.force_x, std::hypot(out.force_y, out.force_z)};
  };
  const auto start = axial(0.);
  for (const double angle : {0.5, 3., 40.}) {
    EXPECT_NEAR(axial(angle).first, start.first, 1e-8) << "N";
    EXPECT_NEAR(axial(angle).second, start.second, 1e-8) << "N";
  }
}

}  // namespace
}  // namespace rotordrop
