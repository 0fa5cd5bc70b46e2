// Sections in coordinates of their modes: two modes solved by hand, and what heat does before it is conducted on.
#include "thermal/section/reduced_sections.h"

#include <gtest/gtest.h>

#include <cmath>

#include "thermal/circuit/adiabatic_rises.h"

namespace rotordrop {
namespace {

constexpr double ambient = 293.15;

/// Inner ring of 30 J/K and the rest, 70 J/K, joined by 2 W/K: the uniform mode, and (0.7, -0.3)/sqrt(0.21) with a rate of 2/30 + 2/70.
ReducedSection two_lumps() {
  const double root = std::sqrt(0.21);
  const std::vector<double> inner = {1., 0.7 / root}, rest = {1., -0.3 / root};
  ReducedHeat h;
  h.capacity = 100.;
  h.rate = {0., 2. / 30. + 2. / 70.};
  const auto port = [](const char* name, const std::vector<double>& shape, double area) {
    return ReducedHeat::Output{name, shape, 0., area, shape, 0., {0.}};
  };
  h.ports = {port("bore", inner, 0.01),         port("shaft", rest, 0.01),         port("inner_raceway", inner, 0.01),
             port("outer_raceway", rest, 0.01), port("housing_surface", rest, 0.), port("ball", rest, 0.)};
  h.ports[bore_port].at_once = 0.5;
  h.ports[bore_port].points_at_once = {0.25};
  h.bodies = {{"inner_ring", inner, 30.}, {"outer_ring", rest, 20.}, {"housing", rest, 20.}};
  h.nodes = {{"ball", rest, 10.}, {"shaft", rest, 20.}};
  h.loss = {0., 0.};
  ReducedSection section;
  section.name = "TB";
  section.heat = h;
  section.growth = {.bore = 1e-6, .inner_race = 2e-6, .outer_race = 3e-6, .shaft = 4e-6, .ball = 5e-6};
  return section;
}

std::vector<ReducedSection> one(ReducedSection section) {
  std::vector<ReducedSection> list;
  list.push_back(std::move(section));
  return list;
}

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
