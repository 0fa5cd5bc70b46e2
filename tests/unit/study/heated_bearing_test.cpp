// One node of capacity C behind a resistance R to the surroundings, tau = R C:
//   steady heat P from 0:    rise = P R (1 - exp(-t/tau))
//   heat growing as a t:     rise = a R (t - tau (1 - exp(-t/tau)))
//   after the heat stops at s: rise(t) = rise(s) exp(-(t - s)/tau)
// A section on two modes of rates r_0, r_1 and shapes s_0 = 1 and s_1 >> 1 of a strip, which heat P enters, both with the capacity C of the whole:
//   rise of the strip = sum s_k^2 P / (C r_k) (1 - exp(-r_k t))
#include "study/heat/heated_bearing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "thermal/circuit/thermal_network.h"
#include "thermal/heating/heat_history.h"

namespace rotordrop {
namespace {

constexpr double C = 200., R = 0.05, tau = R * C, ambient = 300.;

ThermalNetworkData one_node(const std::string& bearing) {
  ThermalNetworkData data;
  data.ambient = ambient;
  const std::string node = bearing + "/ring";
  data.nodes = {{node, C, "ring"}};
  data.resistors = {{node, ambient_node, R}};
  data.places = {{node, node, node, node}};
  data.growths = {{0, &Expansion::bore, node, 1e-6}};
  return data;
}

/// Advances from change to change and on to the end.
void run(HeatedBearing& heated, const BearingHeatHistory& history, double end) {
  for (const double t : history.changes())
    if (t > heated.time() && t < end) heated.advance(t, history.heat(heated.time()), history.rate(heated.time()));
  if (end > heated.time()) heated.advance(end, history.heat(heated.time()), history.rate(heated.time()));
}

class HeatedNode : public ::testing::Test {
 protected:
  std::unique_ptr<HeatedBearing> heated() { return heated_model(network_, {"TB", 1, 0, ambient, 1e-6, nullptr}); }
  static double rise(const HeatedBearing& h) { return h.temperatures().front() - ambient; }
  // The tolerance of a step is 1e-6 of the mean rise without losses; a few dozen of them add up.
  static double tolerance(double turnover) { return 2e-5 * turnover / C; }
  const ThermalNetwork network_{one_node("TB")};
};

TEST_F(HeatedNode, FollowsTheClosedFormUnderSteadyHeatAndAfterIt) {
  BearingHeatHistory history;
  history.add(HeatedPort::ring, {{0., 7.}, {500., 0.}});
  const auto h = heated();
  EXPECT_EQ(h->names(), (std::vector<std::string>{"ring"}));
  run(*h, history, 5.);
  EXPECT_NEAR(rise(*h), 500. * R * -std::expm1(-5. / tau), tolerance(3500.));
  EXPECT_NEAR(h->growth().bore, 1e-6 * rise(*h), 1e-20);
  run(*h, history, 20.);
  EXPECT_EQ(h->time(), 20.);
  EXPECT_NEAR(rise(*h), 500. * R * -std::expm1(-7. / tau) * std::exp(-13. / tau), tolerance(3500.));
  EXPECT_NEAR(history.joules(HeatedPort::ring, 20.), h->stored() + h->lost(), 1e-12 * 3500.) << "J";
}

TEST_F(HeatedNode, FollowsTheClosedFormUnderGrowingHeat) {
  BearingHeatHistory history;
  history.add_linear(HeatedPort::outer, {{0., 30.}, {0., 900.}});
  const auto h = heated();
  run(*h, history, 12.);
  EXPECT_NEAR(rise(*h), 30. * R * (12. + tau * std::expm1(-12. / tau)), tolerance(13500.));
  EXPECT_NEAR(history.joules(HeatedPort::outer, 12.), h->stored() + h->lost(), 1e-12 * 13500.) << "J";
}

TEST_F(HeatedNode, TakesEachHeatOnce) {
  for (const auto port : {HeatedPort::ring, HeatedPort::shaft, HeatedPort::inner, HeatedPort::outer}) {
    BearingHeatHistory history;
    history.add(port, {{1.}, {100.}});
    const auto h = heated();
    run(*h, history, 2.);
    EXPECT_NEAR(rise(*h), 100. * R * -std::expm1(-1. / tau), tolerance(100.)) << static_cast<int>(port);
  }
}

/// Two modes of a section.
struct TwoModes final : ThermalModel {
  static constexpr std::array<double, 2> rate = {0.1, 2000.}, shape = {1., 1e3};
  [[nodiscard]] std::vector<StateEntry> state_entries() const override {
    return {{"TB/wide", "K", 1.}, {"TB/narrow", "K", 1.}};
  }
  void initial_state(std::span<double> z) const override { std::fill(z.begin(), z.end(), ambient); }
  void growth(std::span<const double>, std::span<Expansion> out) const override { out[0] = {}; }
  void growth_rates(std::span<const double>, std::span<Expansion> out) const override { out[0] = {}; }
  double rates(std::span<const double> z, std::span<const HeatInput> heat, std::span<double> dzdt) const override {
    for (std::size_t k = 0; k < 2; ++k) dzdt[k] = shape[k] * heat[0].inner / C - rate[k] * (z[k] - ambient);
    return rate[0] * C * (z[0] - ambient);
  }
  [[nodiscard]] std::vector<Observable> observables() const override { return {{"TB/strip", "K", "", 1}}; }
  void observe(std::span<const double> z, std::span<const HeatInput>, std::span<double> out) const override {
    out[0] = ambient + shape[0] * (z[0] - ambient) + shape[1] * (z[1] - ambient);
  }
  [[nodiscard]] double stored_energy(std::span<const double> z) const override { return C * (z[0] - ambient); }
  [[nodiscard]] static double rise(double watts, double t) {
    double sum = 0.;
    for (std::size_t k = 0; k < 2; ++k) sum += shape[k] * shape[k] * watts / (C * rate[k]) * -std::expm1(-rate[k] * t);
    return sum;
  }
};

TEST(HeatedModes, KeepTheToleranceWhereANarrowModeMagnifiesIt) {
  const TwoModes model;
  FiniteElements::Section section;
  section.reduced.capacity = C;
  section.reduced.rate.assign(TwoModes::rate.begin(), TwoModes::rate.end());
  section.reduced.ports = {{"inner_raceway", {TwoModes::shape.begin(), TwoModes::shape.end()}}};
  const auto h = heated_model(model, {"TB", 1, 0, ambient, 1e-6, &section});
  const double watts = 1.;
  HeatInput heat;
  heat.inner = watts;
  for (const double t : {1., 3., 4.}) {
    h->advance(t, heat, {});
    // Of a step 1e-6 of the mean rise without losses, P t / C. Explicit steps at their limit of stability keep a few of them.
    EXPECT_NEAR(h->temperatures().front() - ambient, TwoModes::rise(watts, t), 1e-5 * watts * t / C) << t << " s";
  }
  EXPECT_NEAR(h->stored(), watts / TwoModes::rate[0] * -std::expm1(-TwoModes::rate[0] * 4.), 1e-6 * watts * 4.) << "J";
  EXPECT_NEAR(h->stored() + h->lost(), watts * 4., 4000 * 1e-13 * C) << "J; rounding of 300 K in some 4000 steps";
}

}  // namespace
}  // namespace rotordrop
