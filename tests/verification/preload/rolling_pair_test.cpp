// Thermal preload of the reference case's pair TB2 whose balls conduct as they roll, with heat that spreads from their strips.
//
// PEER. validation/preload_loop.py, "rolling": the contacts' conductances, their star of inner race, outer race and ball and the spreading from strips written again, the
// contacts' temperatures by a linear solution at every evaluation, differences of everything for gain and eigenvalue. It shares no code with the program.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "machine/build_preload.h"
#include "study/preload_course.h"

namespace rotordrop {
namespace {

constexpr double ambient = 293.15;

Case rolling(const std::string& speed, std::vector<std::string> more = {}) {
  more.insert(more.end(), {"preload.speed=" + speed, "thermal.contact_conduction=rolling", "thermal.spreading=strip"});
  return read_case(std::string(ROTORDROP_SOURCE_DIR) + "/params/neisi2019.toml", more);
}

std::unique_ptr<PreloadLoop> loop_of(const Case& c) {
  return build_preload_loop(c.parameters, c.tree, "TB2", rest_finder("TB2"), {});
}

TEST(RollingPair, OperatingPointsAreThoseOfThePeer) {
  struct Line {
    const char* speed;
    double heat, preload, gain, eigenvalue;
    std::array<double, 3> conductance;
    std::array<double, 5> rise;
  };
  for (const Line& peer : {Line{"2000 rpm",
                                10.57463552,
                                375.452132,
                                0.194497,
                                -1.0072568e-03,
                                {6.8663809, 7.1373351, 0.5437807},
                                {6.3824966, 6.4716471, 6.18706, 6.307965, 6.2554914}},
                           Line{"3000 rpm",
                                21.56982023,
                                478.435625,
                                0.332723,
                                -9.1791122e-04,
                                {8.9851183, 9.3417237, 0.9782715},
                                {12.1669285, 12.3368758, 11.9005807, 11.9525814, 11.8361348}}}) {
    const Case c = rolling(peer.speed);
    const auto loop = loop_of(c);
    const auto found = find_operating_points(*loop, preload_limits(c.parameters.preload));
    ASSERT_FALSE(found.points.empty());
    const auto& p = found.points[0];
    printf("heat %.8f W, preload %.6f N, gain %.6f, eigenvalue %.7e 1/s\n", p.heat, p.state.preload, p.response.gain,
           p.response.eigenvalue.real());
    // The peer's printed digits; 1e-6 where it takes differences.
    EXPECT_NEAR(p.heat, peer.heat, 1e-6 * peer.heat) << "W";
    EXPECT_NEAR(p.state.preload, peer.preload, 1e-6 * peer.preload) << "N";
    EXPECT_NEAR(p.response.gain, peer.gain, 3e-6);
    EXPECT_NEAR(p.response.eigenvalue.real() / peer.eigenvalue, 1., 3e-6);
    EXPECT_NEAR(p.state.balls.inner_to_ball, peer.conductance[0], 1e-6 * peer.conductance[0]) << "W/K";
    EXPECT_NEAR(p.state.balls.outer_to_ball, peer.conductance[1], 1e-6 * peer.conductance[1]) << "W/K";
    EXPECT_NEAR(p.state.balls.inner_to_outer, peer.conductance[2], 1e-6 * peer.conductance[2]) << "W/K";
    const auto T = loop->node_temperatures(p.T, p.heat);
    const std::array<std::string, 5> nodes = {"TB2/shaft", "TB2/inner_ring", "TB2/ball", "TB2/outer_ring",
                                              "TB2/housing"};
    for (std::size_t n = 0; n < T.size(); ++n) {
      const auto node = std::find(nodes.begin(), nodes.end(), loop->nodes()[n].name);
      if (node == nodes.end()) continue;  // contacts
      EXPECT_NEAR(T[n] - ambient, peer.rise[static_cast<std::size_t>(node - nodes.begin())], 1e-5) << *node;
    }
  }
}

TEST(RollingPair, TheGainIsThatOfAssumedAndPredictedHeat) {
  // Differences of the map from assumed to predicted heat see the conductances' change with growth, without any derivative of the criterion.
  const Case c = rolling("2500 rpm", {"preload.force=[\"40 N\", \"-100 N\", \"30 N\"]"});
  const auto loop = loop_of(c);
  const auto found = find_operating_points(*loop, preload_limits(c.parameters.preload));
  ASSERT_FALSE(found.points.empty());
  const auto& p = found.points[0];
  const double step = 1e-3 * p.heat;
  const auto made = [&](double heat) { return loop->state(loop->steady(heat, p.T)).heat; };
  const double gain = (made(p.heat + step) - made(p.heat - step)) / (2. * step);
  printf("gain %.7f by the criterion, %.7f by differences\n", p.response.gain, gain);
  EXPECT_NEAR(p.response.gain, gain, 2e-5 * std::fabs(gain));
}

TEST(RollingPair, SettlesAtItsOperatingPointWithEveryJoule) {
  const Case c = rolling("3000 rpm", {"preload.tolerance=1e-9"});
  const auto loop = loop_of(c);
  const auto course = follow_preload(*loop, c.parameters.preload, "/");
  const auto found = find_operating_points(*loop, preload_limits(c.parameters.preload));
  ASSERT_FALSE(found.points.empty());
  const std::span<const double> T(course.y.data(), loop->size());
  EXPECT_NEAR(loop->state(T).preload, found.points[0].state.preload, 1e-2 * found.points[0].state.preload);
  const double made = course.y[loop->size()], lost = course.y[loop->size() + 1];
  EXPECT_NEAR(made - lost - loop->stored_energy(T), 0., 1e-7 * made) << "J";
}

TEST(RollingPair, AnOilFilmInsulatesItsBalls) {
  const auto dry = loop_of(rolling("3000 rpm")), oiled = loop_of(rolling("3000 rpm", {"thermal.oil_film=0.1 um"}));
  const double G_dry = dry->state(dry->cold()).balls.inner_to_ball,
               G_oiled = oiled->state(oiled->cold()).balls.inner_to_ball;
  // A film of 0.1 um over the contact's ellipse, computed here from its load: a third or so of the dry conductance is left.
  EXPECT_LT(G_oiled, 0.6 * G_dry);
  EXPECT_GT(G_oiled, 0.1 * G_dry);
}

}  // namespace
}  // namespace rotordrop
