// A body cut in four, across and along, and joined again with a resistance far below that of its cells is the same body.
#include <gtest/gtest.h>

#include <cmath>

#include "fe_room.h"

namespace rotordrop {
namespace {

constexpr double none = 1e-11;  // [m2 K/W]; 1 mm of steel has 2e-5

HeatBody piece(const char* name, double x_1, double x_2, double r_1, double r_2) {
  return {name, {x_1, x_2}, {r_1, r_2}, 7800., PropertyTable(46.), PropertyTable(460.)};
}

TEST(Interfaces, WithoutResistanceMakeOneBodyOfItsPieces) {
  HeatConductionProblem whole;
  whole.bodies = {piece("whole", 0., 20e-3, 30e-3, 50e-3)};
  whole.fluxes = {{{0, HeatSide::left}, {0.}, {4e5}}, {{0, HeatSide::inner}, {0., 0.5}, {3e5, 0.}}};
  whole.convections = {{{0, HeatSide::outer}, 500., 0., 293.15}, {{0, HeatSide::right}, 900., 0., 293.15}};
  whole.numerics.cells = 20;
  whole.numerics.growth = 1.25;

  HeatConductionProblem cut = whole;
  cut.numerics.cells = 10;
  cut.bodies = {piece("a", 0., 12e-3, 30e-3, 38e-3), piece("b", 12e-3, 20e-3, 30e-3, 38e-3),
                piece("c", 0., 12e-3, 38e-3, 50e-3), piece("d", 12e-3, 20e-3, 38e-3, 50e-3)};
  cut.interfaces = {{{0, HeatSide::right}, {1, HeatSide::left}, none},
                    {{3, HeatSide::left}, {2, HeatSide::right}, none},
                    {{0, HeatSide::outer}, {2, HeatSide::inner}, none},
                    {{3, HeatSide::inner}, {1, HeatSide::outer}, none}};
  cut.fluxes = {{{0, HeatSide::left}, {0.}, {4e5}},
                {{2, HeatSide::left}, {0.}, {4e5}},
                {{0, HeatSide::inner}, {0., 0.5}, {3e5, 0.}},
                {{1, HeatSide::inner}, {0., 0.5}, {3e5, 0.}}};
  cut.convections = {{{2, HeatSide::outer}, 500., 0., 293.15},
                     {{3, HeatSide::outer}, 500., 0., 293.15},
                     {{1, HeatSide::right}, 900., 0., 293.15},
                     {{3, HeatSide::right}, 900., 0., 293.15}};

  const auto one = make_solver(whole), four = make_solver(cut);
  for (const double t : {0.1, 0.5, 3.}) {
    one->advance_to(t);
    four->advance_to(t);
    const double rise = one->temperature(0, 0., 30e-3) - 293.15;
    EXPECT_GT(rise, 10.);
    const struct {
      std::size_t body;
      double x, r;
    } points[] = {{0, 0., 30e-3},    {0, 12e-3, 38e-3}, {1, 12e-3, 38e-3}, {2, 12e-3, 38e-3},
                  {3, 12e-3, 38e-3}, {1, 20e-3, 33e-3}, {2, 5e-3, 44e-3},  {3, 16e-3, 50e-3}};
    for (const auto& p : points)
      EXPECT_NEAR(four->temperature(p.body, p.x, p.r), one->temperature(0, p.x, p.r), 1e-4 * rise)
          << p.body << " at " << p.x << ", " << p.r << ", t = " << t;
    EXPECT_NEAR(four->energy().input, one->energy().input, 1e-12 * one->energy().input);
    // Two meshes: the heat lost, by integrals over surfaces, differs by 1e-9 of the input.
    EXPECT_NEAR(four->energy().lost, one->energy().lost, 1e-8 * one->energy().input);
    EXPECT_LT(std::fabs(four->energy().residual()), 1e-10 * four->energy().input);
  }
}

}  // namespace
}  // namespace rotordrop
