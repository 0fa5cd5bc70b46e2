// Growth at the contact points: what uniform heating, warm rings and ceramic balls do to the pair TB2 and to a deep-groove bearing under thrust.
//
// A ROW OF AN UNLOADED PAIR, or of a ring that is pushed along its axis, in the plane of the axis. n = (s sin phi, cos phi), s = 1 where the outer
// contact lies on the +x side. Contact points
//   P_in = (x_row, d_m/2) - (d/2) n,   P_out = (x_row, d_m/2) + (d/2) n,
// groove centres a groove radius f d from them: C_in = P_in + f_in d n, C_out = P_out - f_out d n. A ring that is uniformly warm by T is alpha T larger
// in every length, positions of its points from the bearing's middle included. The ball is pressed by
//   delta = |C_in - C_out| - (f_in d)(1 + alpha T_in) - (f_out d)(1 + alpha T_out) + d (1 + alpha_b T_b),
// and Z balls carry Z K delta^1.5 s B_x / |B| along the axis. The pair is symmetric: its inner ring stays in the middle.
//
// UNIFORM HEATING OF ONE MATERIAL is a similarity: lengths and the approach grow by 1 + alpha T = 1.0006 at 50 K, loads by less than that,
// 290 N stays within 1e-3. THE PAPER'S growth (shoulders, radial) leaves (39 - 46 mm) alpha T and 4.7625 mm alpha T of the balls; issued
// as 783 N at 50 K.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/preload/build_preload.h"
#include "analysis/preload/preload_criterion.h"
#include "analysis/statics/statics.h"
#include "machine/build_machine.h"
#include "study/preload/preload_maps.h"
#include "study/preload/preload_tables.h"

namespace rotordrop {
namespace {

constexpr double ambient = 293.15, steel = 11.8e-6, ceramic = 3.2e-6;

Case of_case(std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(), "thermal.expansion=\"formula\"");
  return read_case(std::string(ROTORDROP_SOURCE_DIR) + "/params/neisi2019.toml", overrides);
}

/// Rises of the parts [K].
struct Rises {
  double inner = 0, outer = 0, ball = 0;
};

struct Row {
  int Z;
  double d, d_m, f_in, f_out, phi, clearance, x, s, K, alpha, alpha_ball;
  struct Contact {
    double load, axial;  // [N], of one ball; of the row, in the direction s
  };
  /// @param approach  of the inner groove towards s, from where balls and races just touch at the angle phi [m]
  [[nodiscard]] Contact at(double approach, const Rises& T = {}) const {
    const std::array<double, 2> n = {s * std::sin(phi), std::cos(phi)};
    const double in = 1. + alpha * T.inner, out = 1. + alpha * T.outer, ball = 1. + alpha_ball * T.ball;
    std::array<double, 2> B{};
    for (std::size_t k = 0; k < 2; ++k) {
      const double middle = k == 0 ? x : 0.5 * d_m;
      const double centre_in = (middle + (f_in - 0.5) * d * n[k]) * in,
                   centre_out = (middle - (f_out - 0.5) * d * n[k]) * out;
      B[k] = centre_in - centre_out;
    }
    B[0] += s * approach;
    B[1] -= clearance;
    const double distance = std::hypot(B[0], B[1]);
    const double delta = std::max(distance - f_in * d * in - f_out * d * out + d * ball, 0.);
    const double Q = K * delta * std::sqrt(delta);
    return {Q, Z * Q * s * B[0] / distance};
  }
  /// Bisection.
  [[nodiscard]] double approach_of(double axial, const Rises& T = {}) const {
    double low = 0., high = 1e-3;
    while (high - low > 1e-15) {
      const double middle = 0.5 * (low + high);
      (at(middle, T).axial < axial ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
};

/// The stiffness of the contacts is the program's; all lengths are the case's.
Row pair_row(const Case& c, bool is_X, double alpha_ball = steel) {
  const auto data = touchdown_data_of(c.parameters, "TB2", touchdown_of(c.parameters, "TB2"));
  return {23,
          9.525e-3,
          85e-3,
          0.52,
          0.52,
          25. * std::numbers::pi / 180.,
          0.,
          8e-3,
          is_X ? 1. : -1.,
          data.rows[0].stiffness,
          steel,
          alpha_ball};
}

Expansion statics_growth(const Case& base, const Rises& T) {
  Case c = base;
  auto& s = c.parameters.statics;
  s.inner_rise = s.shaft_rise = T.inner;
  s.outer_rise = T.outer;
  s.ball_rise = T.ball;
  return static_growth(c.parameters, touchdown_of(c.parameters, "TB2"));
}

double preload_under(const Case& c, const Rises& T) {
  return build_running_bearing(c.parameters, "TB2", 0., rest_finder("TB2"))->at(statics_growth(c, T)).preload;
}

/// MODEL: 1e-3 at +-50 K; at 150 K similarity itself says 1.003.
double allowed(double rise) { return 290. * (std::fabs(rise) > 100. ? 4e-3 : 1e-3); }

TEST(UniformHeating, LeavesThePreloadOfAPairOfOneMaterial) {
  for (const char* arrangement : {"X", "O"}) {
    const Case c =
        of_case({std::string("bearings.TB2.arrangement=") + arrangement, "preload.speed=0 rpm",
                 "preload.growth_by_speed=\"none\"", "preload.map.inner_rise=[\"-50 K\", \"50 K\", \"150 K\"]",
                 "preload.map.outer_rise=[\"-50 K\", \"50 K\", \"150 K\"]"});
    const Row row = pair_row(c, *arrangement == 'X');
    const double approach = row.approach_of(290.);
    const auto loop = build_preload_loop(c.parameters, c.tree, "TB2", rest_finder("TB2"));
    std::vector<PreloadTable> tables;
    make_preload_maps(c, "TB2", tables);
    const auto map = std::find_if(tables.begin(), tables.end(), [](const PreloadTable& t) {
      return t.group.channels.size() > 1 && t.group.channels[0].path.ends_with("maps/rise/preload");
    });
    ASSERT_NE(map, tables.end());
    std::size_t k = 0;
    for (const double T : {-50., 50., 150.}) {
      const double expected = row.at(approach, {T, T, T}).axial;
      EXPECT_NEAR(expected, 290., allowed(T)) << "N";
      const double in_statics = preload_under(c, {T, T, T});
      const double by_circuit = loop->state(std::vector<double>(loop->size(), ambient + T)).preload;
      const double in_map = map->rows[k][k];  // the preload's columns come first
      printf("%s, %+.0f K: statics %.6f, circuit %.6f, map %.6f, by hand %.6f N\n", arrangement, T, in_statics,
             by_circuit, in_map, expected);
      for (const double preload : {in_statics, by_circuit, in_map}) {
        EXPECT_NEAR(preload, 290., allowed(T)) << "N, " << arrangement << ", " << T << " K";
        EXPECT_NEAR(preload, expected, 1e-6 * 290.) << "N, " << arrangement << ", " << T << " K";
      }
      ++k;
    }
  }
}

TEST(UniformHeating, WouldPressThePairByThePapersGrowth) {
  const Case c = of_case({"thermal.expansion=\"paper\"", "preload.growth_by_speed=\"none\""});
  const auto loop = build_preload_loop(c.parameters, c.tree, "TB2", rest_finder("TB2"), {.speed = 0.});
  for (const double preload :
       {preload_under(c, {50., 50., 50.}), loop->state(std::vector<double>(loop->size(), ambient + 50.)).preload}) {
    EXPECT_NEAR(preload, 783., 1.) << "N";
    EXPECT_GT(preload - 290., 100. * allowed(50.));
  }
}

TEST(UniformHeating, OfAHybridPairTakesItsPreloadAway) {
  for (const char* arrangement : {"X", "O"}) {
    const Case c = of_case({"bearings.TB2.ball=\"Si3N4\"", std::string("bearings.TB2.arrangement=") + arrangement});
    const Row row = pair_row(c, *arrangement == 'X', ceramic);
    const double approach = row.approach_of(290.);
    for (const double T : {-20., 5., 15., 20.}) {
      const double expected = row.at(approach, {T, T, T}).axial;
      EXPECT_NEAR(preload_under(c, {T, T, T}), expected, 1e-6 * expected) << "N, " << arrangement << ", " << T << " K";
    }
    EXPECT_LT(preload_under(c, {20., 20., 20.}), 0.2 * 290.) << "N";
    EXPECT_LT(preload_under(c, {27., 27., 27.}), 0.1) << "N: gone near 25 K";
  }
}

TEST(WarmInnerRing, PressesAnXPairMoreThanAnOPair) {
  // The distance between the inner rings' contact points grows by spacer and rings: apart in an X pair, where that loads the rows; also in an
  // O pair, where it relieves them.
  std::array<double, 2> found{};
  for (std::size_t k = 0; k < 2; ++k) {
    const Case c = of_case({std::string("bearings.TB2.arrangement=") + (k == 0 ? "X" : "O")});
    const Row row = pair_row(c, k == 0);
    const double approach = row.approach_of(290.);
    for (const Rises& T : {Rises{5., 0., 0.}, Rises{5., 0., 2.5}, Rises{0., 4., 1.}, Rises{8., 6., 7.}}) {
      const double expected = row.at(approach, T).axial;
      EXPECT_NEAR(preload_under(c, T), expected, 1e-6 * expected) << "N";
    }
    found[k] = preload_under(c, {5., 0., 0.});
  }
  // Of the axial approach alone: 2 strain x_row sin phi of the normal's.
  EXPECT_GT(found[0], 1.1 * found[1]) << "N";
  const Case closer = of_case({"bearings.TB2.row_spacing=\"12 mm\""});
  EXPECT_LT(preload_under(closer, {5., 0., 0.}), found[0] - 10.) << "N: rows 12 mm apart instead of 16 mm";
}

TEST(UniformHeating, LeavesADeepGrooveBearingUnderThrustInItsPlace) {
  // The contact angle is far from the nominal 0: about 15 degrees. Clearance does not grow, so x of order sqrt(2 A c) goes with the root of A.
  const Case c = of_case(
      {"bearings.TB1.ball=steel", "statics.subject=\"bearings\"", "statics.force=[\"500 N\", \"0 N\", \"0 N\"]"});
  const auto& b = touchdown_of(c.parameters, "TB1");
  const auto data = touchdown_data_of(c.parameters, "TB1", b);
  const Row row{14, 11.906e-3, 90e-3, 0.52, 0.52, 0., 19e-6, 0., 1., data.rows[0].stiffness, steel, steel};
  const auto place = [&](const Rises& T) {
    Case warm = c;
    auto& s = warm.parameters.statics;
    s.inner_rise = s.shaft_rise = T.inner;
    s.outer_rise = T.outer;
    s.ball_rise = T.ball;
    auto system = bearing_equilibrium(warm.parameters, "TB1", touchdown_of(warm.parameters, "TB1"));
    std::vector<double> x(system.size());
    rest_finder("TB1")(system, x);
    return system.place(x)[0];
  };
  const double cold = place({});
  EXPECT_NEAR(cold, row.approach_of(500.), 1e-5 * cold) << "m";
  EXPECT_GT(std::atan2(cold, 0.04 * 11.906e-3 - 19e-6), 0.2) << "rad: the contact angle, nearly";
  for (const double T : {-50., 50., 150.}) {
    EXPECT_NEAR(place({T, T, T}), row.approach_of(500., {T, T, T}), 1e-5 * cold) << "m";
    EXPECT_NEAR(place({T, T, T}) / cold, 1., 1.2 * steel * std::fabs(T)) << "apart from similarity";
  }
  // A warm inner ring closes the clearance: less travel.
  EXPECT_NEAR(place({10., 0., 0.}), row.approach_of(500., {10., 0., 0.}), 1e-5 * cold) << "m";
  EXPECT_LT(place({10., 0., 0.}), 0.97 * cold);
}

}  // namespace
}  // namespace rotordrop
