// A strip of width W that bends by a right angle, put together of two rings so large that they are nearly plane: one side of the long one is covered by
// the other ring's foot over W only, and the interface ends there, at the bend's inner corner, where the flux goes as distance^(-1/3).
// By conformal mapping (Hall 1967, Thin Solid Films 1, 277) the bend's square conducts as 1 - (2/pi) ln 2 squares of a straight strip, if the arms are
// long: at 5 W what is left of the bend has decayed by exp(-5 pi) = 1.5e-7. The arm along r is a hollow cylinder. Curvature changes the square by some
// W/R_0 = 1e-3 of itself, outwards as much as inwards with the other sign: the mean of both is left with its square.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "fe_room.h"

namespace rotordrop {
namespace {

using std::numbers::pi;
constexpr double W = 10e-3, R_0 = 1e3 * W, k = 50., T_0 = 293.15, q = 1e5;
const double square = 1. - 2. / pi * std::log(2.);

struct Bend {
  double error;  ///< of the square's resistance, over itself
  std::size_t unknowns;
};
/// @param side  1: the foot stands outwards, -1: inwards
Bend bend(int cells, double end_grading, int side) {
  HeatConductionProblem p;
  const HeatSide towards = side > 0 ? HeatSide::outer : HeatSide::inner,
                 away = side > 0 ? HeatSide::inner : HeatSide::outer;
  const double from = side > 0 ? R_0 + W : R_0 - 5. * W, to = from + 5. * W;
  p.bodies = {{"long", {0., 6. * W}, {R_0, R_0 + W}, 1., PropertyTable(k), PropertyTable(1.)},
              {"foot", {0., W}, {from, to}, 1., PropertyTable(k), PropertyTable(1.)}};
  p.interfaces = {{{0, towards}, {1, away}, 1e-8 * W / k}};
  p.fluxes = {{.boundary = {0, HeatSide::right}, .times = {0.}, .values = {q}}};
  p.fixed = {{{1, towards}, T_0}};
  p.numerics = {.cells = cells, .grading = 1., .end_grading = end_grading, .fixed_step = 1e9};
  const auto solver = make_solver(p);
  solver->advance_to(4e9);  // steady: nothing in it is slower than a second
  // Rise of the heated end over that of a square, less the arms.
  const double arms = 5. + (R_0 + 0.5 * W) / W * std::log(to / from);
  const double squares = (solver->mean_temperature({0, HeatSide::right}) - T_0) * k / (q * W);
  return {(squares - arms - square) / square, solver->statistics().unknowns};
}
Bend bend(int cells, double end_grading) {
  const Bend out = bend(cells, end_grading, 1), in = bend(cells, end_grading, -1);
  return {0.5 * (out.error + in.error), out.unknowns};
}

TEST(EndOfAnInterface, IsResolvedByCellsThatGetThinTowardsIt) {
  std::printf("  cells  end_grading  unknowns  error of the bend's resistance\n");
  const auto show = [](int cells, double grading) {
    const Bend b = bend(cells, grading);
    std::printf("  %5d  %11.0f  %8zu  %9.1e\n", cells, grading, b.unknowns, b.error);
    return b;
  };
  const Bend coarse = show(8, 1.), even = show(12, 1.), fine = show(24, 1.);
  const Bend graded = show(4, 30.), more = show(8, 300.);
  EXPECT_GT(std::fabs(coarse.error), 1e-3);
  EXPECT_GT(std::fabs(fine.error), 5e-4);
  // Even cells: order 4/3, that of the corner's r^(2/3) in energy, whatever the elements' degree.
  EXPECT_NEAR(std::log2(even.error / fine.error), 4. / 3., 0.3);
  // With fewer unknowns 10 and 50 times better.
  EXPECT_LT(graded.unknowns, even.unknowns);
  EXPECT_LT(std::fabs(graded.error), 0.1 * std::fabs(even.error));
  EXPECT_LT(more.unknowns, fine.unknowns);
  EXPECT_LT(std::fabs(more.error), 0.02 * std::fabs(fine.error));
}

}  // namespace
}  // namespace rotordrop
