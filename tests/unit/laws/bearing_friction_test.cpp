// Palmgren's friction torque and the spin moment.
//
// DRAG BY HAND: nu = 15 cSt, N = 15200 rpm, nu N = 228000 > 2000, (228000)^(2/3) = 61.0911^2 = 3732.12; d_m = 90 mm, d_m^3 = 729000 mm^3:
//   M_v = 1e-7 * 0.25 * 3732.12 * 729000 = 68.018 N mm = 0.068018 N m, and 0.068018 * 1591.74 rad/s = 108.3 W (the paper: 110 W).
// At 100 rpm nu N = 1500: M_v = 160e-7 * 0.25 * 729000 = 2.916 N mm.
//
// SPIN MOMENT: friction mu p over a Hertz ellipse, p = 3F/(2 pi a b) sqrt(1 - s^2) with x = a s cos w, y = b s sin w, dA = a b s ds dw:
//   M = mu int p r dA = 3 mu F / (2 pi) int s^2 sqrt(1 - s^2) ds int sqrt(a^2 cos^2 w + b^2 sin^2 w) dw = 3 mu F a E / 8.
#include "laws/bearing_friction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace rotordrop {
namespace {

using std::numbers::pi;

TEST(DragTorque, OfTheReferenceBearingIs68NewtonMillimetres) {
  const double omega = 15200. * pi / 30.;
  const double M = drag_torque(15e-6, omega, 90e-3, 0.25);
  EXPECT_NEAR(M, 0.068018, 2e-6) << "N m";
  EXPECT_NEAR(M * omega, 108.27, 0.01) << "W";
}

TEST(DragTorque, IsConstantAtLowSpeed) {
  EXPECT_NEAR(drag_torque(15e-6, 100. * pi / 30., 90e-3, 0.25), 2.916e-3, 1e-9) << "N m";
  EXPECT_NEAR(drag_torque(15e-6, 1. * pi / 30., 90e-3, 0.25), 2.916e-3, 1e-9) << "N m";
  EXPECT_NEAR(drag_torque(15e-6, 0., 90e-3, 0.25), 2.916e-3, 1e-9) << "N m";
}

TEST(DragTorque, BranchesMeetWithinOnePercent) {
  // 2000^(2/3) = 158.74: Palmgren's 160 is that, rounded.
  const double limit = 2000. / 15. * pi / 30.;
  EXPECT_NEAR(drag_torque(15e-6, limit * 1.0000001, 90e-3, 0.25) / drag_torque(15e-6, limit * 0.9999999, 90e-3, 0.25),
              158.74 / 160., 1e-5);
}

TEST(DragTorque, DoesNotKnowTheSenseOfRotation) {
  EXPECT_EQ(drag_torque(15e-6, -1500., 85e-3, 0.25), drag_torque(15e-6, 1500., 85e-3, 0.25));
}

TEST(LoadTorque, ByHand) {
  // P = 775 N on C0 = 31 kN: P/C0 = 1/40; f1 = 0.0007 sqrt(1/40) = 1.10680e-4; times 775 N * 0.09 m.
  EXPECT_NEAR(load_torque(775., 0.0007, 0.5, 31e3, 90e-3), 7.71991e-3, 1e-8) << "N m";
  // 620 N on 62 kN: 0.01^0.33 = 10^-0.66 = 0.2187762; 0.001 * 0.2187762 * 620 * 0.085.
  EXPECT_NEAR(load_torque(620., 0.001, 0.33, 62e3, 85e-3), 1.152951e-2, 1e-8) << "N m";
  EXPECT_EQ(load_torque(0., 0.001, 0.33, 62e3, 85e-3), 0.);
}

TEST(LoadTorque, LetsANumberThatIsNoneThrough) {
  EXPECT_TRUE(std::isnan(load_torque(std::numeric_limits<double>::quiet_NaN(), 0.001, 0.33, 62e3, 85e-3)));
}

TEST(EquivalentFrictionLoad, IsTheLargerOfRadialAndAxial) {
  const double cot = 1. / std::tan(25. * pi / 180.);  // 2.144507
  EXPECT_NEAR(equivalent_friction_load(0., 290., cot), 0.9 * 290. * 2.144507, 1e-3) << "N: preload alone";
  EXPECT_NEAR(equivalent_friction_load(100., 290., cot), 0.9 * 290. * 2.144507 - 10., 1e-3) << "N";
  EXPECT_NEAR(equivalent_friction_load(1000., 290., cot), 1000., 1e-12) << "N: 549.7 is less";
}

TEST(SpinMoment, IsFrictionIntegratedOverTheContactEllipse) {
  const double mu = 0.07, F = 310., a = 0.61e-3, b = 0.074e-3;
  constexpr int n = 2000;
  double ring = 0., elliptic = 0., radial = 0.;
  for (int i = 0; i < n; ++i) {
    const double w = (i + 0.5) * 2. * pi / n;  // smooth and periodic: the midpoint rule is exact to roundoff
    ring += std::hypot(a * std::cos(w), b * std::sin(w)) * 2. * pi / n;
    const double u = (i + 0.5) * 0.5 * pi / n;
    elliptic += std::sqrt(1. - (1. - b * b / (a * a)) * std::sin(u) * std::sin(u)) * 0.5 * pi / n;
    radial += std::pow(std::sin(u) * std::cos(u), 2) * 0.5 * pi / n;  // s = sin u: s^2 sqrt(1 - s^2) ds
  }
  const double M = 1.5 * mu * F / pi * radial * ring;
  EXPECT_NEAR(spin_moment(mu, F, a, elliptic) / M, 1., 1e-12);
}

}  // namespace
}  // namespace rotordrop
