// Rings against closed forms. Short rings with free ends are in plane stress exactly where nothing depends on x; means over the length follow
// from Betti's theorem for anything else. Of the load "unit pressure in the bore" a free ring knows Lame's field u* = A r + B/r, in which
// sigma*_rr + sigma*_tt is the same everywhere and sigma*_xx = 0. So, of any temperature rise theta(x, r),
//   2 pi a L mean(u(a)) = integral alpha theta (sigma*_rr + sigma*_tt) dV,   i.e.   mean(u(a)) = alpha a mean(theta over the volume),
// the same outside with pressure there, and of a centrifugal load the means are those of the thin disc (Timoshenko & Goodier, section 32):
//   u(a) = rho omega^2 a/(4 E) [(3 + nu) b^2 + (1 - nu) a^2],   u(b) = rho omega^2 b/(4 E) [(1 - nu) b^2 + (3 + nu) a^2].
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "fe_room.h"

namespace rotordrop {
namespace {

constexpr double T_0 = 293.15, E = 2.05e11, nu = 0.3, alpha = 11.8e-6, rho = 7800.;

ElasticBody ring(const char* name, double length, double a, double b) {
  return {name, {0., length}, {a, b}, rho, E, nu, PropertyTable(alpha), 1.};
}
ElasticOutput radial(const char* name, HeatBoundary boundary) { return {name, {boundary}, {0., 1.}}; }

ElasticProblem free_ring(double length, double a, double b, int cells) {
  ElasticProblem p;
  p.bodies = {ring("ring", length, a, b)};
  p.outputs = {radial("bore", {0, HeatSide::inner}), radial("outside", {0, HeatSide::outer})};
  p.numerics.cells = cells;
  return p;
}

TEST(FreeRing, GrowsInTheMeanByAlphaRTimesTheVolumeMeanRiseWhateverTheField) {
  constexpr double L = 16e-3, a = 35e-3, b = 41e-3;
  const auto problem = free_ring(L, a, b, 20);
  // The volume mean of the field comes from the heat solver on the same mesh.
  HeatConductionProblem heat;
  heat.bodies = {{"ring", {0., L}, {a, b}, rho, PropertyTable(46.), PropertyTable(460.)}};
  heat.numerics = problem.numerics;
  const auto conduction = make_solver(heat);
  const auto elastic = make_elastic_solver(problem);
  const std::function<double(double, double)> fields[] = {
      [](double, double) { return 40.; },
      [](double, double r) { return 30. * (r - a) / (b - a); },
      [](double, double r) { return 200. * std::exp(-(r - a) / 0.6e-3); },
      [](double x, double r) { return 50. * std::sin(300. * x + 0.4) * std::cos(250. * r); },
      [](double x, double r) { return 300. * std::exp(-std::hypot(x - 3e-3, r - b) / 2e-3); },
  };
  for (const auto& field : fields) {
    const auto T = elastic->interpolate([&](std::size_t, double x, double r) { return T_0 + field(x, r); });
    elastic->solve(T, 0.);
    conduction->set_field(T, 0., 0., 0.);
    const double mean = conduction->body_mean(0) - T_0;
    const double bore = elastic->output(0) / (alpha * a * mean) - 1.,
                 outside = elastic->output(1) / (alpha * b * mean) - 1.;
    std::printf("  mean rise %8.4f K: bore off by %8.1e, outside by %8.1e\n", mean, bore, outside);
    EXPECT_LT(std::fabs(bore), 1e-6);
    EXPECT_LT(std::fabs(outside), 1e-6);
  }
}

TEST(FreeRing, IsFreeOfStressWhenItIsEvenlyWarm) {
  const auto elastic = make_elastic_solver(free_ring(16e-3, 35e-3, 41e-3, 6));
  elastic->solve(std::vector<double>(elastic->n_nodes(), T_0 + 50.), 0.);
  for (const double x : {0., 5e-3, 16e-3})
    for (const double r : {35e-3, 38.2e-3, 41e-3}) {
      const auto u = elastic->displacement(0, x, r);
      const auto s = elastic->stress(0, x, r);
      EXPECT_NEAR(u[0], alpha * 50. * (x - 8e-3), 1e-11 * alpha * 50. * r);  // its middle stays
      EXPECT_NEAR(u[1], alpha * 50. * r, 1e-11 * alpha * 50. * r);
      // Roundoff of E alpha 50 K.
      for (const double stress : {s.axial, s.radial, s.hoop, s.shear})
        EXPECT_LT(std::fabs(stress), 1e-8 * E * alpha * 50.);
    }
}

TEST(FreeRing, GrowsByTheIntegralOfATabledExpansionCoefficient) {
  auto problem = free_ring(16e-3, 35e-3, 41e-3, 4);
  problem.bodies[0].expansion = PropertyTable({{273.15, 11e-6}, {473.15, 13e-6}});
  const auto elastic = make_elastic_solver(problem);
  elastic->solve(std::vector<double>(elastic->n_nodes(), T_0 + 80.), 0.);
  // alpha = 11e-6 + 1e-8 (T - 273.15): its integral from 293.15 to 373.15.
  const double strain = 11e-6 * 80. + 0.5e-8 * (100. * 100. - 20. * 20.);
  EXPECT_NEAR(elastic->output(0), 35e-3 * strain, 1e-11 * 35e-3 * strain);
  EXPECT_THROW((void)elastic->influence(0), std::exception);  // no linear function of temperature
}

TEST(SpinningRing, GrowsInTheMeanAsTheThinDiscDoes) {
  constexpr double a = 35e-3, b = 41e-3, omega = 1600.;
  for (const double length : {4e-3, 32e-3}) {
    const auto elastic = make_elastic_solver(free_ring(length, a, b, 12));
    elastic->solve({}, omega);
    const double f = rho * omega * omega / (4. * E);
    const double bore = f * a * ((3. + nu) * b * b + (1. - nu) * a * a),
                 outside = f * b * ((1. - nu) * b * b + (3. + nu) * a * a);
    EXPECT_NEAR(elastic->output(0), bore, 1e-7 * bore) << length;
    EXPECT_NEAR(elastic->output(1), outside, 1e-7 * outside) << length;
    EXPECT_GT(bore, 3e-6);
  }
}

TEST(SpinningShaft, GrowsInTheMeanAsTheSolidDiscDoes) {
  constexpr double b = 35e-3, omega = 1600.;
  const auto elastic = make_elastic_solver(free_ring(20e-3, 0., b, 12));
  elastic->solve({}, omega);
  // u(b) = rho omega^2 b^3 (1 - nu)/(4 E)
  const double outside = rho * omega * omega * b * b * b * (1. - nu) / (4. * E);
  EXPECT_NEAR(elastic->output(1), outside, 1e-7 * outside);
  EXPECT_EQ(elastic->displacement(0, 5e-3, 0.)[1], 0.);
  EXPECT_EQ(elastic->output(0), 0.) << "a solid body's inner side is the axis";
}

// A free body grows by alpha theta everywhere, and so do the distances of any two of its points. The rise depends on nothing: u_x = u_0 + alpha theta x,
// whose mean along the axis is that over the outside.
TEST(SolidBody, HasAMeanDisplacementOfItsAxis) {
  constexpr double theta = 50., L = 20e-3;
  const auto elastic = make_elastic_solver(free_ring(L, 0., 35e-3, 6));
  elastic->solve(elastic->interpolate([](std::size_t, double, double) { return T_0 + theta; }), 0.);
  const AxialRadial axis = elastic->mean_displacement({{0, HeatSide::inner}}),
                    outside = elastic->mean_displacement({{0, HeatSide::outer}}),
                    end = elastic->mean_displacement({{0, HeatSide::right}});
  EXPECT_EQ(axis[1], 0.);
  // A linear displacement is one of the elements: roundoff.
  EXPECT_NEAR(axis[0], outside[0], 1e-9 * alpha * theta * L);
  EXPECT_NEAR(end[0] - axis[0], alpha * theta * 0.5 * L, 1e-9 * alpha * theta * L);
}

TEST(StandingRing, DoesNotGrowWithTheSpeedOfOthers) {
  auto problem = free_ring(16e-3, 35e-3, 41e-3, 4);
  problem.bodies[0].spin = 0.;
  const auto elastic = make_elastic_solver(problem);
  elastic->solve({}, 1600.);
  EXPECT_EQ(elastic->output(0), 0.);
}

// Ends held axially, free to slide: plane strain (Timoshenko & Goodier, section 151), with I(r) = integral of theta r from a to r:
//   u(r) = (1 + nu)/(1 - nu) alpha/r [I(r) + ((1 - 2 nu) r^2 + a^2)/(b^2 - a^2) I(b)]
//   sigma_tt = alpha E/(1 - nu)/r^2 [(r^2 + a^2)/(b^2 - a^2) I(b) + I(r) - theta r^2],
//   sigma_rr = alpha E/(1 - nu)/r^2 [(r^2 - a^2)/(b^2 - a^2) I(b) - I(r)],  sigma_xx = nu (sigma_rr + sigma_tt) - alpha E theta.
TEST(ClampedCylinder, HasTheStressesOfPlaneStrainUnderARadialTemperatureProfile) {
  constexpr double a = 30e-3, b = 50e-3;
  auto problem = free_ring(20e-3, a, b, 40);
  problem.holds = {{{0, HeatSide::left}, true, false}, {{0, HeatSide::right}, true, false}};
  const auto elastic = make_elastic_solver(problem);
  // theta = 60 (b - r)^2/(b - a)^2, a polynomial of the elements; theta r integrates exactly.
  const auto theta = [](double r) { return 60. * std::pow((b - r) / (b - a), 2); };
  const auto I = [](double r) {
    const auto F = [](double s) { return b * b * s * s / 2. - 2. * b * s * s * s / 3. + s * s * s * s / 4.; };
    return 60. / ((b - a) * (b - a)) * (F(r) - F(a));
  };
  elastic->solve(elastic->interpolate([&](std::size_t, double, double r) { return T_0 + theta(r); }), 0.);
  const double scale = E * alpha * 60.;
  for (const double r : {a, 36e-3, 43e-3, b}) {
    const double u =
        (1. + nu) / (1. - nu) * alpha / r * (I(r) + ((1. - 2. * nu) * r * r + a * a) / (b * b - a * a) * I(b));
    const double f = alpha * E / (1. - nu) / (r * r);
    const double hoop = f * ((r * r + a * a) / (b * b - a * a) * I(b) + I(r) - theta(r) * r * r),
                 radial_stress = f * ((r * r - a * a) / (b * b - a * a) * I(b) - I(r)),
                 axial = nu * (radial_stress + hoop) - alpha * E * theta(r);
    EXPECT_NEAR(elastic->displacement(0, 7e-3, r)[1], u, 2e-6 * u) << r;
    EXPECT_NEAR(elastic->displacement(0, 7e-3, r)[0], 0., 1e-8 * u) << r;
    // Stresses are derivatives: one order less, at points that are no best ones.
    const auto s = elastic->stress(0, 7e-3, r);
    EXPECT_NEAR(s.hoop, hoop, 1e-3 * scale) << r;
    EXPECT_NEAR(s.radial, radial_stress, 1e-3 * scale) << r;
    EXPECT_NEAR(s.axial, axial, 1e-3 * scale) << r;
  }
  // a derivative, as above
  EXPECT_NEAR(elastic->hoop_stress({0, HeatSide::inner}).mean,
              alpha * E / (1. - nu) * (2. * I(b) / (b * b - a * a) - 60.), 1e-3 * scale);
}

}  // namespace
}  // namespace rotordrop
