// Sections in coordinates of their modes: two modes solved by hand, and what heat does before it is conducted on.
#include "thermal/section/reduced_sections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "thermal/circuit/adiabatic_rises.h"
#include "two_lumps.h"

namespace rotordrop {
namespace {

constexpr double ambient = 293.15;

using testing::one;
using testing::two_lumps;

TEST(ReducedSections, HeatsTheBodyThatTheHeatEnters) {
  const ReducedSections model(one(two_lumps()), ambient);
  std::vector<double> y(2), rate(2);
  model.initial_state(y);
  HeatInput heat;
  heat.rub = 12.;
  heat.rub_into_ring = 9.;
  heat.inner = 3.;
  EXPECT_EQ(model.rates(y, {&heat, 1}, rate), 0.) << "W lost at ambient";
  std::vector<Expansion> growth(1);
  model.growth_rates(rate, growth);
  EXPECT_NEAR(growth[0].bore, 1e-6 * 12. / 30., 1e-18) << "m/s: 12 W into 30 J/K";
  EXPECT_NEAR(growth[0].shaft, 4e-6 * 3. / 70., 1e-18) << "m/s: the rotor's share into the rest";
}

TEST(ReducedSections, ConductsBetweenItsBodies) {
  const ReducedSections model(one(two_lumps()), ambient);
  // Inner ring 7 K above the rest: 14 W between them.
  const double root = std::sqrt(0.21);
  const std::vector<double> y = {ambient + 2.1, ambient + 7. * root};
  std::vector<double> rate(2);
  const HeatInput none;
  model.rates(y, {&none, 1}, rate);
  std::vector<Expansion> growth(1);
  model.growth_rates(rate, growth);
  EXPECT_NEAR(growth[0].inner_race, -2e-6 * 14. / 30., 1e-17);
  EXPECT_NEAR(growth[0].outer_race, 3e-6 * 14. / 70., 1e-17);
  model.growth(y, growth);
  EXPECT_NEAR(growth[0].inner_race, 2e-6 * 7., 1e-17) << "m: inner ring 7 K, the rest 0";
  EXPECT_NEAR(growth[0].outer_race, 0., 1e-17);
  EXPECT_NEAR(model.stored_energy(y), 30. * 7., 1e-10) << "J";
}

TEST(ReducedSections, LetsARingGrowByItselfThatItsHousingDoesNotHold) {
  auto sections = one(two_lumps());
  auto& bodies = sections[0].heat.bodies;
  const auto body = [&](const char* name) {
    return std::find_if(bodies.begin(), bodies.end(), [&](const auto& b) { return b.name == name; });
  };
  ASSERT_NE(body("outer_ring"), bodies.end());
  body("outer_ring")->shape[0] *= 2.;  // warmer than the housing
  sections[0].growth.is_housed = false;
  const ReducedSections alone(sections, ambient);
  sections[0].growth.is_housed = true;
  const ReducedSections housed(sections, ambient);
  std::vector<double> y(2, ambient);
  y[0] += 1.;
  std::vector<Expansion> growth(1);
  alone.growth(y, growth);
  const double ring = body("outer_ring")->shape[0], housing = body("housing")->shape[0];
  EXPECT_NEAR(growth[0].outer_race, 3e-6 * ring, 1e-17) << "m";
  housed.growth(y, growth);
  const double C_o = body("outer_ring")->capacity, C_h = body("housing")->capacity;
  EXPECT_NEAR(growth[0].outer_race, 3e-6 * (C_o * ring + C_h * housing) / (C_o + C_h), 1e-17) << "m";
}

TEST(ReducedSections, ShowsSurfacesWithWhatTheModesLeaveOut) {
  const ReducedSections model(one(two_lumps()), ambient);
  std::vector<double> y(2), out(5 + 4 * 3);
  model.initial_state(y);
  HeatInput heat;
  heat.rub = heat.rub_into_ring = 8.;
  model.observe(y, {&heat, 1}, out);
  const auto list = model.observables();
  ASSERT_EQ(list[5].name, "TB/bore");
  EXPECT_NEAR(out[5] - ambient, 4., 1e-10) << "K: mean, 0.5 K/W";
  EXPECT_NEAR(out[6] - ambient, 2., 1e-10) << "K: its one point, 0.25 K/W";
  EXPECT_NEAR(out[7] - ambient, 2., 1e-10);
}

TEST(ReducedSections, HeatsTheStripsOfEachRow) {
  auto section = two_lumps();
  const auto strip = [&](std::size_t port) { return section.heat.ports[port]; };
  for (const std::size_t port : {inner_raceway_port, outer_raceway_port, inner_raceway_port, outer_raceway_port})
    section.heat.ports.push_back(strip(port));
  for (const std::size_t port : {6U, 7U, 8U, 9U}) section.heat.ports[port].area = 0.005;
  section.rows = {{6, 7}, {8, 9}};
  const ReducedSections model(one(section), ambient);
  std::vector<double> y(2), rate(2);
  model.initial_state(y);
  HeatInput heat;
  heat.rows.resize(2);
  heat.rows[0].inner = 3.;
  heat.rows[1].inner = 4.;
  heat.rows[0].outer = 5.;
  heat.rows[1].outer = 6.;
  heat.inner = 7.;
  heat.outer = 11.;
  EXPECT_NEAR(model.rates(y, {&heat, 1}, rate), 0., 1e-12);
  std::vector<Expansion> growth(1);
  model.growth_rates(rate, growth);
  EXPECT_NEAR(growth[0].inner_race, 2e-6 * 7. / 30., 1e-17) << "m/s: 7 W, once";
  EXPECT_NEAR(growth[0].outer_race, 3e-6 * 11. / 70., 1e-17);
}

TEST(ReducedSections, ShowTheHeatOfEachRowWhereOtherPortsStandBeforeTheirStrips) {
  auto section = two_lumps();
  const auto like = [&](std::size_t port) { return ReducedHeat::Output(section.heat.ports[port]); };
  section.heat.ports.push_back(
      like(shaft_port));  // two nodes of the shaft beside the bearing, which nothing heats from outside
  section.heat.ports.push_back(like(shaft_port));
  for (const std::size_t port : {inner_raceway_port, outer_raceway_port, inner_raceway_port, outer_raceway_port})
    section.heat.ports.push_back(like(port));
  const double at_once[] = {0.1, 0.2, 0.3, 0.4};  // K/W
  for (std::size_t i = 0; i < 4; ++i) {
    auto& strip = section.heat.ports[8 + i];
    strip.at_once = at_once[i];
    strip.area = 0.005;
    strip.points_at_once.assign(strip.points_at_once.size(), 0.5 * at_once[i]);
  }
  section.rows = {{8, 9}, {10, 11}};
  const ReducedSections model(one(section), ambient);
  const std::size_t n_out = observed_size(model.observables());
  std::vector<double> y(2), out(n_out), states(2 * RowTile::width, ambient), tile(n_out * RowTile::width);
  model.initial_state(y);
  HeatInput heat;
  heat.rows.resize(2);
  heat.rows[0] = {3., 5., {}};
  heat.rows[1] = {4., 6., {}};
  model.observe(y, {&heat, 1}, out);
  const double watts[] = {3., 5., 4., 6.};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t strip = n_out - 12 + 3 * i;
    EXPECT_NEAR(out[strip] - ambient, at_once[i] * watts[i], 1e-10) << "K: mean of strip " << i;
    EXPECT_NEAR(out[strip + 1] - ambient, 0.5 * at_once[i] * watts[i], 1e-10) << "K: its one point";
    EXPECT_NEAR(out[strip + 2] - ambient, 0.5 * at_once[i] * watts[i], 1e-10);
  }
  model.observe_tile(states, std::vector<HeatInput>(RowTile::width, heat), tile);
  for (std::size_t i = 0; i < n_out; ++i) EXPECT_NEAR(tile[i * RowTile::width + 3], out[i], 1e-10) << i;
}

TEST(ReducedSections, ShowEightStatesSideBySideAsOneByOne) {
  auto plain = two_lumps(), by_rows = two_lumps(500.);
  by_rows.heat.ports[bore_port].points = {1., 0.7, 0.5, -0.2, 2., 0.1};  // three points of two modes
  by_rows.heat.ports[bore_port].points_at_once = {0.25, 0.5, 0.};
  for (const std::size_t like : {inner_raceway_port, outer_raceway_port, inner_raceway_port, outer_raceway_port})
    by_rows.heat.ports.push_back(ReducedHeat::Output(by_rows.heat.ports[like]));
  for (const std::size_t port : {6U, 7U, 8U, 9U}) by_rows.heat.ports[port].area = port < 8 ? 0.004 : 0.006;
  by_rows.heat.ports[6].at_once = 0.3;
  by_rows.rows = {{6, 7}, {8, 9}};
  ReducedSection::Elastic elastic;
  for (std::size_t i = 0; i < elastic.growth.size(); ++i) elastic.growth[i] = {1e-6 * static_cast<double>(i), 2e-6};
  elastic.mean_pressure = {5e6, {1e5, -2e5}};
  elastic.node_pressure = {{1e6, {-1e6, 0.}}, {2e6, {0., 3e6}}};
  elastic.node_share = {0.4, 0.6};
  elastic.rows = {{1e-6, 0.}, {0., 1e-6}, {2e-6, 1e-6}, {3e-6, 0.}};
  by_rows.elastic = elastic;
  plain.elastic = elastic;
  plain.elastic->drives = false;
  plain.elastic->rows.clear();
  plain.name = "TA";
  plain.balls_roll = by_rows.balls_roll = true;
  const ReducedSections model({plain, by_rows}, ambient);
  const std::size_t n_out = observed_size(model.observables()), n_places = 2;
  std::vector<double> states(4 * RowTile::width), out(n_out * RowTile::width), alone(n_out), y(4);
  std::vector<HeatInput> heats(n_places * RowTile::width);
  auto number = [n = 0]() mutable { return 5. * std::sin(++n); };
  for (double& T : states) T = ambient + number();
  for (auto& heat : heats) {
    heat.rub = number();
    heat.rub_into_ring = number();
    heat.inner = number();
    heat.outer = number();
    const auto conductance = [&] { return std::fabs(number()); };
    heat.balls = {conductance(), conductance(), conductance()};
    heat.rows = {{number(), number(), {conductance(), conductance(), conductance()}},
                 {number(), number(), {conductance(), conductance(), conductance()}}};
  }
  model.observe_tile(states, heats, out);
  std::vector<double> one_by_one(out.size());
  model.ThermalModel::observe_tile(states, heats, one_by_one);
  for (std::size_t l = 0; l < RowTile::width; ++l) {
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = states[i * RowTile::width + l];
    model.observe(y, {&heats[l * n_places], n_places}, alone);
    for (std::size_t i = 0; i < n_out; ++i) {
      EXPECT_EQ(one_by_one[i * RowTile::width + l], alone[i]);
      EXPECT_NEAR(out[i * RowTile::width + l], alone[i], 1e-12 * std::fabs(alone[i]) + 1e-16)
          << "state " << l << ", " << i << ": roundoff of sums in another order";
    }
  }
}

TEST(ReducedSections, TellsWhatTheModesLeftOutLoseAtOnce) {
  auto section = two_lumps();
  section.heat.ports[bore_port].shape[0] = 0.9;  // of the uniform mode, which alone stores heat
  const ReducedSections model(one(section), ambient);
  std::vector<double> y(2), rate(2);
  model.initial_state(y);
  HeatInput heat;
  heat.rub = heat.rub_into_ring = 8.;
  EXPECT_NEAR(model.rates(y, {&heat, 1}, rate), 0.8, 1e-12) << "W: a tenth of 8";
  std::vector<double> stored_rate = {ambient + rate[0], ambient + rate[1]};
  EXPECT_NEAR(model.stored_energy(stored_rate), 7.2, 1e-10) << "W: the rest is stored";
}

TEST(ReducedSections, ALinkThatNeedsContactConductsOnlyThen) {
  auto section = two_lumps();
  section.contact_link = {.touching = 0.5, .apart = 5.};
  const ReducedSections model(one(section), ambient);
  const double root = std::sqrt(0.21);
  const std::vector<double> y = {ambient + 2.1, ambient + 7. * root};
  std::vector<double> rate(2);
  std::vector<Expansion> growth(1);
  for (const bool touching : {true, false}) {
    HeatInput none;
    none.is_in_contact = touching;
    model.rates(y, {&none, 1}, rate);
    model.growth_rates(rate, growth);
    const double watts = 14. + 7. / (touching ? 0.5 : 5.);
    EXPECT_NEAR(growth[0].bore, -1e-6 * watts / 30., 1e-17) << touching;
  }
}

/// What a model does under heat that stays as it is, in so many equal steps. @returns the heat lost [J]
double advanced(const ReducedSections& model, double time, int n_steps, const HeatInput& heat, std::vector<double>& y) {
  double lost = 0.;
  std::vector<double> to(y.size());
  for (int i = 0; i < n_steps; ++i) {
    lost += model.advance(time / n_steps, y, {&heat, 1}, to);
    y = to;
  }
  return lost;
}

TEST(ReducedSections, FollowSteadyHeatExactlyInStepsOfAnyLength) {
  auto section = two_lumps();
  section.heat.loss = {3., 0.};  // W/K of the uniform mode, which decays by it
  section.heat.rate[0] = 0.03;
  const ReducedSections model(one(section), ambient);
  ASSERT_TRUE(model.can_follow());
  HeatInput heat;
  heat.rub = heat.rub_into_ring = 8.;
  const double root = std::sqrt(0.21), rate = section.heat.rate[1], time = 30.;
  for (const int n_steps : {1, 2, 100}) {
    std::vector<double> y(2);
    model.initial_state(y);
    const double lost = advanced(model, time, n_steps, heat, y);
    EXPECT_NEAR(y[0] - ambient, 0.08 / 0.03 * (1. - std::exp(-0.9)), 1e-11) << "K, 8 W into 100 J/K and 3 W/K";
    EXPECT_NEAR(y[1] - ambient, 0.08 * 0.7 / root / rate * (1. - std::exp(-rate * time)), 1e-11) << n_steps;
    EXPECT_NEAR(lost + model.stored_energy(y), 8. * time, 1e-9) << "J: lost or stored";
  }
}

TEST(ReducedSections, FollowWithHeatLostAtOnce) {
  auto section = two_lumps();
  section.heat.ports[bore_port].shape[0] = 0.9;  // of the uniform mode, which alone stores heat
  const ReducedSections model(one(section), ambient);
  std::vector<double> y(2);
  model.initial_state(y);
  HeatInput heat;
  heat.rub = heat.rub_into_ring = 8.;
  EXPECT_NEAR(advanced(model, 2., 5, heat, y), 1.6, 1e-12) << "J: a tenth of 16";
  EXPECT_NEAR(model.stored_energy(y), 14.4, 1e-9) << "J";
}

TEST(ReducedSections, FollowExchangeToFirstOrderAndCloseTheBalance) {
  // A link whose heat follows the difference of its ends: exact are two lumps with 2 W/K of conduction and 1 / (0.5 K/W) of the link.
  auto section = two_lumps();
  section.contact_link = {.touching = 0.5, .apart = 5.};
  const ReducedSections model(one(section), ambient);
  const double root = std::sqrt(0.21), time = 2.;
  HeatInput none;
  none.is_in_contact = true;
  const double exact = 7. * root * std::exp(-(2. + 2.) * (1. / 30. + 1. / 70.) * time);
  double last = 0.;
  for (const int n_steps : {10, 20, 40}) {
    std::vector<double> y = {ambient + 2.1, ambient + 7. * root};
    EXPECT_NEAR(advanced(model, time, n_steps, none, y), 0., 1e-12) << "J";
    EXPECT_NEAR(model.stored_energy(y), 210., 1e-9) << "J, as at first: it stays in the section";
    const double error = std::fabs(y[1] - ambient - exact);
    if (n_steps > 10) {
      EXPECT_NEAR(last / error, 2., 0.05) << "the exchange is that of the steps' starts";
    }
    EXPECT_LT(error, 7. * root * 0.1 / n_steps);
    last = error;
  }
}

TEST(AdiabaticRises, RiseByHeatOverCapacity) {
  const AdiabaticRises model(
      {{"TB", 30., 20., 70., {.bore = 1e-6, .inner_race = 2e-6, .outer_race = 3e-6, .shaft = 4e-6, .ball = 5e-6}}},
      ambient);
  HeatInput heat;
  heat.rub = 12.;
  heat.rub_into_ring = 9.;
  heat.inner = 3.;
  heat.outer = 7.;
  std::vector<double> y(3), rate(3);
  model.initial_state(y);
  EXPECT_EQ(model.rates(y, {&heat, 1}, rate), 0.);
  EXPECT_DOUBLE_EQ(rate[0], 12. / 30.);
  EXPECT_DOUBLE_EQ(rate[1], 3. / 20.);
  EXPECT_DOUBLE_EQ(rate[2], 7. / 70.);
  for (std::size_t i = 0; i < 3; ++i) y[i] += 10. * rate[i];
  EXPECT_NEAR(model.stored_energy(y), 220., 1e-9) << "J: all of it, 22 W for 10 s";
  std::vector<Expansion> growth(1);
  model.growth(y, growth);
  const Expansion direct =
      AdiabaticSection{"TB", 30., 20., 70., {1e-6, 2e-6, 3e-6, 4e-6, 5e-6}}.growth_by(120., 30., 70.);
  EXPECT_NEAR(growth[0].bore, 4e-6, 1e-17);
  EXPECT_NEAR(growth[0].bore, direct.bore, 1e-17);
  EXPECT_NEAR(growth[0].shaft, direct.shaft, 1e-17);
  EXPECT_NEAR(growth[0].outer_race, direct.outer_race, 1e-17);
  EXPECT_EQ(growth[0].ball, 0.);
}

}  // namespace
}  // namespace rotordrop
