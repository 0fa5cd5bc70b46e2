// One node of capacity C behind a resistance R to the surroundings, tau = R C:
//   steady heat P from 0:    rise = P R (1 - exp(-t/tau))
//   heat growing as a t:     rise = a R (t - tau (1 - exp(-t/tau)))
//   after the heat stops at s: rise(t) = rise(s) exp(-(t - s)/tau)
#include "study/heat/heated_bearing.h"

#include <gtest/gtest.h>

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
  std::unique_ptr<HeatedBearing> heated(double turnover) {
    return heated_model(network_, {"TB", 1, 0, ambient, turnover, 1e-6, nullptr});
  }
  static double rise(const HeatedBearing& h) { return h.temperatures().front() - ambient; }
  // The tolerance of a step is 1e-6 of the mean rise without losses; a few dozen of them add up.
  static double tolerance(double turnover) { return 2e-5 * turnover / C; }
  const ThermalNetwork network_{one_node("TB")};
};

TEST_F(HeatedNode, FollowsTheClosedFormUnderSteadyHeatAndAfterIt) {
  BearingHeatHistory history;
  history.add(HeatedPort::ring, {{0., 7.}, {500., 0.}});
  const auto h = heated(3500.);
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
  const auto h = heated(13500.);
  run(*h, history, 12.);
  EXPECT_NEAR(rise(*h), 30. * R * (12. + tau * std::expm1(-12. / tau)), tolerance(13500.));
  EXPECT_NEAR(history.joules(HeatedPort::outer, 12.), h->stored() + h->lost(), 1e-12 * 13500.) << "J";
}

TEST_F(HeatedNode, TakesEachHeatOnce) {
  for (const auto port : {HeatedPort::ring, HeatedPort::shaft, HeatedPort::inner, HeatedPort::outer}) {
    BearingHeatHistory history;
    history.add(port, {{1.}, {100.}});
    const auto h = heated(100.);
    run(*h, history, 2.);
    EXPECT_NEAR(rise(*h), 100. * R * -std::expm1(-1. / tau), tolerance(100.)) << static_cast<int>(port);
  }
}

}  // namespace
}  // namespace rotordrop
