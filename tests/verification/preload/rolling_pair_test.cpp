// Thermal preload of the reference case's pair TB2 whose balls conduct as they roll, with heat that spreads from their strips and a shaft that is a fin (params/neisi2019-preload.toml).
//
// PEER. validation/preload_loop.py, "physical": the contacts' conductances, their star of inner race, outer race and ball, the spreading from strips and the fin's two-ports written again,
// the contacts' temperatures by a linear solution at every evaluation, operating points by scipy's Radau and fsolve, differences of everything for gain and eigenvalue. It shares no
// code with the program.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analysis/preload/build_preload.h"
#include "study/preload/preload_course.h"

namespace rotordrop {
namespace {

constexpr double ambient = 293.15;

Case rolling(const std::string& speed, std::vector<std::string> more = {}) {
  more.push_back("preload.speed=" + speed);
  return read_case(std::string(ROTORDROP_SOURCE_DIR) + "/params/neisi2019-preload.toml", more);
}

std::unique_ptr<PreloadLoop> loop_of(const Case& c, const PreloadVariation& v = {}) {
  return build_preload_loop(c.parameters, c.tree, "TB2", rest_finder("TB2"), v);
}

TEST(RollingPair, OperatingPointsAreThoseOfThePeer) {
  struct Line {
    const char* speed;
    std::vector<std::string> more;
    double heat, preload, gain, eigenvalue;
    std::array<double, 3> conductance;
    std::array<double, 5> rise;
    std::vector<double> fin;
  };
  for (const Line& peer :
       {Line{"3000 rpm",
             {},
             9.69015269,
             238.680074,
             -0.176481,
             -3.8273285e-04,
             {6.7094603, 6.9751096, 0.5174439},
             {1.9028584, 2.1540614, 2.5907036, 3.0172634, 2.9963533},
             {1.7296625, 1.4848997, 1.0439693, 0.6474616, 0.2927106, 1.8529947, 1.7776958, 1.6734126}},
        Line{"15200 rpm",
             {},
             192.12706492,
             866.016149,
             -0.522011,
             -3.7382163e-04,
             {20.0259083, 20.8269686, 6.5915516},
             {34.7419687, 39.3283781, 43.6244665, 44.3757795, 43.7784824},
             {31.5797963, 27.1109706, 19.0605609, 11.8212117, 5.3442448, 33.831568, 32.4567785, 30.5527975}},
        Line{"2000 rpm",
             {"thermal.shaft=lump"},
             6.52251934,
             312.152347,
             0.031555,
             -1.1358349e-03,
             {6.3441250, 6.5942370, 0.4587673},
             {4.0967179, 4.1539408, 3.9683268, 4.0792299, 4.0487672},
             {}},
        Line{"3000 rpm",
             {"thermal.shaft=lump"},
             11.95508319,
             344.833098,
             0.058371,
             -1.1844997e-03,
             {7.8500138, 8.1612389, 0.7270592},
             {7.1169987, 7.2164087, 6.9421789, 7.0392061, 6.979039},
             {}},
        Line{"3000 rpm",
             {"thermal.oil_film=0.1 um"},
             8.00736358,
             148.289854,
             -0.468193,
             -3.7641757e-04,
             {1.837770354, 1.991742623, 0.036494849},
             {1.3886868, 1.5720122, 2.2240883, 3.3732563, 3.349224},
             {1.2622902, 1.0836647, 0.7618782, 0.4725109, 0.2136172, 1.3522967, 1.2973444, 1.2212395}}}) {
    const Case c = rolling(peer.speed, peer.more);
    const auto loop = loop_of(c);
    const auto found = find_operating_points(*loop, preload_limits(c.parameters.preload));
    ASSERT_EQ(found.points.size(), 1u) << "up to the limits";
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
    std::vector<std::pair<std::string, double>> rises = {{"TB2/shaft", peer.rise[0]},
                                                         {"TB2/inner_ring", peer.rise[1]},
                                                         {"TB2/ball", peer.rise[2]},
                                                         {"TB2/outer_ring", peer.rise[3]},
                                                         {"TB2/housing", peer.rise[4]}};
    for (std::size_t n = 0; n < peer.fin.size(); ++n)
      rises.emplace_back(n < 5 ? "TB2/shaft_left_" + std::to_string(n + 1) : "TB2/shaft_right_" + std::to_string(n - 4),
                         peer.fin[n]);
    std::size_t n_found = 0;
    for (std::size_t n = 0; n < T.size(); ++n)
      for (const auto& [node, rise] : rises)
        if (loop->nodes()[n].name == node) {
          EXPECT_NEAR(T[n] - ambient, rise, 1e-5) << node;
          ++n_found;
        }
    EXPECT_EQ(n_found, rises.size());
  }
}

TEST(RollingPair, TheLimitEndsOperatingPointsWhereThePeerFindsIt) {
  // The loop gain stays negative: the outer race's 150 degC are what ends operating points.
  const Case c = rolling("15200 rpm");
  const auto limits = preload_limits(c.parameters.preload);
  const auto speed = find_critical_factor([&](double f) { return loop_of(c, {.speed = f}); }, 2., limits);
  const auto preload = find_critical_factor([&](double f) { return loop_of(c, {.preload = f}); }, 2., limits);
  const auto cooling = find_critical_factor([&](double f) { return loop_of(c, {.cooling = f}); }, 0.5, limits);
  ASSERT_TRUE(speed && preload && cooling);
  // The search ends within 1e-4.
  EXPECT_NEAR(speed->factor * 15200., 21942.909, 1.1e-4 * 21943.) << "rpm";
  EXPECT_NEAR(preload->factor * 290., 2676.7619, 1.1e-4 * 2677.) << "N";
  EXPECT_NEAR(cooling->factor, 0.135467, 1.1e-4 * 0.1355);
  for (const auto& critical : {speed, preload, cooling}) {
    EXPECT_EQ(critical->by, CriticalFactor::By::limit);
    EXPECT_LT(critical->gain, 0.);
  }
}

TEST(RollingPair, RunsAwayWhenThePeerDoes) {
  const Case c = rolling("24000 rpm", {"preload.tolerance=1e-10"});
  const auto loop = loop_of(c);
  const auto course = follow_preload(*loop, c.parameters.preload, "/");
  EXPECT_EQ(course.limit, LimitMet::temperature);
  EXPECT_NEAR(course.time, 7.167943, 1e-6 * 7.2) << "s";
  EXPECT_NEAR(loop->state({course.y.data(), loop->size()}).preload, 17237.20027, 1e-6 * 17237.) << "N";
}

TEST(RollingPair, AStateWithoutLoadIsNoOperatingPoint) {
  // An oil film at full speed: heat beyond some watts leaves the balls unloaded, and then they conduct nothing. What the steady state makes of heat jumps there, and
  // an operating point is only where both are equal.
  const Case c = rolling("15200 rpm", {"thermal.oil_film=0.1 um"});
  const auto loop = loop_of(c);
  for (const auto& p : find_operating_points(*loop, preload_limits(c.parameters.preload)).points)
    EXPECT_NEAR(p.state.heat, p.heat, 1e-5 * p.heat) << "W";
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
  // Differences of 1e-3 of the heat err by 1e-6/6 of its third derivative: 2e-7.
  EXPECT_NEAR(p.response.gain, gain, 2e-6 * std::fabs(gain));
}

TEST(RollingPair, SettlesAtItsOperatingPointWithEveryJoule) {
  const Case c = rolling("3000 rpm", {"preload.tolerance=1e-9"});
  const auto loop = loop_of(c);
  const auto course = follow_preload(*loop, c.parameters.preload, "/");
  const auto found = find_operating_points(*loop, preload_limits(c.parameters.preload));
  ASSERT_FALSE(found.points.empty());
  const std::span<const double> T(course.y.data(), loop->size());
  // It is settled at 1e-6 K/s, with a slowest rate of 4e-4 1/s: 3 mK of rises of 3 K are left.
  EXPECT_NEAR(loop->state(T).preload, found.points[0].state.preload, 1e-3 * found.points[0].state.preload);
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
