// Circuits whose contacts conduct by HeatInput::balls.
//
// Conductances 1/R5 at both contacts and none through the balls are the circuit with two resistors R5. For others the contacts' temperatures follow from their own
// balances, by a dense solution here:
//   0 = (T_i - T_ci)/R4 + G_ib (T_b - T_ci) + G_io (T_co - T_ci) + H_i,    0 = (T_o - T_co)/R7 + G_ob (T_b - T_co) + G_io (T_ci - T_co) + H_o.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "thermal/circuit/bearing_circuit.h"
#include "thermal/circuit/network_part.h"
#include "thermal/section/reduced_sections.h"

namespace rotordrop {
namespace {

constexpr double ambient = 293.15;

BearingCircuitData bearing(bool rolls) {
  BearingCircuitData b;
  b.name = "B";
  b.ring = b.shaft = {46., 470., 7800., 11.8e-6, 0.3};
  b.ball = {30., 700., 3200., 3.2e-6, 0.26};
  b.width = b.shaft_length = 20e-3;
  b.journal_radius = 34.75e-3;
  b.ring_mass = 0.21;
  b.inner_bore = 70e-3;
  b.inner_outside = 78e-3;
  b.outer_bore = 97.2e-3;
  b.outer_outside = b.housing_bore = 110e-3;
  b.housing_outside = 130e-3;
  b.housing_length = 25e-3;
  b.n_balls = 14;
  b.ball_diameter = 11.906e-3;
  b.h_shaft = b.h_ball = 50.;
  b.fit_resistance = 0.005;
  b.contact_half_width = 0.4e-3;
  b.races = {39e-3, 48.6e-3, 20e-3};
  b.strips = BearingCircuitData::Strips{{10e-3}, {10e-3}, 4e-3, 4e-3, 39e-3, 51e-3, 0.4e-3};
  b.balls_roll = rolls;
  return b;
}

ThermalNetworkData network(const BearingCircuitData& b) {
  ThermalNetworkData data;
  data.ambient = ambient;
  add_bearing_circuit(b, data);
  return data;
}

// States: shaft, inner ring, ball, outer ring, housing.
const std::vector<double> warm = {ambient + 3., ambient + 11., ambient + 2., ambient + 7., ambient + 5.};

HeatInput heat_with(const BallConduction& balls) {
  HeatInput h;
  h.rub = 40.;
  h.rub_into_ring = 25.;
  h.inner = 13.;
  h.outer = 17.;
  h.balls = balls;
  return h;
}

TEST(RollingNetwork, WithThePublishedResistanceIsThePublishedCircuit) {
  auto b = bearing(false);
  b.factors.ball = 1.3;
  const ThermalNetwork fixed(network(b));
  b.balls_roll = true;
  const ThermalNetwork rolling(network(b));
  const auto R = circuit_resistances(b);
  const double G = 1. / (R.R5_inside + R.R5_constriction);
  const HeatInput h = heat_with({G, G, 0.});
  std::vector<double> by_fixed(5), by_rolling(5), shown_fixed(7), shown_rolling(7);
  const double lost_fixed = fixed.rates(warm, {&h, 1}, by_fixed), lost = rolling.rates(warm, {&h, 1}, by_rolling);
  EXPECT_NEAR(lost, lost_fixed, 1e-12 * lost_fixed);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(by_rolling[i], by_fixed[i], 1e-12) << "K/s";
  fixed.observe(warm, {&h, 1}, shown_fixed);
  rolling.observe(warm, {&h, 1}, shown_rolling);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(shown_rolling[i], shown_fixed[i], 1e-10) << "K, node " << i;
}

TEST(RollingNetwork, BalancesItsContactsAtEveryEvaluation) {
  const auto b = bearing(true);
  const auto data = network(b);
  const ThermalNetwork net(data);
  const auto R = circuit_resistances(b);
  const double R4 = R.R4 + R.R4_spreading, R7 = R.R7 + R.R7_spreading;
  for (const BallConduction& G : {BallConduction{0.7, 0.5, 1.9}, {0., 0.4, 0.}, {12., 9., 30.}, {0., 0., 0.}}) {
    const HeatInput h = heat_with(G);
    const double T_i = warm[1], T_b = warm[2], T_o = warm[3];
    Eigen::Matrix2d A;
    A << 1. / R4 + G.inner_to_ball + G.inner_to_outer, -G.inner_to_outer,  //
        -G.inner_to_outer, 1. / R7 + G.outer_to_ball + G.inner_to_outer;
    const Eigen::Vector2d contact = A.inverse() * Eigen::Vector2d(T_i / R4 + G.inner_to_ball * T_b + h.inner,
                                                                  T_o / R7 + G.outer_to_ball * T_b + h.outer);
    std::vector<double> shown(7), rate(5);
    net.observe(warm, {&h, 1}, shown);
    EXPECT_NEAR(shown[2], contact(0), 1e-9) << "K";
    EXPECT_NEAR(shown[4], contact(1), 1e-9) << "K";
    const double lost = net.rates(warm, {&h, 1}, rate);
    const double into_balls = G.inner_to_ball * (contact(0) - T_b) + G.outer_to_ball * (contact(1) - T_b);
    EXPECT_NEAR(rate[2] * data.nodes[3].capacity, into_balls - (T_b - ambient) / R.R6, 1e-9) << "W";
    double stored = 0.;
    const std::array<std::size_t, 5> node = {0, 1, 3, 5, 6};
    for (std::size_t k = 0; k < 5; ++k) stored += rate[k] * data.nodes[node[k]].capacity;
    EXPECT_NEAR(stored + lost, h.rub + h.inner + h.outer, 1e-9) << "W: every joule";
  }
}

TEST(RollingNetwork, GrowthDoesNotSeeWhatBallsConductAtOnce) {
  const ThermalNetwork net(network(bearing(true)));
  std::vector<Expansion> growth(1);
  net.growth(warm, growth);
  // Inner ring at one temperature, whatever the balls': alpha r T.
  EXPECT_NEAR(growth[0].inner_race, 11.8e-6 * 39e-3 * 11., 1e-15);
  EXPECT_NEAR(growth[0].bore, 11.8e-6 * 35e-3 * 11., 1e-15);
}

TEST(RollingNetwork, StripsDoNotSwellTheRing) {
  // The raceway's mean, R4 of R4 + spreading on the way to the strips, is what the ring grows with.
  const auto b = bearing(false);
  const ThermalNetwork net(network(b));
  const auto R = circuit_resistances(b);
  std::vector<Expansion> growth(1);
  net.growth(warm, growth);
  const double R4 = R.R4 + R.R4_spreading, R5 = R.R5_inside + R.R5_constriction;
  const double race = 11. + (2. - 11.) * R.R4 / (R4 + R5);
  const double a = 35e-3, c = 39e-3;
  EXPECT_NEAR(growth[0].inner_race, 11.8e-6 * c / (3. * (a + c)) * (11. * (2. * a + c) + race * (2. * c + a)), 1e-15);
}

TEST(RollingNetwork, APartOfANetworkKeepsItsBalls) {
  const auto part = part_around(network(bearing(true)), 0);
  EXPECT_EQ(part.data.nodes.size(), 7u);
  EXPECT_EQ(part.data.places[0].balls, "B/ball");
  const ThermalNetwork whole(network(bearing(true))), cut(part.data);
  const HeatInput h = heat_with({0.7, 0.5, 1.9});
  std::vector<double> a(5), c(5);
  whole.rates(warm, {&h, 1}, a);
  cut.rates(warm, {&h, 1}, c);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(a[i], c[i]);
}

TEST(RollingSections, ExchangeHeatBetweenStripsAndBalls) {
  // Three lumps in coordinates of their own: uncoupled modes 1, 2, 3 of inner strip and ring (40 J/K), outer (50), balls (10). Modes are normalised to the whole
  // capacity C = 100: shape_i = sqrt(C/C_i) on its own lump, input = shape/C.
  ReducedHeat heat;
  heat.capacity = 100.;
  heat.rate = {0., 0., 0.};
  heat.loss = {0., 0., 0.};
  const std::array<double, 3> C = {40., 50., 10.};
  const auto shape = [&](std::size_t i) {
    std::vector<double> s(3, 0.);
    s[i] = std::sqrt(100. / C[i]);
    return s;
  };
  const auto port = [&](const char* name, std::size_t i) {
    return ReducedHeat::Output{name, shape(i), 0., 0.01, shape(i), 0., {0.}};
  };
  heat.ports = {port("bore", 0),          port("shaft", 0),           port("inner_raceway", 0),
                port("outer_raceway", 1), port("housing_surface", 1), port("ball", 2)};
  heat.ports[housing_port].area = 0.;
  heat.ports[inner_raceway_port].at_once = 0.05;
  heat.ports[outer_raceway_port].at_once = 0.03;
  heat.bodies = {{"inner_ring", shape(0), 40.}, {"outer_ring", shape(1), 25.}, {"housing", shape(1), 25.}};
  heat.nodes = {{"ball", shape(2), 10.}, {"shaft", shape(0), 0.}};
  ReducedSection section;
  section.name = "B";
  section.heat = heat;
  section.balls_roll = true;
  std::vector<ReducedSection> sections;
  sections.push_back(section);
  const ReducedSections model(std::move(sections), ambient);

  const std::array<double, 3> T = {ambient + 11., ambient + 7., ambient + 2.};
  std::vector<double> y(3), rate(3);
  for (std::size_t i = 0; i < 3; ++i) y[i] = ambient + (T[i] - ambient) / std::sqrt(100. / C[i]);
  const HeatInput h = heat_with({0.7, 0.5, 1.9});
  EXPECT_EQ(model.rates(y, {&h, 1}, rate), 0.) << "nothing is lost";
  // The same as a circuit of strips behind resistances 0.05 and 0.03 K/W.
  Eigen::Matrix2d A;
  A << 1. / 0.05 + 0.7 + 1.9, -1.9, -1.9, 1. / 0.03 + 0.5 + 1.9;
  const Eigen::Vector2d strip =
      A.inverse() * Eigen::Vector2d(T[0] / 0.05 + 0.7 * T[2] + h.inner, T[1] / 0.03 + 0.5 * T[2] + h.outer);
  const double into_inner = (strip(0) - T[0]) / 0.05, into_outer = (strip(1) - T[1]) / 0.03,
               into_balls = 0.7 * (strip(0) - T[2]) + 0.5 * (strip(1) - T[2]);
  EXPECT_NEAR(rate[0] * std::sqrt(100. / C[0]) * C[0], into_inner + h.rub, 1e-9) << "W";
  EXPECT_NEAR(rate[1] * std::sqrt(100. / C[1]) * C[1], into_outer, 1e-9) << "W";
  EXPECT_NEAR(rate[2] * std::sqrt(100. / C[2]) * C[2], into_balls, 1e-9) << "W";
  std::vector<double> shown(5 + 4 * 3);
  model.observe(y, {&h, 1}, shown);
  EXPECT_NEAR(shown[8], strip(0), 1e-9) << "K, mean of the inner strips";
  EXPECT_NEAR(shown[11], strip(1), 1e-9) << "K, mean of the outer strips";
}

}  // namespace
}  // namespace rotordrop
