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

#include <array>
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
  EXPECT_NEAR(load_torque({775., 775.}, 0.0007, 0.5, 31e3, 90e-3), 7.71991e-3, 1e-8) << "N m";
  // 620 N on 62 kN: 0.01^0.33 = 10^-0.66 = 0.2187762; 0.001 * 0.2187762 * 620 * 0.085.
  EXPECT_NEAR(load_torque({620., 620.}, 0.001, 0.33, 62e3, 85e-3), 1.152951e-2, 1e-8) << "N m";
  EXPECT_EQ(load_torque({0., 0.}, 0.001, 0.33, 62e3, 85e-3), 0.);
  // P1 = 1000 N, P0 = 310 N on 31 kN: 0.01^0.5 = 0.1; 0.001 * 0.1 * 1000 * 0.09. Exchanged they would give 0.001 * 0.17961 * 310 * 0.09.
  EXPECT_NEAR(load_torque({1000., 310.}, 0.001, 0.5, 31e3, 90e-3), 9e-3, 1e-12) << "N m";
}

TEST(LoadTorque, LetsANumberThatIsNoneThrough) {
  EXPECT_TRUE(std::isnan(load_torque({std::numeric_limits<double>::quiet_NaN(), 1.}, 0.001, 0.33, 62e3, 85e-3)));
}

TEST(FrictionLoads, ForTheTorqueAreTheLargerOfRadialAndAxial) {
  const auto factors = friction_load_factors(25. * pi / 180.);  // cot 25 deg = 2.144507
  EXPECT_NEAR(factors.loads(0., 290.).torque, 0.9 * 290. * 2.144507, 1e-3) << "N: preload alone";
  EXPECT_NEAR(factors.loads(100., 290.).torque, 0.9 * 290. * 2.144507 - 10., 1e-3) << "N";
  EXPECT_NEAR(factors.loads(1000., 290.).torque, 1000., 1e-12) << "N: 459.7 is less";
}

TEST(FrictionLoads, StaticEquivalentIsThatOfIso76) {
  // By hand: 0.5 F_r + 0.38 F_a at 25 deg, but never less than F_r.
  const auto at_25 = friction_load_factors(25. * pi / 180.);
  EXPECT_NEAR(at_25.loads(0., 290.).static_equivalent, 110.2, 1e-9) << "N";
  EXPECT_NEAR(at_25.loads(100., 1000.).static_equivalent, 430., 1e-9) << "N";
  EXPECT_NEAR(at_25.loads(1000., 290.).static_equivalent, 1000., 1e-9) << "N: 610.2 is less";
  // Deep groove: 0.6 F_r + 0.5 F_a; P1 = 3 F_a - 0.1 F_r.
  const auto deep = friction_load_factors(0.).loads(100., 1000.);
  EXPECT_NEAR(deep.static_equivalent, 560., 1e-9) << "N";
  EXPECT_NEAR(deep.torque, 2990., 1e-9) << "N";
}

TEST(FrictionLoads, FollowTheTableOverTheContactAngle) {
  const std::array<std::array<double, 2>, 9> table = {{{5., 0.52},
                                                       {10., 0.50},
                                                       {15., 0.46},
                                                       {20., 0.42},
                                                       {25., 0.38},
                                                       {30., 0.33},
                                                       {35., 0.29},
                                                       {40., 0.26},
                                                       {45., 0.22}}};
  const auto Y_0 = [](double degrees) { return friction_load_factors(degrees * pi / 180.).static_axial; };
  for (const auto& [degrees, value] : table) {
    EXPECT_NEAR(Y_0(degrees), value, 1e-12) << degrees;
    EXPECT_EQ(friction_load_factors(degrees * pi / 180.).static_radial, 0.5);
  }
  EXPECT_NEAR(Y_0(12.5), 0.48, 1e-12) << "half way from 0.50 to 0.46";
  EXPECT_NEAR(Y_0(41.), 0.252, 1e-12) << "a fifth of the way from 0.26 to 0.22";
  EXPECT_NEAR(Y_0(2.), 0.52, 1e-12) << "as 5 deg";
  EXPECT_NEAR(Y_0(60.), 0.22, 1e-12) << "as 45 deg";
  EXPECT_NEAR(friction_load_factors(2. * pi / 180.).torque_axial, 0.9 / std::tan(5. * pi / 180.), 1e-9);
}

TEST(FrictionLoads, WithoutTheStaticLoadTheTorqueOfThrustWasTooLargeBy71Percent) {
  // Pure thrust at 25 deg: (0.9 cot phi / 0.38)^0.33 = (5.0790)^0.33 = 1.70966
  const auto loads = friction_load_factors(25. * pi / 180.).loads(0., 500.);
  EXPECT_NEAR(load_torque({loads.torque, loads.torque}, 0.001, 0.33, 31e3, 85e-3) /
                  load_torque(loads, 0.001, 0.33, 31e3, 85e-3),
              1.70966, 1e-5);
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
