// Loops of thermal preload whose answers are known.
//
// ONE NODE of capacity C, a resistor R to ambient, growth u = k x of a rise x, friction heat H(u).
//   Linear, H = H_0 + a u:     gain L = a k R; rest at x = H_0 R / (1 - L) if L < 1; eigenvalue (L - 1) / (R C);
//                              from cold x(t) = H_0 R / (L - 1) (exp((L - 1) t / (R C)) - 1), so a limit X is met at
//                              t = R C / (L - 1) ln(1 + X (L - 1) / (H_0 R)).
//   Quadratic, H = H_0 + q u^2: with m = q k^2 R, rests at x = (1 -+ sqrt(1 - 4 m R H_0 )) / (2 m), gains 2 m x, that is 1 -+ the root;
//                              none if 4 m R H_0 > 1: for cooling by a factor f (R / f) if f^2 < 4 m R H_0.
//   Free convection, q = 23 S x^1.25: rest at x = (H / (23 S))^0.8 and dx/dH = 0.8 x / H.
//
// TWO NODES that do not touch, inner and outer, with shares s and 1 - s of the heat, growths k_i x_i and k_o x_o that work against each other:
//   gain L = a (k_i s R_i - k_o (1 - s) R_o), matrix [[-1/t_i + p_i, -p_o'], ...] of 2 x 2. With a fast inner node L < 1 may still be unstable.
//
// BALLS THAT CLOSE WITH HEAT. Of a heat Q into the inner node a part P goes over the balls, whose conductance is G = g sqrt(u - u_0) for u > u_0, u = k_i x_i - k_o x_o:
//   x_i = (Q - P) R_i, x_o = P R_o, P = G (x_i - x_o).
// With P chosen, u follows, and g = P / ((x_i - x_o) sqrt(u - u_0)). P falls with x_o and rises with x_i, so there is no other state.
#include "analysis/preload/preload_loop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/preload/build_preload.h"
#include "base/errors.h"
#include "integrate/integrator.h"
#include "study/preload/preload_steady.h"
#include "thermal/circuit/network_part.h"

namespace rotordrop {
namespace {

struct Law final : RunningBearing {
  Law(double at_rest, double linear, double square, double inner) : H_0(at_rest), a(linear), q(square), share(inner) {}
  [[nodiscard]] RunningState at(const Expansion& g) const override {
    const double u = g.inner_race - g.outer_race;
    RunningState s;
    s.heat = H_0 + a * u + q * u * u;
    s.preload = 100. + 2e8 * u;
    return s;
  }
  [[nodiscard]] double inner_share() const override { return share; }
  double H_0, a, q, share;
};

constexpr double C = 400., R = 0.5, k = 4e-7, ambient = 293.15;
const PreloadLimits wide{ambient + 1e4, 1e12};

ThermalNetworkData one_node(double resistance) {
  using Net = ThermalNetworkData;
  Net net;
  net.ambient = ambient;
  net.nodes = {{"B/ring", C, "ring"}};
  net.resistors = {{"B/ring", ambient_node, resistance, Net::Law::constant, 0., 0., 0}};
  net.places = {{"B/ring", "B/ring", "B/ring", "B/ring"}};
  net.growths = {{0, &Expansion::inner_race, "B/ring", k}};
  return net;
}

std::unique_ptr<PreloadLoop> loop_of(const ThermalNetworkData& net, double H_0, double a, double q, double share = 1.) {
  return std::make_unique<PreloadLoop>(std::make_shared<ThermalNetwork>(net), std::make_unique<Law>(H_0, a, q, share),
                                       net.places.size(), 0, net.ambient);
}

double rise_after(const PreloadLoop& loop, double time) {
  PreloadTransient system(loop);
  std::vector<double> y(system.layout().size());
  system.initial_state(y);
  const auto integrator = make_stiff_integrator(system, 1e-10, 0., y, time);
  while (integrator->time() < time) integrator->advance();
  return integrator->state()[0] - ambient;
}

TEST(PreloadLoop, LinearHeatRestsWhereItsGainSays) {
  const double H_0 = 20., a = 0.6 / (k * R);
  const auto loop = loop_of(one_node(R), H_0, a, 0.);
  const auto found = find_operating_points(*loop, wide);
  ASSERT_EQ(found.points.size(), 1u);
  const auto& p = found.points[0];
  EXPECT_NEAR(p.T[0] - ambient, H_0 * R / 0.4, 1e-8) << "K";
  EXPECT_NEAR(p.response.gain, 0.6, 1e-9);
  EXPECT_NEAR(p.response.heat_per_preload * p.response.preload_per_heat, 0.6, 1e-9);
  EXPECT_NEAR(p.response.preload_per_heat, 2e8 * k * R, 1e-7) << "N/W";
  EXPECT_NEAR(p.response.eigenvalue.real(), -0.4 / (R * C), 1e-10) << "1/s";
  EXPECT_NEAR(rise_after(*loop, 3000.), H_0 * R / 0.4 * (1. - std::exp(-0.4 * 3000. / (R * C))), 1e-5) << "K";
}

TEST(PreloadLoop, AGainAboveOneRunsAwayWhenTheClosedFormSays) {
  const double H_0 = 20., L = 1.5, limit = 80.;
  const auto loop = loop_of(one_node(R), H_0, L / (k * R), 0.);
  EXPECT_TRUE(find_operating_points(*loop, {ambient + limit, 1e12}).points.empty());
  EXPECT_EQ(find_operating_points(*loop, {ambient + limit, 1e12}).ended_by, LimitMet::temperature);
  const double when = R * C / (L - 1.) * std::log(1. + limit * (L - 1.) / (H_0 * R));
  EXPECT_NEAR(rise_after(*loop, when), limit, 1e-6 * limit) << "K";
  EXPECT_NEAR(response_at(*loop, std::vector<double>{ambient}).eigenvalue.real(), 0.5 / (R * C), 1e-10) << "1/s";
}

TEST(PreloadLoop, QuadraticHeatHasAStableAndAnUnstableRest) {
  const double H_0 = 20., m = 0.01, q = m / (k * k * R), root = std::sqrt(1. - 4. * m * R * H_0);
  const auto found = find_operating_points(*loop_of(one_node(R), H_0, 0., q), wide);
  ASSERT_EQ(found.points.size(), 2u);
  EXPECT_NEAR(found.points[0].T[0] - ambient, (1. - root) / (2. * m), 1e-8) << "K";
  EXPECT_NEAR(found.points[1].T[0] - ambient, (1. + root) / (2. * m), 1e-8) << "K";
  // Gains take differences over 2 mK of temperatures near 300 K, whose roundoff makes 3e-11 of them.
  EXPECT_NEAR(found.points[0].response.gain, 1. - root, 1e-9);
  EXPECT_NEAR(found.points[1].response.gain, 1. + root, 1e-9);
  EXPECT_TRUE(found.points[0].response.is_stable());
  EXPECT_FALSE(found.points[1].response.is_stable());
}

TEST(PreloadLoop, TheCriticalCoolingIsWhereBothRestsMeet) {
  const double H_0 = 20., m = 0.01, q = m / (k * k * R);
  const auto critical = find_critical_factor(
      [&](double factor) {
        auto net = one_node(R);
        scale_cooling(net, factor);
        return loop_of(net, H_0, 0., q);
      },
      0.5, wide);
  ASSERT_TRUE(critical);
  EXPECT_NEAR(critical->factor, std::sqrt(4. * m * R * H_0), 1.5e-4) << "the search ends within 1e-4";
  EXPECT_EQ(critical->by, CriticalFactor::By::loop);
  EXPECT_NEAR(critical->gain, 1., 0.03) << "1 less a root that vanishes with the distance's";
}

TEST(PreloadLoop, ALimitMetBeforeTheGainIsSaid) {
  const double H_0 = 20., m = 0.01, q = m / (k * k * R);
  const double limit = 12.;  // the rest at full cooling: 11.27 K; both meet at 50 K
  const auto critical = find_critical_factor(
      [&](double factor) {
        auto net = one_node(R);
        scale_cooling(net, factor);
        return loop_of(net, H_0, 0., q);
      },
      0.5, {ambient + limit, 1e12});
  ASSERT_TRUE(critical);
  EXPECT_EQ(critical->by, CriticalFactor::By::limit);
  // f x / R = H_0 + q k^2 x^2 at x = limit
  EXPECT_NEAR(critical->factor, R / limit * (H_0 + m / R * limit * limit), 1.5e-4);
}

TEST(PreloadLoop, FreeConvectionCountsWithItsLocalDerivative) {
  auto net = one_node(R);
  const double S = 0.01, H_0 = 15., a = 1e6;
  net.resistors = {{"B/ring", ambient_node, 0., ThermalNetworkData::Law::housing_convection, S, 0., 0}};
  const auto found = find_operating_points(*loop_of(net, H_0, a, 0.), {ambient + 500., 1e12});
  ASSERT_EQ(found.points.size(), 1u);
  const auto& p = found.points[0];
  const double x = p.T[0] - ambient;
  EXPECT_NEAR(23. * S * std::pow(x, 1.25), H_0 + a * k * x, 1e-8) << "W";
  // differences, as above
  EXPECT_NEAR(p.response.gain, a * k * 0.8 * x / p.heat, 1e-9);
}

TEST(PreloadLoop, AQuickInnerRingRunsAwayThoughTheSteadyGainIsBelowOne) {
  using Net = ThermalNetworkData;
  const double C_i = 50., C_o = 5000., R_i = 0.5, R_o = 0.5, k_i = 4e-7, k_o = 3e-7, share = 0.5;
  Net net;
  net.ambient = ambient;
  net.nodes = {{"B/inner", C_i, "inner"}, {"B/outer", C_o, "outer"}};
  net.resistors = {{"B/inner", ambient_node, R_i, Net::Law::constant, 0., 0., 0},
                   {"B/outer", ambient_node, R_o, Net::Law::constant, 0., 0., 0}};
  net.places = {{"B/inner", "B/inner", "B/inner", "B/outer"}};
  net.growths = {{0, &Expansion::inner_race, "B/inner", k_i}, {0, &Expansion::outer_race, "B/outer", k_o}};
  for (const double inner_gain : {0.8, 1.5, 3.}) {
    const double a = inner_gain / (share * R_i * k_i);
    const auto loop = loop_of(net, 20., a, 0., share);
    const double L = a * (share * R_i * k_i - (1. - share) * R_o * k_o);
    const std::vector<double> T = {ambient + 10., ambient + 10.};
    const auto r = response_at(*loop, T);
    // differences, as above
    EXPECT_NEAR(r.gain, L, 1e-9);
    EXPECT_LT(r.gain, 1.);
    // J + b c^T
    const double A11 = -1. / (R_i * C_i) + share / C_i * a * k_i, A12 = -share / C_i * a * k_o,
                 A21 = (1. - share) / C_o * a * k_i, A22 = -1. / (R_o * C_o) - (1. - share) / C_o * a * k_o;
    const double trace = A11 + A22, determinant = A11 * A22 - A12 * A21, under = 0.25 * trace * trace - determinant;
    const double real = under > 0. ? 0.5 * trace + std::sqrt(under) : 0.5 * trace;
    EXPECT_NEAR(r.eigenvalue.real(), real, 1e-9) << "1/s";
    EXPECT_EQ(r.is_stable(), inner_gain < 1.);
    EXPECT_GT(r.largest_gain, inner_gain < 1. ? r.gain : 1.);
  }
}

TEST(PreloadLoop, AnEigenvaluePassesZeroWhereTheGainPassesOne) {
  for (double L = 0.9; L < 1.1; L += 0.02) {
    const auto loop = loop_of(one_node(R), 20., L / (k * R), 0.);
    const auto r = response_at(*loop, std::vector<double>{ambient + 5.});
    EXPECT_EQ(r.gain < 1., r.eigenvalue.real() < 0.) << L;
  }
}

TEST(PreloadLoop, HeatMadeIsLostOrStored) {
  const auto loop = loop_of(one_node(R), 20., 0.5 / (k * R), 0.);
  PreloadTransient system(*loop);
  std::vector<double> y(system.layout().size());
  system.initial_state(y);
  const auto integrator = make_stiff_integrator(system, 1e-9, 0., y, 1000.);
  while (integrator->time() < 1000.) integrator->advance();
  const auto end = integrator->state();
  const double x = end[0] - ambient;
  // x = 20 (1 - e^(-t/400)) K: made = integral of 20 + 1 x, lost = integral of 2 x [W]
  const double integral = 20. * (1000. - 400. * (1. - std::exp(-1000. / 400.)));
  EXPECT_NEAR(end[1], 20. * 1000. + integral, 1e-4 * end[1]) << "J";
  EXPECT_NEAR(end[1] - end[2] - C * x, 0., 1e-6 * end[1]) << "J";
}

// Inner and outer ring, the inner one a hundred times as quick. With the quick one alone u = i Q, later u = s Q, for H = H_0 + q u^2: no rest in
// the first if 4 q i^2 H_0 > 1, one in the second if 4 q s^2 H_0 < 1.
std::unique_ptr<PreloadLoop> quick_and_slow(double H_0, double q, double k_o) {
  using Net = ThermalNetworkData;
  Net net;
  net.ambient = ambient;
  net.nodes = {{"B/inner", 50., "inner"}, {"B/outer", 5000., "outer"}};
  net.resistors = {{"B/inner", ambient_node, R, Net::Law::constant, 0., 0., 0},
                   {"B/outer", ambient_node, R, Net::Law::constant, 0., 0., 0}};
  net.places = {{"B/inner", "B/inner", "B/inner", "B/outer"}};
  net.growths = {{0, &Expansion::inner_race, "B/inner", k}, {0, &Expansion::outer_race, "B/outer", k_o}};
  return loop_of(net, H_0, 0., q, 0.5);
}

struct ClosingBalls final : RunningBearing {
  ClosingBalls(double factor, double touch) : g(factor), u_0(touch) {}
  [[nodiscard]] RunningState at(const Expansion& growth) const override {
    RunningState s;
    s.heat = 50.;
    s.balls.inner_to_outer = g * std::sqrt(std::max(growth.inner_race - growth.outer_race - u_0, 0.));
    return s;
  }
  [[nodiscard]] bool balls_roll() const override { return true; }
  [[nodiscard]] double inner_share() const override { return 1.; }
  double g, u_0;
};

TEST(PreloadLoop, ASteadyStateOfBallsThatJustCloseIsFoundHoweverSteepTheirConductance) {
  using Net = ThermalNetworkData;
  const double R_i = 4., R_o = 0.5, k_i = 4e-7, k_o = 3e-7, Q = 50.;
  Net net;
  net.ambient = ambient;
  net.nodes = {{"B/inner", 300., "inner"}, {"B/outer", 600., "outer"}, {"B/ball", 100., "balls"}};
  net.resistors = {{"B/inner", ambient_node, R_i, Net::Law::constant, 0., 0., 0},
                   {"B/outer", ambient_node, R_o, Net::Law::constant, 0., 0., 0},
                   {"B/ball", ambient_node, 1., Net::Law::constant, 0., 0., 0}};
  net.places = {{"B/inner", "B/inner", "B/inner", "B/outer", "B/ball", 1.}};
  net.growths = {{0, &Expansion::inner_race, "B/inner", k_i}, {0, &Expansion::outer_race, "B/outer", k_o}};
  for (const double P : {5., 20., 35.}) {
    const double x_i = (Q - P) * R_i, x_o = P * R_o, u = k_i * x_i - k_o * x_o;
    for (const double closed : {1e-6, 1e-8, 1e-10, 1e-12}) {  // by how much the balls are closed there [m]
      const PreloadLoop loop(std::make_shared<ThermalNetwork>(net),
                             std::make_unique<ClosingBalls>(P / ((x_i - x_o) * std::sqrt(closed)), u - closed), 1, 0,
                             ambient);
      for (const auto& start : {loop.cold(), std::vector<double>{ambient + 200., ambient + 1., ambient}}) {
        const auto T = loop.steady(Q, start);
        EXPECT_NEAR(T[0] - ambient, x_i, 1e-5) << "K, closed by " << closed << " m";
        EXPECT_NEAR(T[1] - ambient, x_o, 1e-5) << "K, closed by " << closed << " m";
      }
    }
  }
}

/// Has no rest where it has grown by more than a given length.
struct Fragile final : RunningBearing {
  Fragile(double heat, double most) : H(heat), u_most(most) {}
  [[nodiscard]] RunningState at(const Expansion& growth) const override {
    if (std::fabs(growth.inner_race) > u_most) throw SolverError("no rest");
    RunningState s;
    s.heat = H;
    return s;
  }
  [[nodiscard]] bool balls_roll() const override { return true; }
  [[nodiscard]] double inner_share() const override { return 1.; }
  double H, u_most;
};

TEST(PreloadLoop, FromColdNoTemperatureIsTriedThatIsFarAboveTheSteadyOne) {
  // Near no rise the film has hardly a slope: a tangent there leads ten times too far.
  auto net = one_node(R);
  const double S = 0.01, H = 30., x = std::pow(H / (23. * S), 0.8);
  net.resistors = {{"B/ring", ambient_node, 0., ThermalNetworkData::Law::housing_convection, S, 0., 0}};
  const PreloadLoop loop(std::make_shared<ThermalNetwork>(net), std::make_unique<Fragile>(H, 1.5 * k * x), 1, 0,
                         ambient);
  EXPECT_NEAR(loop.steady(H, loop.cold())[0] - ambient, x, 1e-6) << "K";
}

TEST(PreloadLoop, WhereThereIsNoRestTheSearchEndsAndTheRestOfItStands) {
  const double H = 30., most = 20.;  // rest at H R = 15 K, none beyond 20 K
  const auto loop = [&](double heat) {
    return std::make_unique<PreloadLoop>(std::make_shared<ThermalNetwork>(one_node(R)),
                                         std::make_unique<Fragile>(heat, k * most), 1, 0, ambient);
  };
  const auto found = find_operating_points(*loop(H), wide);
  ASSERT_EQ(found.points.size(), 1u);
  EXPECT_NEAR(found.points[0].T[0] - ambient, H * R, 1e-6) << "K";
  EXPECT_EQ(found.ended_by, LimitMet::no_state);
  EXPECT_NEAR(found.heat.back(), most / R, 1e-4 * most / R) << "W; the search ends within 1e-6 of it";
  EXPECT_TRUE(find_operating_points(*loop(50.), wide).points.empty());
  const auto critical = find_critical_factor([&](double f) { return loop(f * H); }, 2., wide);
  ASSERT_TRUE(critical);
  EXPECT_EQ(critical->by, CriticalFactor::By::no_state);
  EXPECT_LT(critical->factor, most / (H * R));
  // The search ends within 1e-4, and a point needs neighbours within 4e-8 m for its response.
  EXPECT_NEAR(critical->factor, most / (H * R), (2e-4 + 4e-8 / (k * most)) * most / (H * R));
}

TEST(PreloadVerdict, PutsWayAndCriterionTogether) {
  auto settings = preload_section().defaults();
  settings.temperature_limit = ambient + 300.;
  const auto verdict = [&](const PreloadLoop& loop) {
    const auto way = follow_preload(loop, settings, "/");
    auto points = find_operating_points(loop, preload_limits(settings));
    return verdict_of(way, points, add_settled(loop, {way.y.data(), loop.size()}, points));
  };
  const double i = k * 0.5 * R, H_0 = 20.;
  EXPECT_EQ(verdict(*quick_and_slow(H_0, 0.2 / (i * i * H_0), 0.7 * k)), "stable");
  EXPECT_EQ(verdict(*quick_and_slow(H_0, 0.5 / (i * i * H_0), 0.7 * k)), "runs-away-on-the-way");
  EXPECT_EQ(verdict(*quick_and_slow(H_0, 0.5 / (i * i * H_0), 0.)), "runs-away");
  settings.end_time = 10.;
  EXPECT_EQ(verdict(*quick_and_slow(H_0, 0.2 / (i * i * H_0), 0.7 * k)), "undecided");
  settings.temperature_limit = ambient - 1.;
  EXPECT_EQ(verdict(*quick_and_slow(H_0, 0.2 / (i * i * H_0), 0.7 * k)), "seized-from-the-start");
}

TEST(PreloadVerdict, TheInstantOfALimitIsThatOfTheClosedForm) {
  auto settings = preload_section().defaults();
  settings.temperature_limit = ambient + 80.;
  settings.tolerance = 1e-9;
  const double H_0 = 20., L = 1.5;
  const auto course = follow_preload(*loop_of(one_node(R), H_0, L / (k * R), 0.), settings, "/");
  EXPECT_EQ(course.limit, LimitMet::temperature);
  const double when = R * C / (L - 1.) * std::log(1. + 80. * (L - 1.) / (H_0 * R));
  EXPECT_NEAR(course.time, when, 1e-5 * when) << "s";
  EXPECT_NEAR(course.y[0] - ambient, 80., 1e-5) << "K";
}

TEST(PreloadVerdict, TheInstantOfSettlingIsThatOfTheClosedForm) {
  const double H_0 = 20., L = 0.4, tau = R * C / (1. - L);
  auto settings = preload_section().defaults();
  const double when = tau * std::log(H_0 / (C * settings.settled_rate));
  for (const double tolerance : {1e-7, 1e-8, 1e-9, 1e-10}) {
    settings.tolerance = tolerance;
    const auto course = follow_preload(*loop_of(one_node(R), H_0, L / (k * R), 0.), settings, "/");
    ASSERT_TRUE(course.is_settled);
    const auto& times = course.table.axis;
    const double step = times.back() - times[times.size() - 2];
    // The tolerance of some 300 K, by the rate at which what is left goes; and the mean rate of a step is the middle's times sinh(x)/x, x = step / (2 tau).
    EXPECT_NEAR(course.time, when, tolerance * 300. / settings.settled_rate + step * step / (20. * tau))
        << "s, by " << tolerance;
    EXPECT_GE(times.back(), course.time);
  }
}

TEST(NetworkPart, KeepsWhatHeatCanReachAndNothingElse) {
  using Net = ThermalNetworkData;
  Net net;
  net.nodes = {{"A/ring", 1., ""}, {"B/ring", 2., ""}, {"B/housing", 3., ""}, {"frame", 4., ""}, {"D/ring", 5., ""}};
  net.resistors = {{"A/ring", ambient_node, 1., Net::Law::constant, 0., 0., 0},
                   {"B/ring", "B/housing", 2., Net::Law::contact, 0., 20., 1},
                   {"B/housing", "frame", 3., Net::Law::constant, 0., 0., 0},
                   {"D/ring", "frame", 4., Net::Law::constant, 0., 0., 0},
                   {"frame", ambient_node, 5., Net::Law::constant, 0., 0., 0}};
  net.places = {{"A/ring", "A/ring", "A/ring", "A/ring"},
                {"B/ring", "B/ring", "B/ring", "B/ring"},
                {"D/ring", "D/ring", "D/ring", "D/ring"}};
  net.growths = {
      {0, &Expansion::bore, "A/ring", 1.}, {1, &Expansion::bore, "B/ring", 2.}, {2, &Expansion::bore, "D/ring", 3.}};
  const auto part = part_around(net, 1);
  EXPECT_EQ(part.place, 0u);
  ASSERT_EQ(part.data.places.size(), 2u);  // D sits on the same frame
  EXPECT_EQ(part.data.places[1].ring_node, "D/ring");
  ASSERT_EQ(part.data.nodes.size(), 4u);
  EXPECT_EQ(part.data.resistors.size(), 4u);
  EXPECT_EQ(part.data.resistors[0].place, 0u);
  ASSERT_EQ(part.data.growths.size(), 2u);
  EXPECT_EQ(part.data.growths[1].place, 1u);
  EXPECT_EQ(part_around(net, 0).data.nodes.size(), 1u);
}

}  // namespace
}  // namespace rotordrop
