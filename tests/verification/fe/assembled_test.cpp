// A problem as plain matrices, stepped with Eigen's factors, gives what deal.II's operator and CHOLMOD give: roundoff apart.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "conduction/assembled_equations.h"
#include "conduction/heat_stepper.h"
#include "fe_room.h"

namespace rotordrop {
namespace {

/// Everything that a linear problem can have.
HeatConductionProblem ring_in_housing() {
  HeatConductionProblem p;
  p.bodies = {{"ring", {0., 20e-3}, {35e-3, 40e-3}, 7800., PropertyTable(46.), PropertyTable(460.)},
              {"housing", {-5e-3, 25e-3}, {40e-3, 60e-3}, 7100., PropertyTable(40.), PropertyTable(500.)}};
  p.interfaces = {{{0, HeatSide::outer}, {1, HeatSide::inner}, 1e-4}};
  p.fluxes = {{{0, HeatSide::left}, {0., 2e-3}, {1e6, -2e5}},
              {{0, HeatSide::outer}, {1e-3}, {3e5}, {}, HeatBoundary{1, HeatSide::inner}, 0.3}};
  p.convections = {{{1, HeatSide::outer}, 200., 0., 280.}};
  p.fixed = {{{1, HeatSide::left}, 300.}};
  p.nodes = {{"balls", 5.}};
  p.ports = {{"bore", {{0, HeatSide::inner}}, {}, 1.}, {"balls", {}, 0, 1.}};
  p.links = {{0, 1, 2.}, {1, {}, 5.}};
  p.numerics.cells = 3;
  p.numerics.grading = 8.;
  return p;
}

class Assembled : public testing::Test {
 protected:
  void expect_the_same() const {
    const auto x = real_->field();
    const auto y = own_.field();
    ASSERT_EQ(x.size(), y.size());
    double largest = 0., difference = 0.;
    for (std::size_t i = 0; i < x.size(); ++i) {
      largest = std::max(largest, std::fabs(x[i] - problem_.initial_temperature));
      difference = std::max(difference, std::fabs(x[i] - y[i]));
    }
    EXPECT_GT(largest, 1.);
    EXPECT_LT(difference, 1e-10 * largest);
    const HeatEnergy a = real_->energy(), b = own_.energy();
    EXPECT_NEAR(a.input, b.input, 1e-10 * std::fabs(a.input));
    EXPECT_NEAR(a.stored, b.stored, 1e-10 * std::fabs(a.input));
    EXPECT_NEAR(a.lost, b.lost, 1e-10 * std::fabs(a.input));
    EXPECT_LT(std::fabs(b.residual()), 1e-9 * b.input);
    const std::vector<HeatBoundary> seam = {{0, HeatSide::outer}};
    EXPECT_EQ(real_->temperature(1, 3e-3, 47e-3), real_->mean_at(1, 3e-3, 47e-3).of(x, problem_.initial_temperature));
    EXPECT_EQ(real_->surface(seam).mean, real_->mean_over(seam).of(x, problem_.initial_temperature));
    EXPECT_EQ(real_->body_mean(1), heat_.bodies[1].of(x, problem_.initial_temperature));
    EXPECT_EQ(real_->port_temperature(0), heat_.ports[0].of(x, problem_.initial_temperature));
    const double capacity = std::accumulate(heat_.capacity_weights.begin(), heat_.capacity_weights.end(), 0.);
    EXPECT_NEAR(real_->body_capacity(0) + real_->body_capacity(1) + problem_.nodes[0].capacity, capacity,
                1e-12 * capacity);
    EXPECT_EQ(real_->port_area(0), heat_.port_areas[0]);
    EXPECT_EQ(real_->statistics().steps, own_.statistics().steps);
    EXPECT_EQ(real_->statistics().factorisations, own_.statistics().factorisations);
  }
  const HeatConductionProblem problem_ = ring_in_housing();
  const std::unique_ptr<HeatConductionSolver> real_ = make_solver(problem_);
  const AssembledHeat heat_ = real_->assembled().value();
  AssembledEquations equations_{problem_, heat_};
  HeatStepper own_{equations_, problem_};
};

TEST_F(Assembled, StepsWithControlOfTheError) {
  for (const double t : {1e-3, 5e-3, 0.1}) {
    real_->advance_to(t);
    own_.advance_to(t);
    expect_the_same();
  }
  const double watts[] = {900., 4.}, rates[] = {-3000., 0.};
  real_->set_port_heat(watts, rates);
  own_.set_port_heat(watts, rates);
  real_->advance_to(0.2);
  own_.advance_to(0.2);
  expect_the_same();
}

TEST_F(Assembled, StepsInWindows) {
  const double watts[] = {900., 4.};
  real_->set_port_heat(watts);
  own_.set_port_heat(watts, {});
  for (const double step : {1e-3, 5e-4, 1e-3}) {
    real_->advance_window(step);
    own_.advance_window(step);
  }
  expect_the_same();
}

TEST(AssembledOnly, OfLinearSectionsThatAreSteppedDirectlyAndAreNotLarge) {
  auto p = ring_in_housing();
  EXPECT_TRUE(make_solver(p)->assembled());
  p.numerics.cells = 70;
  p.numerics.grading = 1.;
  EXPECT_GT(make_solver(p)->statistics().unknowns, 25000U);
  EXPECT_FALSE(make_solver(p)->assembled());
  p = ring_in_housing();
  p.bodies[0].conductivity = PropertyTable({{293., 46.}, {600., 36.}});
  EXPECT_FALSE(make_solver(p)->assembled());
  p = ring_in_housing();
  p.convections[0].exponent = 0.25;
  EXPECT_FALSE(make_solver(p)->assembled());
}

}  // namespace
}  // namespace rotordrop
