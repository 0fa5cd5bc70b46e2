// The thermal network: small circuits solved by hand.
#include "thermal/circuit/thermal_network.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace rotordrop {
namespace {

using Data = ThermalNetworkData;
using Law = Data::Law;

constexpr double ambient = 293.15;

Data::Resistor resistor(const char* a, const char* b, double R) { return {a, b, R, Law::constant, 0., 0., 0}; }

/// shaft -R- ring, both to ambient; ports of one place: rub on shaft and ring, inner and outer on the ring.
Data two_nodes() {
  Data d;
  d.ambient = ambient;
  d.nodes = {{"shaft", 100., ""}, {"ring", 40., ""}};
  d.resistors = {resistor("shaft", "ring", 2.), resistor("shaft", "ambient", 5.), resistor("ring", "ambient", 10.)};
  d.places = {{"shaft", "ring", "ring", "ring"}};
  return d;
}

HeatInput heat(double rub, double inner, double outer, bool in_contact = true) {
  HeatInput h;
  h.rub = rub;
  h.rub_into_ring = 0.66 * rub;
  h.inner = inner;
  h.outer = outer;
  h.is_in_contact = in_contact;
  return h;
}

struct Rates {
  std::vector<double> of_temperature;
  double lost;
};
Rates rates(const ThermalNetwork& network, const std::vector<double>& T, const HeatInput& h) {
  Rates r{std::vector<double>(T.size()), 0.};
  r.lost = network.rates(T, {&h, 1}, r.of_temperature);
  return r;
}

TEST(ThermalNetwork, StartsAtAmbientInBalance) {
  const ThermalNetwork network(two_nodes());
  std::vector<double> T(2);
  network.initial_state(T);
  EXPECT_EQ(T, std::vector<double>({ambient, ambient}));
  const auto r = rates(network, T, heat(0, 0, 0));
  EXPECT_EQ(r.of_temperature, std::vector<double>({0., 0.}));
  EXPECT_EQ(r.lost, 0.);
  EXPECT_EQ(network.stored_energy(T), 0.);
}

TEST(ThermalNetwork, HeatsAdiabaticallyByHeatOverCapacity) {
  auto d = two_nodes();
  d.resistors.clear();
  const ThermalNetwork network(d);
  const auto r = rates(network, {ambient, ambient}, heat(1000., 30., 12.));
  EXPECT_NEAR(r.of_temperature[0], 340. / 100., 1e-12) << "K/s: 34 % of the rub";
  EXPECT_NEAR(r.of_temperature[1], (660. + 42.) / 40., 1e-12) << "K/s";
  EXPECT_EQ(r.lost, 0.);
  // The same as energy: a pulse of 1 J, whatever its shape, is a rise of (share / C) K.
  EXPECT_NEAR(network.stored_energy(std::vector<double>{ambient + 0.34 / 100., ambient + 0.66 / 40.}), 1., 1e-12)
      << "J";
}

TEST(ThermalNetwork, FollowsOhmsLawBetweenNodes) {
  const ThermalNetwork network(two_nodes());
  const auto r = rates(network, {ambient + 10., ambient + 4.}, heat(0, 0, 0));
  EXPECT_NEAR(r.of_temperature[0], -(6. / 2. + 10. / 5.) / 100., 1e-14) << "K/s";
  EXPECT_NEAR(r.of_temperature[1], (6. / 2. - 4. / 10.) / 40., 1e-14) << "K/s";
  EXPECT_NEAR(r.lost, 10. / 5. + 4. / 10., 1e-12) << "W";
}

TEST(ThermalNetwork, HousingConvectionGrowsAsTheFiveFourthsPowerOfTheRise) {
  Data d;
  d.ambient = ambient;
  d.nodes = {{"housing", 1., ""}};
  d.resistors = {{"housing", "ambient", 0., Law::housing_convection, 0.02, 0., 0}};
  const ThermalNetwork network(d);
  std::vector<double> T = {ambient + 16.}, rate(1);
  EXPECT_NEAR(network.rates(T, {}, rate), 23. * 2. * 16. * 0.02, 1e-11) << "W: h = 46 W/m2 K";
  EXPECT_NEAR(rate[0], -23. * 2. * 16. * 0.02, 1e-11) << "K/s";
}

TEST(ThermalNetwork, AContactLinkConductsOnlyWhileTheBodiesTouch) {
  Data d = two_nodes();
  d.resistors = {{"shaft", "ring", 0.04, Law::contact, 0., 1.44, 0}};
  const ThermalNetwork network(d);
  const std::vector<double> T = {ambient + 8., ambient};
  EXPECT_NEAR(rates(network, T, heat(0, 0, 0, true)).of_temperature[1], 8. / 0.04 / 40., 1e-11) << "K/s";
  EXPECT_NEAR(rates(network, T, heat(0, 0, 0, false)).of_temperature[1], 8. / 1.44 / 40., 1e-11) << "K/s";
}

TEST(ThermalNetwork, MasslessPointPassesHeatOnAsItsResistorsSay) {
  // shaft -2- point -3- ring, point -6- ambient; 1/2 + 1/3 + 1/6 = 1 W/K. Heat H into the point splits 1/2 : 1/3 : 1/6, and raises it by H * 1 K/W.
  auto d = two_nodes();
  d.nodes.push_back({"point", 0., ""});
  d.resistors = {resistor("shaft", "point", 2.), resistor("point", "ring", 3.), resistor("point", "ambient", 6.)};
  d.places = {{"shaft", "ring", "point", "ring"}};
  const ThermalNetwork network(d);
  EXPECT_EQ(network.state_entries().size(), 2u) << "it is no state";
  const auto cold = rates(network, {ambient, ambient}, heat(0., 12., 0.));
  EXPECT_NEAR(cold.of_temperature[0], 6. / 100., 1e-13) << "K/s";
  EXPECT_NEAR(cold.of_temperature[1], 4. / 40., 1e-13) << "K/s";
  EXPECT_NEAR(cold.lost, 2., 1e-12) << "W";
  // Temperatures alone: T_point = T_shaft/2 + T_ring/3 + T_ambient/6.
  const std::vector<double> T = {ambient + 10., ambient + 3.};
  const auto warm = rates(network, T, heat(0., 0., 0.));
  EXPECT_NEAR(warm.of_temperature[0], -(10. - 6.) / 2. / 100., 1e-13) << "K/s";
  EXPECT_NEAR(warm.of_temperature[1], (6. - 3.) / 3. / 40., 1e-13) << "K/s";
  EXPECT_NEAR(warm.lost, 6. / 6., 1e-12) << "W";
  std::vector<double> shown(3);
  const auto h = heat(0., 12., 0.);
  network.observe(T, {&h, 1}, shown);
  EXPECT_NEAR(shown[2], ambient + 6. + 12., 1e-10) << "K: with its own heat";
}

TEST(ThermalNetwork, TakesTheRubHeatAsItIsDivided) {
  auto d = two_nodes();
  d.resistors.clear();
  const ThermalNetwork network(d);
  auto h = heat(1000., 0., 0.);
  h.rub_into_ring = 1000. / 3.;
  const auto r = rates(network, {ambient, ambient}, h);
  EXPECT_NEAR(r.of_temperature[1], 1000. / 3. / 40., 1e-9) << "K/s";
  EXPECT_NEAR(r.of_temperature[0], 2000. / 3. / 100., 1e-9) << "K/s";
}

TEST(LinearFlows, AreTheSumsOfTheirColumns) {
  // Rows are looked at in vectors of eight, the last of them not full: all remainders.
  for (std::size_t n_nodes = 1; n_nodes <= 34; ++n_nodes) {
    constexpr std::size_t n_places = 2;
    LinearFlows flows(n_nodes, n_places);
    const auto number = [](std::size_t a, std::size_t b) { return std::sin(1. + static_cast<double>(7 * a + 3 * b)); };
    for (std::size_t row = 0; row <= n_nodes; ++row) {
      for (std::size_t node = 0; node < n_nodes; ++node) flows.by_rise(row, node) = number(row, node);
      for (std::size_t port = 0; port < 4 * n_places; ++port)
        flows.by_port(row, port / 4, port % 4) = number(row, n_nodes + port);
    }
    std::vector<double> T(n_nodes), rate(n_nodes + 1, 4711.);
    for (std::size_t node = 0; node < n_nodes; ++node) T[node] = ambient + number(node, 100);
    const std::vector<HeatInput> given = {heat(300., 20., 5.), heat(-70., 3., 40.)};
    const double lost = flows.rates(T, ambient, given, {rate.data(), n_nodes});
    EXPECT_EQ(rate[n_nodes], 4711.) << "nothing is written behind the nodes";
    for (std::size_t row = 0; row <= n_nodes; ++row) {
      double expected = 0.;
      for (std::size_t node = 0; node < n_nodes; ++node) expected += number(row, node) * (T[node] - ambient);
      for (std::size_t place = 0; place < n_places; ++place) {
        const HeatInput& h = given[place];
        const std::array<double, 4> watts = {h.rub_into_ring, h.rub - h.rub_into_ring, h.inner, h.outer};
        for (std::size_t port = 0; port < 4; ++port) expected += number(row, n_nodes + 4 * place + port) * watts[port];
      }
      // Sums of some 40 numbers of up to 200.
      EXPECT_NEAR(row < n_nodes ? rate[row] : lost, expected, 40. * 200. * 2.2e-16) << n_nodes << " nodes, row " << row;
    }
  }
}

TEST(ThermalNetwork, GrowthIsLinearInTheRises) {
  auto d = two_nodes();
  d.growths = {
      {0, &Expansion::bore, "ring", 4e-7}, {0, &Expansion::bore, "shaft", 1e-7}, {0, &Expansion::shaft, "shaft", 5e-7}};
  const ThermalNetwork network(d);
  Expansion growth, rate;
  network.growth(std::vector<double>{ambient + 2., ambient + 10.}, {&growth, 1});
  EXPECT_NEAR(growth.bore, 4.2e-6, 1e-18) << "m";
  EXPECT_NEAR(growth.shaft, 1e-6, 1e-18) << "m";
  EXPECT_EQ(growth.ball, 0.);
  network.growth_rates(std::vector<double>{2., 10.}, {&rate, 1});
  EXPECT_NEAR(rate.bore, 4.2e-6, 1e-18) << "m/s: rates have no ambient";
}

TEST(ThermalNetwork, RefusesCircuitsThatMakeNoSense) {
  const auto with = [](auto change) {
    auto d = two_nodes();
    change(d);
    return d;
  };
  EXPECT_THROW(ThermalNetwork(with([](Data& d) { d.resistors.push_back(resistor("ring", "rign", 1.)); })),
               std::invalid_argument)
      << "unknown node";
  EXPECT_THROW(ThermalNetwork(with([](Data& d) {
                 d.nodes.push_back({"ring", 1., ""});
               })),
               std::invalid_argument)
      << "twice the same name";
  EXPECT_THROW(ThermalNetwork(with([](Data& d) {
                 d.nodes.push_back({"lonely", 0., ""});
               })),
               std::invalid_argument)
      << "massless without resistor";
  EXPECT_THROW(ThermalNetwork(with([](Data& d) {
                 d.nodes.push_back({"point", 0., ""});
                 d.resistors.push_back(resistor("point", "ring", 1.));
                 d.resistors.push_back({"point", "ambient", 0., Law::housing_convection, 1., 0., 0});
               })),
               std::invalid_argument)
      << "a law on a massless node";
  EXPECT_THROW(ThermalNetwork(with([](Data& d) { d.places[0].inner_contact = "ambient"; })), std::invalid_argument)
      << "heat into the surroundings";
  EXPECT_THROW(ThermalNetwork(with([](Data& d) {
                 d.growths = {{0, &Expansion::bore, "none", 1.}};
               })),
               std::invalid_argument)
      << "growth of nothing";
}

}  // namespace
}  // namespace rotordrop
