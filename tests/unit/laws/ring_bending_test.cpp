// THIN RING of radius R, bending stiffness E I, no extension, no shear. Under m equal radial forces W at equal angles 2 beta = 2 pi / m the bending
// moment at the angle x from midway between two forces is M = (W R / 2) (cos x / sin beta - 1 / beta), from the equilibrium of a span and no change of
// its slope. The energy of the 2 m half spans, integral M^2 R dx / (2 E I), is m W delta / 2, so each force moves its point by
//   delta = W R^3 / (2 E I) [ (beta + sin beta cos beta) / (2 sin^2 beta) - 1 / beta ].
// Two forces: 0.0744 W R^3 / (E I), half of Roark's 0.1488 for the diameter. With R / h = 50, shear and extension add 2e-4.
// FREQUENCIES of a thin ring: omega^2 = E I / (rho A R^4) n^2 (n^2 - 1)^2 / (n^2 + 1) (Love).
// TOUCHDOWN RINGS: natural frequencies from CalculiX 2.20, 3-D elements with 20 nodes (validation/ring_bending_calculix.py).
#include "laws/ring_bending.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rotordrop {
namespace {

constexpr double pi = std::numbers::pi;

RingSection thin_ring(double thickness, double width) {
  RingSection s;
  s.inner_radius = 50e-3 - 0.5 * thickness;
  s.outer_radius = 50e-3 + 0.5 * thickness;
  s.width = width;
  s.E = 2.05e11;
  s.nu = 0.3;
  s.rho = 7800.;
  return s;
}

double displacement_under(int n_forces, const std::vector<RingHarmonic>& harmonics) {
  double sum = 0.;
  for (const auto& h : harmonics) {
    double load = 0.;
    for (int i = 0; i < n_forces; ++i) load += std::cos(h.n * 2. * pi * i / n_forces);
    sum += load / h.stiffness;  // of 1 N, at the force at angle 0
  }
  return sum;
}

double closed_form(int n_forces, double R, double EI) {
  const double beta = pi / n_forces, s = std::sin(beta), c = std::cos(beta);
  return R * R * R / (2. * EI) * ((beta + s * c) / (2. * s * s) - 1. / beta);
}

TEST(RingBending, GivesTheThinRingUnderTwoAndThreeForces) {
  const double h = 1e-3;
  const auto harmonics = ring_harmonics(thin_ring(h, h), 40);
  const double EI = 2.05e11 * h * h * h * h / 12.;
  EXPECT_NEAR(closed_form(2, 1., 1.), 0.1488 / 2., 5e-5);  // the textbook's figure
  for (const int n : {2, 3}) {
    const double expected = closed_form(n, 50e-3, EI);
    // Truncated at n = 40, shear and curvature: below 5e-3 together.
    EXPECT_NEAR(displacement_under(n, harmonics), expected, 5e-3 * expected) << n << " forces, m/N";
  }
}

TEST(RingBending, GivesTheFrequenciesOfAThinRing) {
  const double h = 0.5e-3, R = 50e-3, I = std::pow(h, 4) / 12., A = h * h;
  for (const auto& mode : ring_harmonics(thin_ring(h, h), 6)) {
    const double n2 = mode.n * mode.n;
    const double omega2 = 2.05e11 * I / (7800. * A * std::pow(R, 4)) * n2 * (n2 - 1.) * (n2 - 1.) / (n2 + 1.);
    const double expected = std::sqrt(omega2) / (2. * pi);
    EXPECT_NEAR(mode.frequency(), expected, 2e-3 * expected) << "n = " << mode.n << ", Hz";
    // Inextensional: u_theta = u_r / n.
    const double mass = pi * 7800. * A * R * (1. + 1. / n2);
    EXPECT_NEAR(mode.mass, mass, 2e-3 * mass) << "n = " << mode.n << ", kg";
  }
}

TEST(RingBending, StiffensWideRingsByTheirPoissonEffect) {
  // A long thin tube bends as a plate: E / (1 - nu^2), but for its two ends, about sqrt(R h) long each.
  const double h = 0.5e-3, R = 50e-3, W = 400e-3;
  const auto mode = ring_harmonics(thin_ring(h, W), 2, 2).front();
  const double beam = pi * 2.05e11 * W * h * h * h / 12. * 9. / (R * R * R);
  // The ends are 10 of 400 mm: 2.5 % of the stiffening by 0.1.
  EXPECT_NEAR(mode.stiffness / beam, 1. / (1. - 0.09), 0.003);
}

TEST(RingBending, ConvergesWithTheMesh) {
  RingSection s;
  s.inner_radius = 35e-3;
  s.outer_radius = 41.45e-3;
  s.width = 20e-3;
  s.grooves = {{0., 45.238e-3, 6.191e-3}};
  s.E = 2e11;
  s.nu = 0.3;
  s.rho = 7800.;
  const auto coarse = ring_harmonics(s, 12), fine = ring_harmonics(s, 12, 3);
  for (std::size_t i = 0; i < fine.size(); ++i) {
    EXPECT_NEAR(coarse[i].stiffness / fine[i].stiffness, 1., 8e-3) << "n = " << fine[i].n;
    EXPECT_NEAR(coarse[i].mass / fine[i].mass, 1., 2e-3) << "n = " << fine[i].n;
  }
}

TEST(RingBending, BendsAnOuterRingWithTheSameSectionMuchAsAnInnerOne) {
  // Grooves in the inner or the outer surface of a thin ring leave nearly the same wall at nearly the same radius.
  RingSection inner = thin_ring(1e-3, 3e-3), outer = inner;
  inner.grooves = {{0., 50.5e-3 + 0.7e-3, 1e-3}};
  outer.grooves = {{0., 49.5e-3 - 0.7e-3, 1e-3}};
  outer.has_grooves_outside = false;
  EXPECT_NEAR(inner.least_wall(), 0.7e-3, 1e-9);
  EXPECT_NEAR(outer.least_wall(), 0.7e-3, 1e-9);
  const auto a = ring_harmonics(inner, 2).front(), b = ring_harmonics(outer, 2).front();
  // The walls under the grooves lie 0.3 mm apart: 1/R^3 differs by 1.8 %.
  EXPECT_NEAR(a.stiffness / b.stiffness, 1., 0.02);
}

TEST(RingBending, GivesTheFrequenciesOfThreeDimensionalElements) {
  RingSection tb1;
  tb1.inner_radius = 35e-3;
  tb1.outer_radius = 41.45e-3;
  tb1.width = 20e-3;
  tb1.grooves = {{0., 45e-3 + 0.02 * 11.906e-3, 0.52 * 11.906e-3}};
  tb1.E = 2e11;
  tb1.nu = 0.3;
  tb1.rho = 7800.;
  RingSection tb2 = tb1;
  tb2.outer_radius = 39e-3;
  tb2.width = 32e-3;
  const double offset = 0.02 * 9.525e-3, angle = 25. * pi / 180.;
  const double centre = 42.5e-3 + offset * std::cos(angle), x = 8e-3 + offset * std::sin(angle);
  tb2.grooves = {{-x, centre, 0.52 * 9.525e-3}, {x, centre, 0.52 * 9.525e-3}};
  const std::vector<std::pair<RingSection, std::vector<double>>> peers = {
      {tb1, {2616.86, 7253.86, 13535.10, 21187.30, 29968.05}}, {tb2, {1775.08, 4980.47, 9439.01, 15039.57, 21676.56}}};
  for (const auto& [section, hertz] : peers) {
    const auto harmonics = ring_harmonics(section, 6);
    for (std::size_t k = 0; k < hertz.size(); ++k)
      EXPECT_NEAR(harmonics[k].frequency(), hertz[k], 0.01 * hertz[k]) << "n = " << harmonics[k].n << ", Hz";
  }
}

TEST(RingBending, RefusesAGrooveThroughTheWall) {
  RingSection s = thin_ring(1e-3, 3e-3);
  s.grooves = {{0., 50.5e-3, 1.5e-3}};
  EXPECT_THROW((void)ring_harmonics(s, 4), std::invalid_argument);
  EXPECT_THROW((void)ring_harmonics(thin_ring(1e-3, 1e-3), 1), std::invalid_argument);
}

}  // namespace
}  // namespace rotordrop
