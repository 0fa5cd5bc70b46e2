// Growth of a free annulus a < r < b under a temperature rise T(r).
//
// Plane stress without pressure on the surfaces (Timoshenko & Goodier, section 151):
//   u(r) = (1 + nu) alpha / r int_a^r T r dr + C1 r + C2 / r,
// with sigma_r = 0 at a and b. At both surfaces this gives u = alpha r * 2/(b^2 - a^2) int_a^b T r dr: alpha r times the volume-mean rise.
// The derivation is repeated numerically below: the integrals by quadrature, C1 and C2 from the two conditions.
#include "laws/ring_growth.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rotordrop {
namespace {

constexpr double alpha = 11.8e-6, a = 35e-3, b = 39e-3, E = 2e11, nu = 0.3;

double linear_rise(double r, double T_a, double T_b) { return T_a + (T_b - T_a) * (r - a) / (b - a); }

double moment(double T_a, double T_b, double r) {  // int_a^r T r dr by Simpson: exact for the quadratic integrand
  const double m = 0.5 * (a + r);
  return (r - a) / 6. *
         (linear_rise(a, T_a, T_b) * a + 4. * linear_rise(m, T_a, T_b) * m + linear_rise(r, T_a, T_b) * r);
}

double thermoelastic_growth(double T_a, double T_b, double r) {
  // sigma_r = -alpha E / r^2 int T r dr + E/(1 - nu^2) [C1 (1 + nu) - C2 (1 - nu) / r^2]
  const double p = E / (1. - nu);  // of C1
  const double q = E / (1. + nu);  // of C2 / r^2
  const double load = alpha * E * moment(T_a, T_b, b) / (b * b);
  // p C1 - q C2/a^2 = 0;  p C1 - q C2/b^2 = load
  const double C2 = load / (q * (1. / (a * a) - 1. / (b * b)));
  const double C1 = q * C2 / (a * a) / p;
  return (1. + nu) * alpha / r * moment(T_a, T_b, r) + C1 * r + C2 / r;
}

TEST(RingGrowth, OfAUniformRiseIsAlphaTimesRadiusTimesRise) {
  EXPECT_NEAR(ring_growth(alpha, a, b, a).at(10., 10.), 11.8e-6 * 35e-3 * 10., 1e-18) << "m";
  EXPECT_NEAR(ring_growth(alpha, a, b, b).at(10., 10.), 11.8e-6 * 39e-3 * 10., 1e-18) << "m";
}

TEST(RingGrowth, OfALinearProfileFollowsTheVolumeMeanRise) {
  for (const double T_a : {0., 3., -8.})
    for (const double T_b : {0., 7., 20.}) {
      const double mean = 2. / (b * b - a * a) * moment(T_a, T_b, b);
      EXPECT_NEAR(ring_growth(alpha, a, b, a).at(T_a, T_b), alpha * a * mean, 1e-18) << "m";
      EXPECT_NEAR(ring_growth(alpha, a, b, b).at(T_a, T_b), alpha * b * mean, 1e-18) << "m";
    }
}

TEST(RingGrowth, IsTheThermoelasticSolutionOfAFreeAnnulus) {
  for (const double r : {a, b}) {
    EXPECT_NEAR(ring_growth(alpha, a, b, r).at(5., 12.), thermoelastic_growth(5., 12., r), 1e-18) << "m";
    EXPECT_NEAR(ring_growth(alpha, a, b, r).at(12., 0.), thermoelastic_growth(12., 0., r), 1e-18) << "m";
  }
}

TEST(RingGrowth, UnderPlaneStrainIsOnePlusPoissonTimesThat) {
  EXPECT_NEAR(ring_growth(alpha, a, b, a, 1.3).at(5., 12.) / ring_growth(alpha, a, b, a).at(5., 12.), 1.3, 1e-14);
}

}  // namespace
}  // namespace rotordrop
