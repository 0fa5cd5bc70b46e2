// A circular journal in a circular bore: the integral of f cos(theta) over the arc must be K delta_0^n. It is taken here by the substitution
// theta = theta_0 sin(u), which removes the ends' powers, with the midpoint rule.
#include "laws/arc_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rotordrop {
namespace {

double resultant(const ArcContact& arc, double gap, double e) {
  const double end = std::acos(gap / e);
  const int n = 4000;
  double sum = 0.;
  for (int i = 0; i < n; ++i) {
    const double u = std::numbers::pi * ((i + 0.5) / n - 0.5), theta = end * std::sin(u);
    sum += arc.force(e * std::cos(theta) - gap) * std::cos(theta) * end * std::cos(u) * std::numbers::pi / n;
  }
  return sum;
}

TEST(ArcContact, GivesThePointLawInACircularBore) {
  const double K = 1.144e9, gap = 250e-6;
  for (const double n : {10. / 9., 1.5, 1.})
    for (const double delta : {1e-7, 1e-6, 1e-5, 3e-5}) {
      const double expected = K * std::pow(delta, n);
      EXPECT_NEAR(resultant({K, n, gap}, gap, gap + delta) / expected, 1., 1e-4) << "n " << n << ", delta " << delta;
    }
}

TEST(ArcContact, IsTheDerivativeOfItsEnergy) {
  const ArcContact arc(1.144e9, 10. / 9., 250e-6);
  for (const double delta : {1e-6, 2e-5}) {
    const double h = 1e-3 * delta;
    const double slope = (arc.energy(delta + h) - arc.energy(delta - h)) / (2. * h);
    // Central differences: h^2 / 6 of the third derivative is 4e-8 of the slope of the energy and 9e-8 of that of the force.
    EXPECT_NEAR(slope / arc.force(delta), 1., 2e-7);
    EXPECT_NEAR((arc.force(delta + h) - arc.force(delta - h)) / (2. * h) / arc.stiffness(delta), 1., 2e-7);
  }
  EXPECT_EQ(arc.force(-1e-6), 0.);
  EXPECT_EQ(arc.energy(-1e-6), 0.);
  EXPECT_EQ(arc.stiffness(-1e-6), 0.);
}

}  // namespace
}  // namespace rotordrop
