// Operating points where steady temperatures fold back over their heat: balls that lose their load lose what they conduct.
//
// MADE UP. Outer and inner ring with resistances R_o, R_i to ambient. All the heat enters the outer ring, balls conduct G = g w to the inner one,
//   w = sqrt(u),   u = u_0 + k (x_i - x_o) the balls' approach, and the heat is H = H_0 + m u; without load, u < 0, G = 0 and H = H_0.
// Of H a part P = G (x_o - x_i) goes over the balls: x_i = P R_i, x_o = (H - P) R_o. With gamma = g (R_i + R_o), B = k R_o
//   P = gamma w / (1 + gamma w) R_o / (R_i + R_o) H,   u = u_0 - B H / (1 + gamma w).
// A held heat Q has the states Q(w) = (u_0 - w^2) (1 + gamma w) / B, which rises from w = 0, turns back and falls: the fold. A rest is
//   gamma w^3 + (1 + B m) w^2 - gamma u_0 w + B H_0 - u_0 = 0.
// Its roots w_1, w_2 > 0 are chosen; the third is w_3 = -(1 + B m) / gamma - w_1 - w_2, and
//   u_0 = -(w_1 w_2 + w_1 w_3 + w_2 w_3),   B H_0 = u_0 - gamma w_1 w_2 w_3.
// In roots of um: w_1 = 1/2, w_2 = 1, gamma = 2, B m = 3: w_3 = -7/2, u_0 = 19/4 um, B H_0 = 33/4 um. The gain is L = (dH/dw) / (dQ/dw),
//   B dQ/dw = gamma (u_0 - w^2) - 2 w (1 + gamma w):   L = 6 / 1.5 = 4 at w_2, 3 / 7 at w_1, 0 without load (x_o = H_0 R_o, u = -7/2 um).
// dQ/dw > 0 at both, so both are on the fold. Rates of both rings' rises, D = x_o - x_i and h = g k D / (2 w), by hand:
//   C_i A_11 = h - g w - 1/R_i,   C_i A_12 = g w - h,   C_o A_21 = m k - h + g w,   C_o A_22 = h - m k - g w - 1/R_o; with held heat m = 0.
// At w_2 det > 0 and the trace < 0: stable, though not with held heat.
//
// PEER of the pair with ceramic balls: a Python program with validation/preload_loop.py's equations and Si3N4's elasticity, density, heat capacity,
// conductivity and growth in their places. Rests by scipy's "hybr" from 120 starts, each the temperatures under a prescribed ball load; eigenvalues by
// numpy from differences of 10 uK, with the heat that follows the load and with a held one.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/preload/build_preload.h"
#include "study/preload/preload_steady.h"
#include "thermal/circuit/network_part.h"

namespace rotordrop {
namespace {

constexpr double ambient = 293.15, R_i = 1., R_o = 0.5, k = 4e-7, C = 500.;
constexpr double gamma_ = 2e3, B = k * R_o, m = 3. / B, u_0 = 4.75e-6, H_0 = 8.25e-6 / B, g = gamma_ / (R_i + R_o);

struct LosingBalls final : RunningBearing {
  [[nodiscard]] RunningState at(const Expansion& growth) const override {
    const double u = std::max(u_0 + growth.inner_race - growth.outer_race, 0.);
    RunningState s;
    s.heat = H_0 + m * u;
    s.balls.inner_to_outer = g * std::sqrt(u);
    return s;
  }
  [[nodiscard]] bool balls_roll() const override { return true; }
  [[nodiscard]] double inner_share() const override { return 0.; }
};

PreloadLoop made_up() {
  using Net = ThermalNetworkData;
  Net net;
  net.ambient = ambient;
  net.nodes = {{"B/inner", C, "inner"}, {"B/outer", C, "outer"}, {"B/ball", 1., "balls"}};
  net.resistors = {{"B/inner", ambient_node, R_i, Net::Law::constant, 0., 0., 0},
                   {"B/outer", ambient_node, R_o, Net::Law::constant, 0., 0., 0},
                   {"B/ball", ambient_node, 1., Net::Law::constant, 0., 0., 0}};
  net.places = {{"B/inner", "B/inner", "B/inner", "B/outer", "B/ball", 1.}};
  net.growths = {{0, &Expansion::inner_race, "B/inner", k}, {0, &Expansion::outer_race, "B/outer", k}};
  return {std::make_shared<ThermalNetwork>(net), std::make_unique<LosingBalls>(), 1, 0, ambient};
}

const PreloadLimits wide{ambient + 1e4, 1e12};

/// Rises of inner ring, outer ring and balls at a load.
std::vector<double> rest(double w) {
  const double H = H_0 + m * w * w, P = gamma_ * w / (1. + gamma_ * w) * R_o / (R_i + R_o) * H;
  return {ambient + P * R_i, ambient + (H - P) * R_o, ambient};
}
/// Largest real part, the balls' -1 1/s aside.
double eigenvalue(double w, double m_) {
  const auto T = rest(w);
  const double h = g * k * (T[1] - T[0]) / (2. * w);
  const double A11 = (h - g * w - 1. / R_i) / C, A12 = (g * w - h) / C, A21 = (m_ * k - h + g * w) / C,
               A22 = (h - m_ * k - g * w - 1. / R_o) / C;
  const double trace = A11 + A22, under = 0.25 * trace * trace - (A11 * A22 - A12 * A21);
  return 0.5 * trace + std::sqrt(std::max(under, 0.));
}

TEST(FoldedRests, OfAMadeUpLoopAreThoseOfItsCubic) {
  const auto loop = made_up();
  const auto found = find_operating_points(loop, wide);
  ASSERT_EQ(found.points.size(), 3u) << "loaded, in between, without load: in the order of the way from cold";
  const std::array<double, 3> w = {1e-3, 0.5e-3, 0.}, gain = {4., 3. / 7., 0.};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& p = found.points[i];
    const auto T = rest(w[i]);
    // The search leaves 1e-9 of rises of some 20 K.
    for (std::size_t n = 0; n < T.size(); ++n) EXPECT_NEAR(p.T[n], T[n], 1e-7) << "K";
    EXPECT_NEAR(p.heat, H_0 + m * w[i] * w[i], 1e-6) << "W";
    // Differences over steps of h = 20 nm see the slope of a root of u wrong by 0.22 (h / u)^4: 9e-6 at u = 0.25 um. What is asked is a difference of terms that are three times as large.
    EXPECT_NEAR(p.response.gain, gain[i], 3e-5);
    EXPECT_EQ(p.response.is_stable(), i != 1);
    EXPECT_EQ(p.response.is_folded(), i != 2);
    if (w[i] == 0.) continue;
    EXPECT_NEAR(p.response.eigenvalue.real(), eigenvalue(w[i], m), 5e-5 * std::fabs(eigenvalue(w[i], m))) << "1/s";
    EXPECT_NEAR(p.response.eigenvalue_of_held_heat.real(), eigenvalue(w[i], 0.), 5e-5 * eigenvalue(w[i], 0.)) << "1/s";
  }
  EXPECT_EQ(found.first_stable(), &found.points[0]);
}

TEST(FoldedRests, AreWhereATransientIsSaidToSettleByTheirOwnEigenvalue) {
  const auto loop = made_up();
  PreloadCourse way;
  way.is_settled = true;
  for (const double w : {1e-3, 0.5e-3, 0.}) {
    auto near = rest(w);
    near[0] += 1e-3;
    auto known = find_operating_points(loop, wide);
    const auto at = add_settled(loop, near, known);
    ASSERT_TRUE(at);
    EXPECT_EQ(known.points.size(), 3u) << "it is one of them";
    EXPECT_EQ(verdict_of(way, known, at), w == 0.5e-3 ? "undecided" : "stable");
    OperatingPoints none;
    const auto added = add_settled(loop, near, none);
    ASSERT_TRUE(added);
    ASSERT_EQ(none.points.size(), 1u);
    EXPECT_NEAR(none.points[*added].T[1], rest(w)[1], 1e-7) << "K; Newton's method to 1e-10 of some 20 K";
    EXPECT_EQ(verdict_of(way, none, added), w == 0.5e-3 ? "undecided" : "stable");
  }
  auto known = find_operating_points(loop, wide);
  auto elsewhere = rest(1e-3);
  elsewhere[1] += 15.;
  EXPECT_FALSE(add_settled(loop, elsewhere, known)) << "no rest there";
  EXPECT_EQ(verdict_of(way, known, {}), "undecided") << "though stable points exist";
}

TEST(FoldedRests, OfThePairWithCeramicBallsAreThoseOfThePeer) {
  struct Point {
    double heat, preload, eigenvalue, held;
  };
  struct Line {
    const char* speed;
    std::vector<Point> points;
  };
  for (const Line& peer : {Line{"6000 rpm", {{19.373362, 0., -3.741879e-04, -3.741879e-04}}},
                           Line{"14000 rpm", {{79.524260, 0., -3.741879e-04, -3.741879e-04}}},
                           Line{"15200 rpm",
                                {{104.287526, 186.36130, -3.781231e-04, 6.839131e-04},
                                 {94.891489, 71.89032, 1.167303e-02, 1.339477e-02},
                                 {91.206451, 0., -3.741879e-04, -3.741879e-04}}}}) {
    const Case c = read_case(std::string(ROTORDROP_SOURCE_DIR) + "/params/neisi2019-preload.toml",
                             {"bearings.TB2.ball=\"Si3N4\"", std::string("preload.speed=") + peer.speed});
    const auto loop = build_preload_loop(c.parameters, c.tree, "TB2", rest_finder("TB2"));
    const auto found = find_operating_points(*loop, preload_limits(c.parameters.preload));
    ASSERT_EQ(found.points.size(), peer.points.size()) << peer.speed;
    for (std::size_t i = 0; i < peer.points.size(); ++i) {
      const auto& p = found.points[i];
      printf("%s: heat %.6f W, preload %.5f N, eigenvalue %.6e, with held heat %.6e 1/s\n", peer.speed, p.heat,
             p.state.preload, p.response.eigenvalue.real(), p.response.eigenvalue_of_held_heat.real());
      // As of the pair with steel balls (rolling_pair_test.cpp): 1e-6; eigenvalues by differences of both.
      EXPECT_NEAR(p.heat, peer.points[i].heat, 1e-6 * peer.points[i].heat) << "W";
      EXPECT_NEAR(p.state.preload, peer.points[i].preload, 1e-6 * peer.points[i].preload) << "N";
      EXPECT_NEAR(p.response.eigenvalue.real() / peer.points[i].eigenvalue, 1., 1e-5);
      EXPECT_NEAR(p.response.eigenvalue_of_held_heat.real() / peer.points[i].held, 1., 1e-5);
    }
  }
}

}  // namespace
}  // namespace rotordrop
