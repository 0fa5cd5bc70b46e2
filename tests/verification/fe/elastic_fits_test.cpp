// Fits of rings of equal width, frictionless: Lame's plane stress, exactly. Ring a < r < b in a housing b < r < c, with the interference d (by
// radius) that is left when both have grown freely:
//   p = d / {b/E_h [(c^2 + b^2)/(c^2 - b^2) + nu_h] + b/E_r [(b^2 + a^2)/(b^2 - a^2) - nu_r]},   d = d_0 + b (alpha_r theta_r - alpha_h theta_h),
//   u(a) = alpha_r a theta_r - 2 p a b^2/(E_r (b^2 - a^2)),   u(c) = alpha_h c theta_h + 2 p b^2 c/(E_h (c^2 - b^2)).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/errors.h"
#include "fe_room.h"
#include "thermal/section/fit_opening.h"

namespace rotordrop {
namespace {

constexpr double T_0 = 293.15, a = 46e-3, b = 50e-3, c = 60e-3, L = 16e-3;
constexpr double E_r = 2.05e11, nu_r = 0.3, alpha_r = 11.8e-6, E_h = 0.7e11, nu_h = 0.33, alpha_h = 23e-6;

struct Lame {
  double pressure, bore, outside;
};
Lame lame(double d_0, double theta_r, double theta_h) {
  const double d = d_0 + b * (alpha_r * theta_r - alpha_h * theta_h);
  const double compliance =
      b / E_h * ((c * c + b * b) / (c * c - b * b) + nu_h) + b / E_r * ((b * b + a * a) / (b * b - a * a) - nu_r);
  const double p = std::max(d, 0.) / compliance;
  return {p, alpha_r * a * theta_r - 2. * p * a * b * b / (E_r * (b * b - a * a)),
          alpha_h * c * theta_h + 2. * p * b * b * c / (E_h * (c * c - b * b))};
}

ElasticProblem press_fit(double interference, int cells = 12) {
  ElasticProblem p;
  p.bodies = {{"ring", {0., L}, {a, b}, 7800., E_r, nu_r, PropertyTable(alpha_r), 0.},
              {"housing", {0., L}, {b, c}, 2700., E_h, nu_h, PropertyTable(alpha_h), 0.}};
  p.fits = {{"seat", {0, HeatSide::outer}, {1, HeatSide::inner}, interference}};
  p.outputs = {{"bore", {{0, HeatSide::inner}}}, {"outside", {{1, HeatSide::outer}}}};
  p.numerics.cells = cells;
  return p;
}
std::vector<double> warm(const ElasticSolver& s, double theta_r, double theta_h) {
  return s.interpolate([=](std::size_t body, double, double) { return T_0 + (body == 0 ? theta_r : theta_h); });
}
void expect_lame(ElasticSolver& s, const Lame& expected) {
  // 1/r in quadratic elements of 1/140 of the radius: means err by about the fourth power, 3e-9.
  EXPECT_NEAR(s.output(0), expected.bore, 1e-8 * std::fabs(expected.bore));
  EXPECT_NEAR(s.output(1), expected.outside, 1e-8 * std::fabs(expected.outside));
  const FitState fit = s.fit(0);
  EXPECT_NEAR(fit.mean_pressure, expected.pressure, 1e-8 * expected.pressure);
  EXPECT_EQ(fit.open_fraction, 0.);
  // Even along the fit: each value of the projection is one of the shape functions' derivative order.
  EXPECT_NEAR(fit.lowest_pressure, expected.pressure, 1e-4 * expected.pressure);
  EXPECT_NEAR(fit.highest_pressure, expected.pressure, 1e-4 * expected.pressure);
}

TEST(PressFit, IsLames) {
  const auto s = make_elastic_solver(press_fit(10e-6));
  expect_lame(*s, lame(10e-6, 0., 0.));
  const double hoop = -2. * lame(10e-6, 0., 0.).pressure * b * b / (b * b - a * a);
  // A stress errs by the second power, 5e-5 times a factor.
  EXPECT_NEAR(s->hoop_stress({0, HeatSide::inner}).lowest, hoop, 1e-4 * std::fabs(hoop));
}

TEST(PressFit, IsLamesWithDifferentTemperaturesOfRaceAndHousing) {
  const auto s = make_elastic_solver(press_fit(10e-6));
  for (const auto& [theta_r, theta_h] : {std::pair{60., 5.}, std::pair{0., 6.}, std::pair{30., 20.}}) {
    s->solve(warm(*s, theta_r, theta_h), 0.);
    expect_lame(*s, lame(10e-6, theta_r, theta_h));
  }
}

// The order of the two sides of a fit is a name, no more.
TEST(PressFit, IsTheSameSeenFromTheHousing) {
  auto problem = press_fit(10e-6);
  std::swap(problem.fits[0].first, problem.fits[0].second);
  const auto s = make_elastic_solver(problem);
  s->solve(warm(*s, 30., 10.), 0.);
  expect_lame(*s, lame(10e-6, 30., 10.));
}

TEST(Fit, OpensAllTheWayWhenTheHousingOutgrowsTheInterferenceAndClosesAgain) {
  const auto s = make_elastic_solver(press_fit(10e-6));
  s->solve(warm(*s, 5., 40.), 0.);
  EXPECT_TRUE(s->fits_changed());
  const FitState open = s->fit(0);
  EXPECT_NEAR(open.open_fraction, 1., 1e-12);
  EXPECT_EQ(open.mean_pressure, 0.);
  // u = alpha theta r is one of the elements: roundoff.
  EXPECT_NEAR(s->output(0), alpha_r * a * 5., 1e-9 * alpha_r * a * 5.);
  EXPECT_NEAR(s->output(1), alpha_h * c * 40., 1e-9 * alpha_h * c * 40.);
  const double gap = b * (alpha_h * 40. - alpha_r * 5.) - 10e-6;
  for (const auto& point : open.points) EXPECT_NEAR(point.gap, gap, 1e-9 * gap);

  s->solve(warm(*s, 60., 5.), 0.);
  EXPECT_TRUE(s->fits_changed());
  expect_lame(*s, lame(10e-6, 60., 5.));
}

TEST(Clearance, ClosesWhenTheRingOutgrowsIt) {
  const auto s = make_elastic_solver(press_fit(-10e-6));
  EXPECT_NEAR(s->fit(0).open_fraction, 1., 1e-12);
  EXPECT_EQ(s->output(0), 0.);
  s->solve(warm(*s, 10., 0.), 0.);
  EXPECT_NEAR(s->fit(0).open_fraction, 1., 1e-12);
  s->solve(warm(*s, 60., 0.), 0.);
  expect_lame(*s, lame(-10e-6, 60., 0.));
}

// A ring heated in its middle bulges: the ends of its fit open. No closed form; what must hold is that nothing pulls and nothing overlaps.
TEST(Fit, OpensInPartWithoutPullOrOverlap) {
  const auto s = make_elastic_solver(press_fit(3e-6, 24));
  s->solve(s->interpolate([](std::size_t body, double x, double) {
    return T_0 + (body == 0 ? 40. * std::exp(-std::pow((x - 0.5 * L) / 4e-3, 2)) : 0.);
  }),
           0.);
  const FitState fit = s->fit(0);
  EXPECT_GT(fit.open_fraction, 0.2);
  EXPECT_LT(fit.open_fraction, 0.9);
  double force = 0.;
  for (const auto& point : fit.points) {
    EXPECT_GE(point.gap, -1e-14);
    if (point.is_closed) {
      EXPECT_EQ(point.gap, 0.);
      force = std::max(force, point.pressure);
    }
  }
  EXPECT_EQ(force, fit.highest_pressure);
  EXPECT_GT(fit.lowest_pressure, -0.05 * fit.highest_pressure);  // of the projection at the last closed node
  // The middle is closed, the ends are open.
  for (const auto& point : fit.points) {
    if (std::fabs(point.x - 0.5 * L) < 1e-3) {
      EXPECT_TRUE(point.is_closed) << point.x;
    }
    if (point.x < 0.5e-3 || point.x > L - 0.5e-3) {
      EXPECT_FALSE(point.is_closed) << point.x;
    }
  }
}

// Cut in two along a cylinder and bonded again, a ring is whole; free to slide there it is not, if its halves are of unlike warmth.
TEST(BondedFit, MakesOneBodyOfTwo) {
  const auto field = [](std::size_t, double x, double r) {
    return T_0 + 80. * std::exp(-(r - a) / 4e-3) * (1. + std::sin(200. * x));
  };
  ElasticProblem whole;
  whole.bodies = {{"whole", {0., L}, {a, c}, 7800., E_r, nu_r, PropertyTable(alpha_r), 1.}};
  whole.outputs = {{"bore", {{0, HeatSide::inner}}}};
  whole.numerics.cells = 40;
  auto cut = press_fit(0., 32);
  for (auto& body : cut.bodies) body = {body.name, body.x, body.r, 7800., E_r, nu_r, PropertyTable(alpha_r), 1.};
  cut.fits[0].kind = FitKind::bonded;
  const auto one = make_elastic_solver(whole), two = make_elastic_solver(cut);
  one->solve(one->interpolate(field), 1500.);
  two->solve(two->interpolate(field), 1500.);
  // Two meshes: means differ by 5e-9, points by 6e-6.
  EXPECT_NEAR(two->output(0), one->output(0), 1e-7 * one->output(0));
  for (const double x : {0., 4e-3, L})
    for (const double r : {a, b, 57e-3}) {
      const auto u = one->displacement(0, x, r), v = two->displacement(r <= b ? 0 : 1, x, r);
      for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(v[k], u[k], 1e-5 * one->output(0));
    }
  cut.fits[0].kind = FitKind::frictionless;
  cut.fits[0].interference = 20e-6;
  const auto sliding = make_elastic_solver(cut);
  sliding->solve(sliding->interpolate(field), 1500.);
  EXPECT_EQ(sliding->fit(0).open_fraction, 0.);
  EXPECT_GT(std::fabs(sliding->displacement(0, 0., b)[0] - sliding->displacement(1, 0., b)[0]), 1e-8);
}

// Of two washers, face on face and held between walls, the pressure is E alpha theta / 1 when both are in uniaxial stress (nu = 0).
TEST(FaceFit, PassesAxialPressure) {
  constexpr double theta = 30.;
  ElasticProblem p;
  p.bodies = {{"left", {0., 5e-3}, {a, b}, 7800., E_r, 0., PropertyTable(alpha_r), 0.},
              {"right", {5e-3, 9e-3}, {a, b}, 7800., E_r, 0., PropertyTable(alpha_r), 0.}};
  p.fits = {{"face", {0, HeatSide::right}, {1, HeatSide::left}, 0.}};
  p.holds = {{{0, HeatSide::left}, true, false}, {{1, HeatSide::right}, true, false}};
  const auto s = make_elastic_solver(p);
  s->solve(std::vector<double>(s->n_nodes(), T_0 + theta), 0.);
  EXPECT_NEAR(s->fit(0).mean_pressure, E_r * alpha_r * theta, 1e-9 * E_r * alpha_r * theta);
  EXPECT_NEAR(s->stress(1, 7e-3, 48e-3).axial, -E_r * alpha_r * theta, 1e-9 * E_r * alpha_r * theta);
  s->solve(std::vector<double>(s->n_nodes(), T_0 - theta), 0.);  // colder: they part, each held by its wall
  EXPECT_NEAR(s->fit(0).open_fraction, 1., 1e-12);
  EXPECT_NEAR(s->displacement(0, 5e-3, 48e-3)[0], -alpha_r * theta * 5e-3, 1e-9 * alpha_r * theta * 5e-3);
}

TEST(Fit, ThatDoesNotExistIsRefused) {
  auto problem = press_fit(0.);
  problem.fits[0].second = {1, HeatSide::outer};
  EXPECT_THROW(make_elastic_solver(problem), SolverError);
  problem = press_fit(0.);
  problem.fits[0].first.side = HeatSide::strip;
  EXPECT_THROW(make_elastic_solver(problem), SolverError);
  problem = press_fit(0.);
  problem.fits.push_back(problem.fits[0]);
  EXPECT_THROW(make_elastic_solver(problem), SolverError);
}

// ------------------------------------------------------------------------------------------------------------------ adjoints

double predicted(const ElasticInfluence& g, const std::vector<double>& T, double speed) {
  double value = g.at_rest + g.per_speed_squared * speed * speed;
  for (std::size_t i = 0; i < g.weights.size(); ++i) value += g.weights[i] * (T[i] - T_0);
  return value;
}

ElasticProblem with_everything() {
  auto p = press_fit(60e-6, 8);
  p.bodies[0].spin = 1.;
  p.bodies.push_back({"inner", {2e-3, L}, {30e-3, 40e-3}, 7800., E_r, nu_r, PropertyTable(alpha_r), 1.});
  p.bodies.push_back({"sleeve", {2e-3, 10e-3}, {40e-3, 43e-3}, 2700., E_h, nu_h, PropertyTable(alpha_h), 1.});
  p.fits.push_back({"sleeve seat", {2, HeatSide::outer}, {3, HeatSide::inner}, 0., FitKind::bonded});
  p.holds = {{{1, HeatSide::outer}, true, true}};
  p.tractions = {{{0, HeatSide::inner}, 2e6}};
  const double angle = 0.4;
  p.outputs = {{"bore", {{0, HeatSide::inner}}},
               {"axial", {{0, HeatSide::left}}, {1., 0.}},
               {"normal", {{3, HeatSide::outer}, {2, HeatSide::right}}, {std::sin(angle), std::cos(angle)}}};
  return p;
}

TEST(AdjointGrowth, EqualsTheDirectSolveWhileFitsStayClosed) {
  const auto s = make_elastic_solver(with_everything());
  std::vector<ElasticInfluence> outputs, pressures;
  for (std::size_t k = 0; k < 3; ++k) outputs.push_back(s->influence(k));
  for (std::size_t k = 0; k < 2; ++k) pressures.push_back(s->pressure_influence(k));
  const auto nodes = s->node_pressure_influences(0);
  for (const double speed : {0., 900.})
    for (const double wave : {100., 400., 1500.}) {
      const auto T = s->interpolate([=](std::size_t body, double x, double r) {
        return T_0 + 20. + 15. * std::sin(wave * x + static_cast<double>(body)) * std::cos(wave * r);
      });
      s->solve(T, speed);
      EXPECT_FALSE(s->fits_changed());
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(predicted(outputs[k], T, speed), s->output(k), 1e-10 * std::fabs(s->output(k))) << k;
      for (std::size_t k = 0; k < 2; ++k) {
        const double p = s->fit(k).mean_pressure;
        EXPECT_NEAR(predicted(pressures[k], T, speed), p, 1e-9 * std::fabs(p)) << k;  // forces are sums that cancel
      }
    }
}

// The first node that would pull says when the fit begins to open.
TEST(AdjointPressure, SaysWhenTheFitBeginsToOpen) {
  const auto s = make_elastic_solver(press_fit(4e-6, 16));
  const auto nodes = s->node_pressure_influences(0);
  const auto field = [&](double factor) {
    return s->interpolate([factor](std::size_t body, double x, double r) {
      return T_0 + factor * (body == 1 ? 40. * x / L : 30. * std::exp(-(r - a) / 1e-3));
    });
  };
  const auto T = field(1.), none = field(0.);
  double first = 1e9;
  for (const auto& node : nodes) {
    const double at_rest = predicted(node, none, 0.), then = predicted(node, T, 0.);
    EXPECT_GT(at_rest, 0.);
    if (then < at_rest) first = std::min(first, at_rest / (at_rest - then));
  }
  ASSERT_LT(first, 10.);
  s->solve(field(first * (1. - 1e-6)), 0.);
  EXPECT_EQ(s->fit(0).open_fraction, 0.);
  s->solve(field(first * (1. + 1e-6)), 0.);
  EXPECT_GT(s->fit(0).open_fraction, 0.);
}

// Gaps of nodes as unknowns of a small problem, and the whole one solved: growth and fit are the same wherever the fit opens.
TEST(FitOpenings, GiveWhatTheDirectSolveGives) {
  const auto s = make_elastic_solver(press_fit(3e-6, 16));
  const std::array<ElasticInfluence, 2> outputs = {s->influence(0), s->influence(1)};
  const auto nodes = s->node_pressure_influences(0);
  FitOpening opening(s->openings(0));
  double least_open = 1., most_open = 0.;
  for (const double middle : {0., 0.2 * L, 0.5 * L, 0.9 * L})
    for (const double width : {2e-3, 6e-3})
      for (const double rise : {-30., 5., 40.}) {
        const auto T = s->interpolate([=](std::size_t body, double x, double) {
          return T_0 + (body == 0 ? rise * std::exp(-std::pow((x - middle) / width, 2)) : 0.);
        });
        std::vector<double> pressures;
        for (const auto& node : nodes) pressures.push_back(predicted(node, T, 0.));
        opening.solve(pressures, std::vector<double>(pressures.size(), 0.));
        s->solve(T, 0.);
        for (std::size_t k = 0; k < 2; ++k)
          EXPECT_NEAR(predicted(outputs[k], T, 0.) + opening.added(k), s->output(k),
                      1e-9 * (std::fabs(s->output(k)) + 3e-6));
        const FitState direct = s->fit(0), small = opening.state();
        // The same equations by fewer unknowns: roundoff.
        EXPECT_NEAR(small.mean_pressure, direct.mean_pressure, 1e-9 * direct.highest_pressure);
        EXPECT_NEAR(small.lowest_pressure, direct.lowest_pressure, 1e-9 * direct.highest_pressure);
        EXPECT_NEAR(small.highest_pressure, direct.highest_pressure, 1e-9 * direct.highest_pressure);
        EXPECT_NEAR(small.open_fraction, direct.open_fraction, 1e-12);
        EXPECT_NEAR(small.area, direct.area, 1e-12 * direct.area);
        least_open = std::min(least_open, direct.open_fraction);
        most_open = std::max(most_open, direct.open_fraction);
      }
  EXPECT_EQ(least_open, 0.);
  EXPECT_GT(most_open, 0.5);
}

// Even warmth, by Lame: a housing that outgrows the interference lets go everywhere, and both parts are as large as if alone.
TEST(FitOpenings, LetGoAllTheWayOfAHousingThatOutgrowsTheInterference) {
  const auto s = make_elastic_solver(press_fit(3e-6));
  const auto bore = s->influence(0), outside = s->influence(1);
  const auto nodes = s->node_pressure_influences(0);
  FitOpening opening(s->openings(0));
  for (const double rise : {-20., 1., 60.}) {  // 3 um are 2.6 K
    const auto T = warm(*s, 0., rise);
    std::vector<double> pressures;
    for (const auto& node : nodes) pressures.push_back(predicted(node, T, 0.));
    opening.solve(pressures, std::vector<double>(pressures.size(), 0.));
    const Lame expected = lame(3e-6, 0., rise);
    // as in expect_lame()
    EXPECT_NEAR(predicted(bore, T, 0.) + opening.added(0), expected.bore, 1e-8 * 3e-6);
    EXPECT_NEAR(predicted(outside, T, 0.) + opening.added(1), expected.outside, 1e-8 * std::fabs(expected.outside));
    EXPECT_NEAR(opening.state().mean_pressure, expected.pressure, 1e-8 * expected.pressure);
    EXPECT_NEAR(opening.state().open_fraction, rise > 2.6 ? 1. : 0., 1e-12);
  }
}

TEST(FitOpenings, AreNoneOfFitsThatNeedThemselvesSolved) {
  EXPECT_TRUE(make_elastic_solver(press_fit(-10e-6))->openings(0).share.empty()) << "open at rest";
  EXPECT_TRUE(make_elastic_solver(with_everything())->openings(1).share.empty()) << "bonded";
  auto held = press_fit(3e-6);
  held.holds = {{{1, HeatSide::left}, true, true}};
  EXPECT_TRUE(make_elastic_solver(held)->openings(0).share.empty()) << "at its edge";
}

}  // namespace
}  // namespace rotordrop
