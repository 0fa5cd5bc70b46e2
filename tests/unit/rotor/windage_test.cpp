// Windage of a rotor: powers, tables, and the sum over its outline.
//
// ONE CYLINDER in a gas so viscous that all is laminar: 4 pi mu omega r^2 L for the cylinder, and for both faces 2 * 1/2 * 1.935 rho omega^2 r^5 /
// sqrt(omega r^2/nu), with rho = 2, nu = 1, omega = 4, r = 0.5, L = 3: Re = 1,
//   4 pi * 2 * 4 * 0.25 * 3 + 2 * 0.5 * 1.935 * 2 * 16 * 0.03125 = 24 pi + 1.935
#include "rotor/windage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rotordrop {
namespace {

using std::numbers::pi;

RotorGeometry cylinders(std::vector<double> x, std::vector<double> diameters) {
  RotorGeometry g;
  g.node_x = std::move(x);
  for (std::size_t k = 0; k < diameters.size(); ++k)
    g.elements.push_back({static_cast<int>(k) + 1, static_cast<int>(k) + 2, diameters[k], 0., {}});
  return g;
}

WindageParameters gas(double density, double viscosity) {
  WindageParameters p;
  p.law = WindageLaw::geometry;
  p.density = density;
  p.viscosity = viscosity;
  return p;
}

TEST(Windage, IsAPowerOfTheSpeedAndAgainstIt) {
  const Windage quadratic(3., 100., 2.), root(2., 100., 0.5);
  EXPECT_DOUBLE_EQ(quadratic(50.), 0.75);
  EXPECT_DOUBLE_EQ(quadratic(-50.), -0.75);
  EXPECT_DOUBLE_EQ(quadratic(0.), 0.);
  EXPECT_DOUBLE_EQ(root(25.), 1.);
  EXPECT_TRUE(std::isnan(quadratic(NAN)));
}

TEST(Windage, OfATableMeetsItsPointsAndIsProportionalBelow) {
  const Windage w({10., 100., 1000.}, {1., 100., 500.});  // powers 2 and log10(5)
  EXPECT_NEAR(w(10.), 1., 1e-12);
  EXPECT_NEAR(w(31.622776601683793), 10., 1e-11);
  EXPECT_NEAR(w(-1000.), -500., 1e-10);
  EXPECT_NEAR(w(1e4), 2500., 1e-9);
  EXPECT_NEAR(w(2.), 0.2, 1e-13);
}

TEST(Windage, OfOneLaminarCylinderByHand) {
  auto p = gas(2., 1.);
  const auto one = cylinders({0., 3.}, {1.});
  EXPECT_NEAR(windage_torque(one, p, 4.), 24. * pi + 1.935, 1e-10) << "N m";
  p.factor = 1.5;
  EXPECT_NEAR(windage_torque(one, p, 4.), 1.5 * (24. * pi + 1.935), 1e-10) << "N m";
}

TEST(Windage, OfAStepHasItsRingAndASleeveCountsByItsOutside) {
  const auto p = gas(1.2, 15e-6);
  const double speed = 1000.;
  const double thin = windage_torque(cylinders({0., 1.}, {0.1}), p, speed),
               thick = windage_torque(cylinders({0., 1.}, {0.2}), p, speed);
  // Two spans beside each other: both cylinders, the larger outline's faces.
  const auto cylinder = [&](double d) {
    return windage_torque(cylinders({0., 2.}, {d}), p, speed) - windage_torque(cylinders({0., 1.}, {d}), p, speed);
  };
  const double faces = thick - cylinder(0.2);
  EXPECT_NEAR(windage_torque(cylinders({0., 1., 2.}, {0.2, 0.1}), p, speed), cylinder(0.2) + cylinder(0.1) + faces,
              1e-9);
  auto sleeved = cylinders({0., 1.}, {0.1});
  sleeved.elements.push_back({1, 2, 0.2, 0.1, {}});
  EXPECT_NEAR(windage_torque(sleeved, p, speed), thick, 1e-12);
  EXPECT_LT(thin, thick);
}

// ONE CYLINDER of r = 8 mm and L = 0.1 m in air, 0.6 mm from its casing, as Bilgen & Boulos and von Karman have it. Above 31 000 rad/s it is turbulent
// beyond Re = 1e4; its faces are from 70 000 rad/s on.
TEST(Windage, TableOfAGeometryReachesTheHighestSpeedAtTheStart) {
  auto p = gas(1.2, 15e-6);
  p.gap = 6e-4;
  const double r = 0.008, L = 0.1;
  const Windage table = windage_of(cylinders({0., L}, {2. * r}), p);
  for (const double w : {5e4, 1e5, 2e5}) {
    const double Re = w * r * 6e-4 / 15e-6, Re_face = w * r * r / 15e-6;
    const double cylinder =
        0.5 * 0.065 * std::pow(6e-4 / r, 0.3) * std::pow(Re, -0.2) * pi * 1.2 * w * w * std::pow(r, 4) * L;
    const double C = Re_face < 3e5 ? 1.935 / std::sqrt(Re_face) : 0.073 / std::pow(Re_face, 0.2);
    const double torque = cylinder + C * 1.2 * w * w * std::pow(r, 5);
    EXPECT_NEAR(table(w), torque, 1e-4 * torque) << "N m at " << w;
  }
}

TEST(Windage, TableOfAGeometryIsItsTorque) {
  auto p = gas(1.2, 15e-6);
  const auto rotor = cylinders({0., 0.3, 0.5, 0.8}, {0.1, 0.2, 0.08});
  const Windage w = windage_of(rotor, p);
  for (const double speed : {3., 70., 400., 1591.7})
    EXPECT_NEAR(w(speed) / windage_torque(rotor, p, speed), 1., 1e-3) << speed;
}

TEST(Windage, IsLargerInANarrowGap) {
  auto p = gas(1.2, 15e-6);
  const auto rotor = cylinders({0., 0.2}, {0.2});
  const double free = windage_torque(rotor, p, 1591.7);
  p.gap = 0.5e-3;
  EXPECT_GT(windage_torque(rotor, p, 1591.7), 0.5 * free);
  // Re = 1591.7 * 0.1 * 0.5e-3 / 15e-6 = 5305.67; (0.005)^0.3 = 0.2040286; C = 0.515 * 0.2040286 / 72.8400 = 1.4425413e-3; times pi rho w^2 r^4 L
  const double faces = 2. * 0.5 * 0.073 / std::pow(1591.7 * 0.01 / 15e-6, 0.2) * 1.2 * 1591.7 * 1591.7 * 1e-5;
  EXPECT_NEAR(windage_torque(rotor, p, 1591.7), 1.44254128e-3 * pi * 1.2 * 1591.7 * 1591.7 * 1e-4 * 0.2 + faces, 1e-6);
}

}  // namespace
}  // namespace rotordrop
