// Stepping of problems with one or two unknowns, of which the solution is known.
#include "conduction/assembled_equations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/errors.h"
#include "conduction/heat_stepper.h"

namespace rotordrop {
namespace {

constexpr double T_0 = 293.15, C = 2., K = 0.5;  // [K], [J/K], [W/K]

HeatConductionProblem problem() {
  HeatConductionProblem p;
  p.bodies.push_back({"ring", {0., 0.01}, {0.02, 0.03}, 7800., PropertyTable(46.), PropertyTable(460.), {}});
  p.initial_temperature = T_0;
  p.numerics.tolerance = 1e-10;
  return p;
}

/// One unknown: C dT/dt = loads - K (T - T_0).
AssembledHeat lump() {
  AssembledHeat a;
  a.row_start = {0, 1};
  a.column = {0};
  a.capacity = a.capacity_weights = {C};
  a.conductance = a.loss_weights = {K};
  a.ambient_load = {0.};
  a.body_of = {0};
  a.shortest_time = 1e-3;
  return a;
}

struct Stepped {
  Stepped(HeatConductionProblem p, AssembledHeat a)
      : problem(std::move(p)), assembled(std::move(a)), equations(problem, assembled), stepper(equations, problem) {}
  [[nodiscard]] double rise(Eigen::Index unknown = 0) const { return stepper.temperatures()[unknown] - T_0; }
  const HeatConductionProblem problem;
  const AssembledHeat assembled;
  AssembledEquations equations;
  HeatStepper stepper;
};

// Roundoff of absolute temperatures in some hundred steps, and the tolerance of a step.
constexpr double accuracy = 1e-8;

TEST(AssembledEquations, AFluxWarmsALumpThatCoolsExponentially) {
  auto p = problem();
  const double q = 20., area = 3.;
  p.fluxes.push_back({{0, HeatSide::inner}, {1.}, {q}});
  auto a = lump();
  a.flux_loads = {{area}};
  a.flux_areas = {area};
  Stepped s(p, a);
  s.stepper.advance_to(1.);
  EXPECT_EQ(s.rise(), 0.) << "before the flux begins";
  s.stepper.advance_to(6.);
  const double last = q * area / K, decay = std::exp(-K / C * 5.);
  EXPECT_NEAR(s.rise(), last * (1. - decay), accuracy * last);
  const HeatEnergy e = s.stepper.energy();
  EXPECT_NEAR(e.input, q * area * 5., 1e-9);
  EXPECT_NEAR(e.stored, C * last * (1. - decay), accuracy * C * last);
  EXPECT_NEAR(e.residual(), 0., accuracy * e.input);
}

TEST(AssembledEquations, HeatOfAPortMayRiseByTheSecond) {
  auto p = problem();
  p.ports.push_back({"bore", {{0, HeatSide::inner}}, {}, 0.});
  auto a = lump();
  a.ports = {{{0}, {1.}}};
  a.port_areas = {1e-3};
  Stepped s(p, a);
  const double t = 3., tau = C / K, decay = std::exp(-t / tau);
  double rise = 0., input = 0.;
  for (const auto& [watts, rate] : {std::pair{10., 4.}, {22., -6.}}) {  // the second from t on
    s.stepper.set_port_heat({{watts}}, {{rate}});
    s.stepper.advance_to(s.stepper.time() + t);
    rise = rise * decay + watts / K * (1. - decay) + rate / K * (t - tau * (1. - decay));
    input += watts * t + rate * t * t / 2.;
    EXPECT_NEAR(s.rise(), rise, accuracy * rise);
    EXPECT_NEAR(s.stepper.energy().input, input, 1e-9);
  }
}

TEST(AssembledEquations, WindowsAreOfSecondOrder) {
  auto p = problem();
  p.ports.push_back({"bore", {{0, HeatSide::inner}}, {}, 0.});
  auto a = lump();
  a.ports = {{{0}, {1.}}};
  a.port_areas = {1e-3};
  double error[2] = {};
  for (const int n : {8, 16}) {
    Stepped s(p, a);
    const double watts[] = {10.};
    s.stepper.set_port_heat(watts, {});
    for (int i = 0; i < n; ++i) s.stepper.advance_window(4. / n);
    EXPECT_NEAR(s.stepper.time(), 4., 1e-12);
    error[n == 16] = std::fabs(s.rise() - 10. / K * (1. - std::exp(-4. * K / C)));
    EXPECT_NEAR(s.stepper.energy().residual(), 0., 1e-10);
  }
  // The next term of the error is a fraction of the window over the time constant, 1/8 and 1/16: it adds 0.03.
  EXPECT_NEAR(error[0] / error[1], 4., 0.1);
}

TEST(AssembledEquations, SurroundingsThatAreWarmerWarm) {
  auto p = problem();
  p.convections.push_back({{0, HeatSide::outer}, 50., 0., T_0 + 8.});
  auto a = lump();
  a.ambient_load = {K * 8.};
  Stepped s(p, a);
  s.stepper.advance_to(5.);
  EXPECT_NEAR(s.rise(), 8. * (1. - std::exp(-5. * K / C)), accuracy * 8.);
  EXPECT_NEAR(s.stepper.energy().lost, -C * s.rise(), accuracy * 16.)
      << "what comes in by convection is a loss below zero";
}

TEST(AssembledEquations, AHeldUnknownWarmsItsNeighbourAndItsHeatIsBooked) {
  auto p = problem();
  AssembledHeat a;  // two lumps of C, K between them; the second is held
  a.row_start = {0, 2, 4};
  a.column = {0, 1, 0, 1};
  a.capacity = {C, 0., 0., C};
  a.conductance = {K, -K, -K, K};
  a.capacity_weights = {C, C};
  a.loss_weights = a.ambient_load = {0., 0.};
  a.held = {{{1}, T_0 + 10.}};
  a.body_of = {0, 0};
  a.shortest_time = 1e-3;
  Stepped s(p, a);
  EXPECT_DOUBLE_EQ(s.stepper.energy().input, C * 10.) << "the jump's heat";
  s.stepper.advance_to(3.);
  const double rise = 10. * (1. - std::exp(-3. * K / C));
  EXPECT_NEAR(s.rise(), rise, accuracy * 10.);
  EXPECT_EQ(s.stepper.temperatures()[1], T_0 + 10.);
  EXPECT_NEAR(s.stepper.energy().input, C * 10. + C * rise, accuracy * 40.);
  EXPECT_NEAR(s.stepper.energy().residual(), 0., accuracy * 40.);
}

TEST(AssembledEquations, WhatIsCooledBelowZeroIsNamedWithItsFlux) {
  auto p = problem();
  p.fluxes.push_back({{0, HeatSide::inner}, {0.}, {-1000.}});
  auto a = lump();
  a.flux_loads = {{1.}};
  a.flux_areas = {1.};
  Stepped s(p, a);
  try {
    s.stepper.advance_to(10.);
    FAIL() << "nothing was said";
  } catch (const SolverError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("body \"ring\" is cooled below 0 K"), std::string::npos) << message;
    EXPECT_NE(message.find("The flux on boundary ring.inner takes 1000 W out"), std::string::npos) << message;
  }
}

TEST(AssembledEquations, AMeanKnowsItsExtremes) {
  const HeatMean mean{{2, 0}, {0.25, 0.75}};
  const double T[] = {T_0 + 4., T_0 - 100., T_0 + 8.};
  EXPECT_DOUBLE_EQ(mean.of(T, T_0), T_0 + 5.);
  EXPECT_EQ(mean.lowest(T), T_0 + 4.);
  EXPECT_EQ(mean.highest(T), T_0 + 8.);
}

}  // namespace
}  // namespace rotordrop
