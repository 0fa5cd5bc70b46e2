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

// Plane stress, rings of one material: u = p r + q / r - (1 - nu^2) rho omega^2 r^3 / (8 E),
// sigma_r = E/(1 - nu) p - E/(1 + nu) q / r^2 - (3 + nu)/8 rho omega^2 r^2; p and q from what the faces carry.
constexpr double nu_s = 0.3, rho = 7800.;

TEST(SpinningRing, HasFreeFaces) {
  const double omega = 1500., load = rho * omega * omega;
  // sigma_r(a) = sigma_r(b) = 0
  const double q = -(3. + nu_s) / 8. * load * (b * b - a * a) / (1. / (b * b) - 1. / (a * a)) * (1. + nu_s) / E;
  const double p = ((3. + nu_s) / 8. * load * a * a + E / (1. + nu_s) * q / (a * a)) * (1. - nu_s) / E;
  for (const double r : {a, b}) {
    const double u = p * r + q / r - (1. - nu_s * nu_s) * load * r * r * r / (8. * E);
    EXPECT_NEAR(spinning_ring_growth(E, nu_s, rho, a, b, r) * omega * omega, u, 1e-12 * u) << "m";
  }
}

TEST(PressFit, ClosesTheBoreAsLameSays) {
  const double c = 60e-3, pressure = 1e7;  // a ring a..b in one of b..c
  // inner ring: sigma_r(a) = 0, sigma_r(b) = -pressure; outer: sigma_r(b) = -pressure, sigma_r(c) = 0
  const double q_i = pressure * (1. + nu_s) / E / (1. / (b * b) - 1. / (a * a)),
               p_i = (1. - nu_s) / (1. + nu_s) * q_i / (a * a);
  const double q_o = pressure * (1. + nu_s) / E / (1. / (b * b) - 1. / (c * c)),
               p_o = (1. - nu_s) / (1. + nu_s) * q_o / (c * c);
  const double interference = (p_o * b + q_o / b) - (p_i * b + q_i / b), bore = p_i * a + q_i / a;
  EXPECT_GT(interference, 0.);
  EXPECT_NEAR(bore_closure(a, b, c), -bore / interference, 1e-12);
}

}  // namespace
}  // namespace rotordrop
