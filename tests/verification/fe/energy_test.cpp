// First law for a whole section: what the fluxes bring is stored or lost. Input from areas and times; stored by quadrature of the enthalpy of the final
// field; lost by quadrature of the convection law over each step's stages, with the weights that step the temperatures.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "fe_room.h"

namespace rotordrop {
namespace {

HeatConductionProblem ring_in_housing() {
  HeatConductionProblem p;
  const PropertyTable k({{293., 46.}, {400., 43.}, {600., 38.}}), c({{293., 460.}, {330., 480.}, {600., 560.}});
  p.bodies = {{"ring", {0., 20e-3}, {35e-3, 40e-3}, 7800., k, c},
              {"housing", {-5e-3, 25e-3}, {40e-3, 60e-3}, 7100., PropertyTable(40.), PropertyTable(500.)}};
  p.interfaces = {{{0, HeatSide::outer}, {1, HeatSide::inner}, 1e-4}};
  p.fluxes = {{{0, HeatSide::inner}, {0., 2e-3, 10e-3, 11e-3}, {3e7, 0., 5e7, 2e5}},
              {{0, HeatSide::left}, {5e-3}, {1e5}}};
  p.convections = {{{1, HeatSide::outer}, 23., 0.25, 293.15},
                   {{1, HeatSide::inner}, 40., 0., 293.15},
                   {{0, HeatSide::right}, 300., 1., 293.15}};
  return p;
}

TEST(HeatEnergy, ClosesWithTablesPowerLawsAndPulses) {
  const auto solver = make_solver(ring_in_housing());
  for (const double t : {1e-3, 2e-3, 12e-3, 0.3, 20.}) {
    solver->advance_to(t);
    const HeatEnergy e = solver->energy();
    std::printf("  t = %6.3f s: input %12.6f J, stored %12.6f J, lost %12.8f J, residual/input %8.1e\n", t, e.input,
                e.stored, e.lost, e.residual() / e.input);
    EXPECT_LT(std::fabs(e.residual()), 1e-10 * e.input);
  }
  // By hand: bore 2 pi 35 mm 20 mm, left face pi (40^2 - 35^2) mm^2.
  const double bore = 2. * std::numbers::pi * 35e-3 * 20e-3, left = std::numbers::pi * (40e-3 * 40e-3 - 35e-3 * 35e-3);
  const double expected = bore * (3e7 * 2e-3 + 5e7 * 1e-3 + 2e5 * (20. - 11e-3)) + left * 1e5 * (20. - 5e-3);
  EXPECT_NEAR(solver->energy().input, expected, 1e-11 * expected);
  EXPECT_GT(solver->energy().lost, 0.);
  const auto s = solver->statistics();
  std::printf("  %zu unknowns, %ld steps (%ld rejected), %ld factorisations, %ld solves\n", s.unknowns, s.steps,
              s.rejected_steps, s.factorisations, s.solves);
}

TEST(HeatEnergy, FluxAndConvectionSpareWhatAnInterfaceCovers) {
  auto p = ring_in_housing();
  p.fluxes = {{{1, HeatSide::inner}, {0.}, {1e4}}};
  const auto solver = make_solver(p);
  solver->advance_to(0.1);
  // 10 mm of the housing's 30 mm wide bore stand free.
  EXPECT_NEAR(solver->energy().input, 2. * std::numbers::pi * 40e-3 * 10e-3 * 1e4 * 0.1, 1e-10);
  EXPECT_LT(std::fabs(solver->energy().residual()), 1e-10 * solver->energy().input);
}

TEST(HeatEnergy, SurvivesTimesThatDifferByRoundoff) {
  auto p = ring_in_housing();
  p.fluxes = {{{0, HeatSide::inner}, {0., 0.1 + 0.2}, {1e5, 0.}}};
  const auto solver = make_solver(p);
  for (const double t : {0.3, 0.1 + 0.2, 0.4}) {
    solver->advance_to(t);
    EXPECT_EQ(solver->time(), t);
    EXPECT_LT(std::fabs(solver->energy().residual()), 1e-10 * solver->energy().input);
  }
  EXPECT_NEAR(solver->energy().input, 2. * std::numbers::pi * 35e-3 * 20e-3 * 1e5 * 0.3, 1e-9);
}

TEST(HeatOfABody, ReachesAmbientByConvectionAlone) {
  HeatConductionProblem p;
  p.bodies = {{"disc", {0., 10e-3}, {0., 20e-3}, 7800., PropertyTable(46.), PropertyTable(460.)}};
  p.initial_temperature = 400.;
  p.convections = {{{0, HeatSide::outer}, 1e5, 0., 293.15}};
  const auto solver = make_solver(p);
  solver->advance_to(1000.);
  // Errors of steps die out with the rise of 107 K: 1.5e-8 K are left, and less of the mean.
  EXPECT_NEAR(solver->temperature(0, 5e-3, 0.), 293.15, 1e-7);
  const HeatEnergy e = solver->energy();
  const double all = 7800. * 460. * std::numbers::pi * 20e-3 * 20e-3 * 10e-3 * (400. - 293.15);
  EXPECT_NEAR(e.stored, -all, 1e-9 * all);
  EXPECT_LT(std::fabs(e.residual()), 1e-10 * all);
}

// Insulated: whatever a port brings stays, so the mean rises by joules over capacity, here (3 kW + 40 kW/s t) over t.
TEST(HeatOfAPort, GrowsLinearlyBetweenWhatItIsTold) {
  HeatConductionProblem p;
  p.bodies = {{"disc", {0., 10e-3}, {10e-3, 20e-3}, 7800., PropertyTable(46.), PropertyTable(460.)}};
  p.ports = {{"bore", {{0, HeatSide::inner}}}};
  const auto solver = make_solver(p);
  const double C = 7800. * 460. * std::numbers::pi * (20e-3 * 20e-3 - 10e-3 * 10e-3) * 10e-3;
  const double watts = 3e3, rate = 4e4;
  solver->set_port_heat({&watts, 1}, {&rate, 1});
  for (const double t : {0.01, 0.05}) {
    solver->advance_to(t);
    const double joules = watts * t + 0.5 * rate * t * t;
    EXPECT_NEAR(solver->energy().input, joules, 1e-11 * joules);
    EXPECT_NEAR(solver->body_mean(0) - p.initial_temperature, joules / C, 1e-9 * joules / C);
  }
  // From here on as much as flows now.
  const double now = watts + rate * 0.05, before = solver->energy().input;
  solver->set_port_heat({&now, 1});
  solver->advance_to(0.06);
  EXPECT_NEAR(solver->energy().input - before, now * 0.01, 1e-11 * before);
}

}  // namespace
}  // namespace rotordrop
