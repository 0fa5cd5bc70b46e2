// Thermal preload of the reference case's pair TB2, running steadily on the published circuit (with the fin and rolling balls: rolling_pair_test.cpp).
//
// PEER. validation/preload_loop.py writes the same problem again (rows of an unloaded, symmetric pair in closed form, the circuit with its
// massless contacts as unknowns, scipy's fsolve, brentq and Radau) and shares no code with the program; the numbers below are what it prints.
//
// WITHOUT A PEER. The loop gain is the derivative of the heat that the steady state of an assumed heat makes; differences of that map use none of
// the criterion's derivatives. Its eigenvalue is one of the transient's own rates. A transient that settles ends in the operating point.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "analysis/preload/build_preload.h"
#include "study/preload/preload_course.h"

namespace rotordrop {
namespace {

constexpr double rpm = std::numbers::pi / 30., ambient = 293.15;

Case reference(std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.begin(), {"thermal.expansion=formula", "thermal.contact_conduction=fixed",
                                       "thermal.spreading=none", "thermal.shaft=lump"});
  overrides.insert(overrides.begin(), "thermal.growth_by_speed=closed-form");
  return read_case(std::string(ROTORDROP_SOURCE_DIR) + "/params/neisi2019.toml", overrides);
}

std::unique_ptr<PreloadLoop> loop_of(const Case& c, const PreloadVariation& v = {}) {
  return build_preload_loop(c.parameters, c.tree, "TB2", rest_finder("TB2"), v);
}

const Case& at_3000_rpm() {
  static const Case c = reference({"preload.speed=3000 rpm"});
  return c;
}

const std::array<std::string, 5> nodes = {"TB2/shaft", "TB2/inner_ring", "TB2/ball", "TB2/outer_ring", "TB2/housing"};

TEST(PreloadOfThePair, OperatingPointsAreThoseOfThePeer) {
  struct Line {
    double heat, preload, ball_load, pressure, gain, eigenvalue;
    std::array<double, 5> rise;
  };
  const std::array<Line, 2> peer = {{{21.49337660,
                                      465.676694,
                                      46.8606809,
                                      7.589072e+08,
                                      0.283685,
                                      -9.1455128e-04,
                                      {13.0518690, 13.2341771, 11.1673376, 12.0482474, 11.9306375}},
                                     {177.42526336,
                                      3459.612572,
                                      352.7829914,
                                      1.487379e+09,
                                      1.813546,
                                      1.0712929e-03,
                                      {93.2258606, 94.5280366, 75.3737373, 76.0160907, 74.8483608}}}};
  const Case c = reference({"preload.speed=4000 rpm"});
  const auto loop = loop_of(c);
  const auto found = find_operating_points(*loop, preload_limits(c.parameters.preload));
  ASSERT_EQ(found.points.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& p = found.points[k];
    printf("heat %.6f W, preload %.5f N, gain %.6f, eigenvalue %.6e 1/s\n", p.heat, p.state.preload, p.response.gain,
           p.response.eigenvalue.real());
    // The peer's printed digits; 1e-6 where it takes differences.
    EXPECT_NEAR(p.heat, peer[k].heat, 2e-7) << "W";
    EXPECT_NEAR(p.state.preload, peer[k].preload, 1e-5) << "N";
    EXPECT_NEAR(p.state.largest_ball_load, peer[k].ball_load, 1e-6) << "N";
    EXPECT_NEAR(p.state.largest_pressure, peer[k].pressure, 1e3) << "Pa";
    EXPECT_NEAR(p.response.gain, peer[k].gain, 2e-6);
    EXPECT_NEAR(p.response.eigenvalue.real(), peer[k].eigenvalue, 2e-6 * 1e-3) << "1/s";
    const auto T = loop->node_temperatures(p.T, p.heat);
    for (std::size_t n = 0; n < T.size(); ++n) {
      const auto node = std::find(nodes.begin(), nodes.end(), loop->nodes()[n].name);
      if (node == nodes.end()) continue;  // contacts
      EXPECT_NEAR(T[n] - ambient, peer[k].rise[static_cast<std::size_t>(node - nodes.begin())], 1e-6) << *node;
    }
  }
}

TEST(PreloadOfThePair, CriticalSpeedPreloadAndCoolingAreThoseOfThePeer) {
  const Case& c = at_3000_rpm();
  const auto limits = preload_limits(c.parameters.preload);
  const auto speed = find_critical_factor([&](double f) { return loop_of(c, {.speed = f}); }, 2., limits);
  const auto preload = find_critical_factor([&](double f) { return loop_of(c, {.preload = f}); }, 2., limits);
  const auto cooling = find_critical_factor([&](double f) { return loop_of(c, {.cooling = f}); }, 0.5, limits);
  ASSERT_TRUE(speed && preload && cooling);
  // The search ends within 1e-4.
  EXPECT_NEAR(speed->factor * 3000., 5478.458, 1.1e-4 * 5478.) << "rpm";
  EXPECT_NEAR(preload->factor * 290., 1101.2653, 1.1e-4 * 1101.) << "N";
  EXPECT_NEAR(cooling->factor, 0.063372, 1.1e-4 * 0.0634);
  EXPECT_EQ(cooling->by, CriticalFactor::By::limit) << "150 degC come first";
  for (const auto& critical : {speed, preload}) {
    EXPECT_EQ(critical->by, CriticalFactor::By::loop);
    EXPECT_GT(critical->gain, 0.95) << "it tends to one";
    EXPECT_LT(critical->gain, 1.);
  }
}

TEST(PreloadOfThePair, RunsAwayWhenThePeerDoes) {
  // Radau at 1e-9; ours at 1e-10 of some 300 K. The way out multiplies early errors by some tens.
  struct Line {
    const char* speed;
    double time, preload;
  };
  for (const auto& [speed, time, preload] :
       {Line{"6000 rpm", 6963.801350, 5371.64481}, Line{"15200 rpm", 176.545354, 8886.22935}}) {
    const Case c = reference({std::string("preload.speed=") + speed, "preload.tolerance=1e-10"});
    const auto loop = loop_of(c);
    const auto course = follow_preload(*loop, c.parameters.preload, "/");
    EXPECT_EQ(course.limit, LimitMet::temperature);
    EXPECT_NEAR(course.time, time, 1e-6 * time) << "s";
    EXPECT_NEAR(loop->state({course.y.data(), loop->size()}).preload, preload, 1e-6 * preload) << "N";
    EXPECT_TRUE(find_operating_points(*loop, preload_limits(c.parameters.preload)).points.empty());
  }
}

TEST(PreloadOfThePair, TheGainIsThatOfAssumedAndPredictedHeat) {
  for (const char* model : {"quasi-static", "inertial"})
    for (const char* heat_kind : {"energy-consistent", "with-spin", "ball-speed"}) {
      // Heat of ball speed is 4.4 times the work; at 2000 rpm the pair would run away.
      const char* speed = std::string(heat_kind) == "ball-speed" ? "preload.speed=400 rpm" : "preload.speed=2000 rpm";
      const Case c = reference({speed, std::string("bearings.TB2.ball_model=") + model,
                                std::string("bearings.TB2.internal_heat=") + heat_kind,
                                "preload.force=[\"40 N\", \"-100 N\", \"30 N\"]"});
      const auto loop = loop_of(c);
      const auto found = find_operating_points(*loop, preload_limits(c.parameters.preload));
      ASSERT_FALSE(found.points.empty()) << model << heat_kind;
      const auto& p = found.points[0];
      const auto made = [&](double heat) { return loop->state(loop->steady(heat, p.T)).heat; };
      EXPECT_NEAR(made(p.heat), p.heat, 1e-8 * p.heat) << "W";
      const double h = 0.01 * p.heat;
      const double gain =
          (8. * (made(p.heat + h) - made(p.heat - h)) - (made(p.heat + 2. * h) - made(p.heat - 2. * h))) / (12. * h);
      EXPECT_NEAR(p.response.gain, gain, 1e-5 * gain) << model << ", " << heat_kind;
      EXPECT_NEAR(p.response.gain, p.response.heat_per_preload * p.response.preload_per_heat, 1e-12);
    }
}

TEST(PreloadOfThePair, TheEigenvalueIsOneOfTheTransientsOwnRates) {
  const auto loop = loop_of(at_3000_rpm());
  const PreloadTransient system(*loop);
  const auto n = static_cast<Eigen::Index>(loop->size());
  for (const auto& p : find_operating_points(*loop, preload_limits(at_3000_rpm().parameters.preload)).points) {
    std::vector<double> y(system.layout().size(), 0.), above(y.size()), below(y.size());
    Eigen::MatrixXd A(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      std::copy(p.T.begin(), p.T.end(), y.begin());
      const double h = 0.01;
      y[static_cast<std::size_t>(k)] += h;
      system.rhs(0., y, above);
      y[static_cast<std::size_t>(k)] -= 2. * h;
      system.rhs(0., y, below);
      for (Eigen::Index i = 0; i < n; ++i)
        A(i, k) = (above[static_cast<std::size_t>(i)] - below[static_cast<std::size_t>(i)]) / (2. * h);
    }
    const double largest = A.eigenvalues().real().maxCoeff();
    EXPECT_NEAR(p.response.eigenvalue.real(), largest, 1e-5 * std::fabs(largest)) << "1/s";
    EXPECT_EQ(p.response.gain < 1., largest < 0.) << "det(J + b c^T) = det(J) (1 - gain)";
  }
}

TEST(PreloadOfThePair, ATransientThatSettlesEndsInTheOperatingPoint) {
  const Case& c = at_3000_rpm();
  const auto loop = loop_of(c);
  const auto course = follow_preload(*loop, c.parameters.preload, "/");
  ASSERT_TRUE(course.is_settled);
  const auto points = find_operating_points(*loop, preload_limits(c.parameters.preload));
  ASSERT_TRUE(points.first_stable());
  const auto& p = *points.first_stable();
  // What is left of the slowest mode is its rate over its eigenvalue.
  const double left = 1.5 * c.parameters.preload.settled_rate / -p.response.eigenvalue.real();
  for (std::size_t i = 0; i < loop->size(); ++i) EXPECT_NEAR(course.y[i], p.T[i], left) << "K";
  EXPECT_LT(left, 0.005) << "K";
}

TEST(PreloadOfThePair, HeatMadeIsLostOrStoredAndIsWhatTheTorqueMakes) {
  const Case& c = at_3000_rpm();
  const auto loop = loop_of(c);
  const auto course = follow_preload(*loop, c.parameters.preload, "/");
  const double made = course.y[loop->size()], lost = course.y[loop->size() + 1];
  const double stored = loop->stored_energy({course.y.data(), loop->size()});
  EXPECT_NEAR(made - lost - stored, 0., 1e-9 * made) << "J";
  // On its own: trapezoids of torque times speed over the recorded steps; steps are a small part of the slowest mode's 44 min.
  const auto column = [&](const std::string& name) {
    const auto& channels = course.table.group.channels;
    return static_cast<std::size_t>(
        std::find_if(channels.begin(), channels.end(), [&](const auto& x) { return x.path == "/" + name; }) -
        channels.begin());
  };
  const std::size_t load = column("load_torque"), drag = column("drag_torque");
  double sum = 0., stored_again = 0.;
  for (std::size_t i = 1; i < course.table.axis.size(); ++i) {
    const auto power = [&](std::size_t k) {
      return (course.table.rows[k][load] + course.table.rows[k][drag]) * 3000. * rpm;
    };
    sum += 0.5 * (power(i) + power(i - 1)) * (course.table.axis[i] - course.table.axis[i - 1]);
  }
  EXPECT_NEAR(sum, made, 1e-4 * made) << "J";
  // Stored: densities and dimensions of the case's parts, not the circuit's capacities.
  const double rho_c = 7800. * 510., pi = std::numbers::pi;
  const auto area = [&](double d) { return 0.25 * pi * d * d; };
  const std::array<double, 5> capacity = {
      rho_c * area(69.5e-3) * 32e-3, 0.21 * 510., 46. * pi / 6. * std::pow(9.525e-3, 3) * rho_c,
      rho_c * (area(0.1) - area(0.092)) * 32e-3, rho_c * (area(0.12) - area(0.1)) * 50e-3};
  for (std::size_t i = 0; i < nodes.size(); ++i)
    stored_again += capacity[i] * (course.table.rows.back()[column("temperature/" + nodes[i])] - ambient);
  EXPECT_NEAR(stored_again, stored, 1e-9 * stored) << "J";
}

TEST(PreloadOfThePair, GrowsAsTheModelPageEstimates) {
  // validation/preload_loop.py; docs/theory/model.md estimates 590 and 1630 N.
  const auto running = build_running_bearing(at_3000_rpm().parameters, "TB2", 0., rest_finder("TB2"));
  EXPECT_NEAR(running->at({}).preload, 290., 1e-6) << "N";
  EXPECT_NEAR(running->at({.inner_race = 1.4e-6}).preload, 593.708003, 1e-5) << "N";
  EXPECT_NEAR(running->at({.inner_race = 5e-6}).preload, 1641.956429, 1e-5) << "N";
}

TEST(PreloadOfThePair, TheRadialClearanceIsWhereBallsBeginToTouch) {
  const Case& c = at_3000_rpm();
  for (const char* name : {"TB1", "TB2"}) {
    const auto running = build_running_bearing(c.parameters, name, 0., rest_finder(name));
    // A raceway that grows by what the ring may move leaves every ball just touched. Held in the middle; a pair's balls are pressed before.
    const double clearance = running->at({}).radial_clearance;
    EXPECT_EQ(clearance > 0., running->at({}).is_floating) << name;
    EXPECT_TRUE(running->at({.inner_race = clearance - 1e-8}).is_floating) << name;
    EXPECT_FALSE(running->at({.inner_race = clearance + 1e-8}).is_floating) << name;
    EXPECT_NEAR(running->at({.inner_race = 2e-6}).radial_clearance, clearance - 2e-6, 1e-15) << "m";
    const double warm = running->at({.ball = 1e-6}).radial_clearance;  // with larger balls
    EXPECT_TRUE(running->at({.inner_race = warm - 1e-8, .ball = 1e-6}).is_floating) << name;
    EXPECT_FALSE(running->at({.inner_race = warm + 1e-8, .ball = 1e-6}).is_floating) << name;
  }
  // Rows that grow differently: the one that grows more, by half of the difference, touches first.
  const auto pair = build_running_bearing(c.parameters, "TB2", 0., rest_finder("TB2"));
  EXPECT_NEAR(pair->at({.row_difference = 2e-6}).radial_clearance, pair->at({}).radial_clearance - 1e-6, 1e-15) << "m";
}

TEST(PreloadOfThePair, NodesThatAUserAddsTakePart) {
  const Case plain = reference({"preload.speed=3000 rpm"});
  Case cooled = reference({"preload.speed=3000 rpm",
                           "thermal.resistor=[{ between = [\"TB2/inner_ring\", \"ambient\"], resistance = 1.0 }]"});
  const auto limits = preload_limits(plain.parameters.preload);
  const auto before = find_operating_points(*loop_of(plain), limits),
             after = find_operating_points(*loop_of(cooled), limits);
  ASSERT_TRUE(before.first_stable() && after.first_stable());
  EXPECT_LT(after.first_stable()->response.gain, 0.8 * before.first_stable()->response.gain)
      << "an inner ring that is cooled grows less";
}

}  // namespace
}  // namespace rotordrop
