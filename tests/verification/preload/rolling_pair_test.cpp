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
             9.70202419,
             239.273612,
             -0.174801,
             -3.8270729e-04,
             {6.7166693, 6.9826066, 0.5186409},
             {1.9052422, 2.1567599, 2.5936574, 3.0201837, 2.9992483},
             {1.7318293, 1.4867599, 1.0452771, 0.6482727, 0.2930773, 1.8553160, 1.7799229, 1.6755089}},
        Line{"15200 rpm",
             {},
             195.61550456,
             888.428411,
             -0.490391,
             -3.7294177e-04,
             {20.1826998, 20.9900424, 6.7291925},
             {35.3463084, 40.0124988, 44.3702216, 45.1069825, 44.4973996},
             {32.1291298, 27.5825684, 19.3921211, 12.0268428, 5.4372084, 34.420071, 33.0213671, 31.0842662}},
        Line{"2000 rpm",
             {"thermal.shaft=lump"},
             6.53711662,
             313.154174,
             0.034079,
             -1.1360801e-03,
             {6.3529737, 6.6034389, 0.4601393},
             {4.1050349, 4.1623739, 3.9766274, 4.0874351, 4.0568960},
             {}},
        Line{"3000 rpm",
             {"thermal.shaft=lump"},
             12.00227932,
             346.921733,
             0.062764,
             -1.1844133e-03,
             {7.8700377, 8.1820632, 0.7311126},
             {7.1422858, 7.2420490, 6.9675507, 7.0641308, 7.003698},
             {}},
        Line{"3000 rpm",
             {"thermal.oil_film=0.1 um"},
             8.01879006,
             148.958080,
             -0.464939,
             -3.7641384e-04,
             {1.842667532, 1.997030093, 0.036692965},
             {1.3910964, 1.5747400, 2.2271012, 3.3753141, 3.351264},
             {1.2644805, 1.0855451, 0.7632002, 0.4733308, 0.2139879, 1.3546433, 1.2995956, 1.2233586}}}) {
    const Case c = rolling(peer.speed, peer.more);
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

TEST(RollingPair, HasAStateWithoutLoadToo) {
  // The peer's rests from many starts (folded_pair_test.cpp): the loaded one, one that repels, and one whose balls are lost.
  const Case c = rolling("15200 rpm");
  const auto found = find_operating_points(*loop_of(c), preload_limits(c.parameters.preload));
  ASSERT_EQ(found.points.size(), 3u);
  const std::array<double, 3> heat = {195.615505, 91.296676, 91.206451}, preload = {888.42841, 4.41881, 0.},
                              eigenvalue = {-3.729418e-04, 2.687804e-01, -3.741879e-04};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found.points[i].heat, heat[i], 1e-6 * heat[i]) << "W, as above";
    EXPECT_NEAR(found.points[i].state.preload, preload[i], 1e-5 * (1. + 0.1 * preload[i]))
        << "N: printed digits, and 1e-6";
    // At 5 N differences over 20 nm meet balls that are closed by 130 nm: (0.02/0.13)^4 of their conductance's slope.
    EXPECT_NEAR(found.points[i].response.eigenvalue.real() / eigenvalue[i], 1., i == 1 ? 1e-3 : 1e-5);
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
  EXPECT_NEAR(speed->factor * 15200., 21650.068, 1.1e-4 * 21650.) << "rpm";
  EXPECT_NEAR(preload->factor * 290., 2531.6362, 1.1e-4 * 2532.) << "N";
  EXPECT_NEAR(cooling->factor, 0.137165, 1.1e-4 * 0.1372);
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
  EXPECT_NEAR(course.time, 5.676008, 1e-6 * 5.7) << "s";
  EXPECT_NEAR(loop->state({course.y.data(), loop->size()}).preload, 18850.63266, 1e-6 * 18851.) << "N";
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
