// Multigrid and factorisation solve the same equations: what they leave of the right side is 1e-12 of it (multigrid) or roundoff.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "fe_room.h"
#include "thermal/fe/solvers/linear_solver.h"

namespace rotordrop {
namespace {

HeatConductionProblem ring_in_housing(int cells) {
  HeatConductionProblem p;
  p.bodies = {{"ring", {0., 20e-3}, {35e-3, 40e-3}, 7800., PropertyTable(46.), PropertyTable(460.)},
              {"housing", {-5e-3, 25e-3}, {40e-3, 60e-3}, 7100., PropertyTable(40.), PropertyTable(500.)}};
  p.interfaces = {{{0, HeatSide::outer}, {1, HeatSide::inner}, 1e-4}};
  p.fluxes = {{{0, HeatSide::inner}, {0.}, {1e6}}};
  p.convections = {{{1, HeatSide::outer}, 200., 0., 293.15}};
  p.fixed = {{{1, HeatSide::left}, 300.}};
  p.numerics.cells = cells;
  p.numerics.grading = 8.;
  p.numerics.fixed_step = 0.01;
  return p;
}

void expect_the_same(const HeatConductionProblem& direct, double end) {
  auto multigrid = direct;
  multigrid.numerics.solver = HeatLinearSolver::multigrid;
  const auto a = make_solver(direct), b = make_solver(multigrid);
  a->advance_to(end);
  b->advance_to(end);
  EXPECT_EQ(a->statistics().unknowns, b->statistics().unknowns);
  std::printf("  %zu unknowns\n", a->statistics().unknowns);
  const auto x = a->field(), y = b->field();
  double largest = 0., difference = 0.;
  for (std::size_t i = 0; i < x.size(); ++i) {
    largest = std::max(largest, std::fabs(x[i] - direct.initial_temperature));
    difference = std::max(difference, std::fabs(x[i] - y[i]));
  }
  EXPECT_GT(largest, 1.);
  // The residual's 1e-12 times what solving may magnify: the ratio of the largest to the smallest cell.
  EXPECT_LT(difference, 1e-9 * largest);
  for (const auto* solver : {&a, &b}) {
    const HeatEnergy e = (*solver)->energy();
    EXPECT_LT(std::fabs(e.residual()), 1e-10 * e.input);
  }
}

TEST(LinearSolvers, MultigridGivesWhatFactorisationGivesOnALargeSection) {
  const auto problem = ring_in_housing(45);
  expect_the_same(problem, 0.01);
  EXPECT_GT(make_solver(problem)->statistics().unknowns, 20000U);
}

TEST(LinearSolvers, AutomaticFactorisesAsLongAsTheFactorsFitIntoHalfOfTheMemory) {
  using enum HeatLinearSolver;
  // 150 bytes times n log2 n, as measured: 3 GB for a million unknowns.
  EXPECT_EQ(chosen_solver(automatic, 1'000'000, 8e9), direct);
  EXPECT_EQ(chosen_solver(automatic, 1'000'000, 4e9), multigrid);
  EXPECT_EQ(chosen_solver(automatic, 2'000, 1e8), direct);
  for (const auto asked : {direct, multigrid}) EXPECT_EQ(chosen_solver(asked, 1'000'000, 1e6), asked);
}

// By matrices without the slope of the conductivity, which are symmetric; where it is steep, fixed_temperature_test.cpp has LU and GMRES.
TEST(LinearSolvers, AgreeWhereConductivityDependsOnTemperature) {
  auto problem = ring_in_housing(6);
  problem.bodies[0].conductivity = PropertyTable({{293., 46.}, {320., 44.}, {600., 36.}});
  problem.numerics.fixed_step = 0.002;
  expect_the_same(problem, 0.01);
}

TEST(LinearSolvers, AgreeInWindows) {
  auto problem = ring_in_housing(6);
  problem.ports = {{"bore", {{0, HeatSide::inner}}, {}, 1.}};
  problem.fluxes.clear();
  auto multigrid = problem;
  multigrid.numerics.solver = HeatLinearSolver::multigrid;
  const auto a = make_solver(problem), b = make_solver(multigrid);
  for (const auto* solver : {&a, &b}) {
    const double watts[] = {3000.};
    (*solver)->set_port_heat(watts);
    for (const double step : {1e-3, 5e-4, 1e-3}) (*solver)->advance_window(step);
    EXPECT_LT(std::fabs((*solver)->energy().residual()), 1e-10 * (*solver)->energy().input);
  }
  EXPECT_GT(a->port_temperature(0), 294.);
  // as in expect_the_same(): 1e-9 of the rise of 3 K
  EXPECT_NEAR(a->port_temperature(0), b->port_temperature(0), 3e-9);
}

}  // namespace
}  // namespace rotordrop
