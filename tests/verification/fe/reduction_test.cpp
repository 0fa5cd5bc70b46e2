// Two rings, one in the other, with a node that both are linked to. Their mesh is so small that all of its modes can be had: the responses of
//   dz_i/dt = - rate_i z_i + in_i q:   step  sum out_i in_i (1 - exp(-rate_i t))/rate_i,   joule at once  sum out_i in_i exp(-rate_i t)
// are then exact, and what a reduction says of its own error can be held against them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/errors.h"
#include "fe_room.h"

namespace rotordrop {
namespace {

HeatConductionProblem two_rings() {
  HeatConductionProblem p;
  const PropertyTable k(46.), c(460.);
  p.bodies = {{"inside", {0., 20e-3}, {35e-3, 40e-3}, 7800., k, c},
              {"outside", {0., 20e-3}, {50e-3, 60e-3}, 7800., k, c}};
  p.nodes = {{"between", 25.}};
  p.ports = {{"bore", {{0, HeatSide::inner}}},
             {"race", {{0, HeatSide::outer}}},
             {"outer_race", {{1, HeatSide::inner}}},
             {"node", {}, 0}};
  p.links = {{1, 3, 0.5}, {2, 3, 0.7}, {3, {}, 50.}};
  p.convections = {{{1, HeatSide::outer}, 30., 0., 293.15}};
  p.numerics.cells = 5;
  p.numerics.degree = 1;
  p.numerics.grading = 30;
  return p;
}

struct Outputs {
  std::vector<std::vector<double>> step, joule;  ///< [mean][port]
  std::vector<double> port;
};
Outputs responses(const ReducedHeat& heat, double t) {
  Outputs o;
  const auto sum = [&](const std::vector<double>& out, const std::vector<double>& in, bool is_step) {
    double s = 0.;
    for (std::size_t i = 0; i < heat.n_modes(); ++i) {
      const double r = heat.rate[i];
      const double f = !is_step ? std::exp(-r * t) : r * t < 1e-8 ? t : -std::expm1(-r * t) / r;
      s += out[i] * in[i] / heat.capacity * f;
    }
    return s;
  };
  for (const auto* list : {&heat.bodies, &heat.nodes})
    for (const auto& mean : *list) {
      o.step.emplace_back();
      o.joule.emplace_back();
      for (const auto& port : heat.ports) {
        o.step.back().push_back(sum(mean.shape, port.shape, true));
        o.joule.back().push_back(sum(mean.shape, port.shape, false));
      }
    }
  for (const auto& port : heat.ports) o.port.push_back(sum(port.shape, port.shape, true) + port.at_once);
  return o;
}

/// Largest error of all responses, as model/reduced_heat.h defines it, at times of this test's own.
double true_error(const ReducedHeat& few, const ReducedHeat& all, const ReductionSettings& settings) {
  double largest = 0.;
  for (double t = settings.shortest_time; t <= settings.longest_time; t *= 1.17) {
    const Outputs a = responses(few, t), b = responses(all, t);
    for (std::size_t p = 0; p < b.port.size(); ++p) {
      largest = std::max(largest, std::fabs(a.port[p] / b.port[p] - 1.));
      if (t < 10. * settings.shortest_time) continue;
      for (const auto& [mine, exact] : {std::pair{&a.step, &b.step}, std::pair{&a.joule, &b.joule}}) {
        double warmest = 0.;
        for (const auto& mean : *exact) warmest = std::max(warmest, std::fabs(mean[p]));
        for (std::size_t k = 0; k < exact->size(); ++k)
          largest = std::max(largest,
                             std::fabs((*mine)[k][p] - (*exact)[k][p]) / (std::fabs((*exact)[k][p]) + 1e-3 * warmest));
      }
    }
  }
  return largest;
}

ReducedHeat reduced(const ReductionSettings& settings) { return make_solver(two_rings())->reduce(settings); }
ReducedHeat all_modes() {
  ReductionSettings all;
  all.modes = 0;
  return reduced(all);
}

TEST(Reduction, TakesAsManyModesAsItsToleranceNeeds) {
  const ReducedHeat all = all_modes();
  std::size_t before = 0;
  for (const double tolerance : {0.05, 0.005, 2e-3}) {
    ReductionSettings settings;
    settings.response_tolerance = tolerance;
    const ReducedHeat few = reduced(settings);
    EXPECT_LE(few.response_error, tolerance);
    EXPECT_LE(true_error(few, all, settings), 1.1 * tolerance) << "a tenth more: between the times that were looked at";
    EXPECT_GT(few.n_modes(), before);
    EXPECT_LT(few.n_modes(), all.n_modes());
    before = few.n_modes();
  }
}

TEST(Reduction, TellsTheErrorOfTooFewModes) {
  const ReducedHeat all = all_modes();
  for (const std::size_t modes : {12, 18}) {
    ReductionSettings settings;
    settings.modes = modes;
    const ReducedHeat few = reduced(settings);
    EXPECT_LE(few.n_modes(), modes);
    EXPECT_GT(few.response_error, settings.response_tolerance);
    EXPECT_FALSE(few.worst_response.empty());
    const double error = true_error(few, all, settings);
    EXPECT_NEAR(few.response_error / error, 1., 0.15) << "between the times that were looked at; true error " << error;
  }
}

TEST(Reduction, ReportsTheLargestOfItsErrors) {
  ReductionSettings settings;
  const ReducedHeat few = reduced(settings);
  double largest = 0.;
  for (const auto* list : {&few.ports, &few.bodies, &few.nodes})
    for (const auto& output : *list) largest = std::max(largest, output.response_error);
  EXPECT_DOUBLE_EQ(few.response_error, largest);
}

TEST(HeatConduction, RefusesToCoolBelowZeroKelvin) {
  // 293.15 K times the capacity of the outer ring are some 200 kJ: 20 kW through its outside take that out in 10 s.
  const auto cool = [](bool in_windows, bool by_port) {
    HeatConductionProblem p = two_rings();
    const HeatBoundary outside{1, HeatSide::outer};
    if (by_port)
      p.ports.push_back({"housing", {outside}});
    else
      p.fluxes = {{outside, {0.}, {-20e3 / (2. * M_PI * 60e-3 * 20e-3)}}};
    const auto solver = make_solver(p);
    if (by_port) solver->set_port_heat(std::vector<double>{0., 0., 0., 0., -20e3});
    try {
      if (in_windows)
        for (int i = 0; i < 1000; ++i) solver->advance_window(0.01);
      else
        solver->advance_to(10.);
    } catch (const SolverError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  for (const bool in_windows : {false, true}) {
    if (in_windows) {
      const std::string words = cool(true, true);
      EXPECT_NE(words.find("body \"outside\" is cooled below 0 K at t = "), std::string::npos) << words;
      EXPECT_NE(words.find("Port housing takes 2e+04 W out"), std::string::npos) << words;
    } else {
      const std::string words = cool(false, false);
      EXPECT_NE(words.find("body \"outside\" is cooled below 0 K at t = "), std::string::npos) << words;
      EXPECT_NE(words.find("boundary outside.outer takes 2e+04 W out"), std::string::npos) << words;
    }
  }
}

}  // namespace
}  // namespace rotordrop
