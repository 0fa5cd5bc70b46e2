// Heat that arises in an interface, against closed forms.
// 1. Two half spaces without contact resistance, q in their common face from t = 0 on: both faces have one temperature, and with
//   e_i = sqrt(k_i rho_i c_i):   q_i = q e_i/(e_1 + e_2),   face rise = 2 q sqrt(t/pi)/(e_1 + e_2).
//    Within one body heat goes into half-space depth 4 sqrt(diffusivity t) and the other end knows nothing of it below 1e-7.
// 2. Two hollow cylinders, bore held at T_a and outside at T_b, q per area of their common face r = c with contact resistance R, of which the part s
//    lies on the outer one's side. Steady, per length of 2 pi c L = A:  R_1 = ln(c/a)/(2 pi k_1 L), R_2 = ln(b/c)/(2 pi k_2 L),
//   T_0 = (q A + T_a/(R_1 + (1 - s) R/A) + T_b/(R_2 + s R/A))/(1/(R_1 + (1 - s) R/A) + 1/(R_2 + s R/A)),
//    faces: T_1 = T_a + R_1 (T_0 - T_a)/(R_1 + (1 - s) R/A), and so T_2.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "fe_room.h"

namespace rotordrop {
namespace {

using std::numbers::pi;
constexpr double T_amb = 293.15;

TEST(HeatInAnInterface, DividesBetweenHalfSpacesByTheirEffusivities) {
  constexpr double q = 2e5, k_1 = 46., k_2 = 2.5, rho_c_1 = 7800. * 460., rho_c_2 = 3200. * 700., t = 0.5;
  const double e_1 = std::sqrt(k_1 * rho_c_1), e_2 = std::sqrt(k_2 * rho_c_2);
  HeatConductionProblem p;
  p.bodies = {{"steel", {0., 30e-3}, {20e-3, 25e-3}, 7800., PropertyTable(46.), PropertyTable(460.)},
              {"ceramic", {30e-3, 50e-3}, {20e-3, 25e-3}, 3200., PropertyTable(2.5), PropertyTable(700.)}};
  p.interfaces = {{{0, HeatSide::right}, {1, HeatSide::left}, 1e-11}};
  p.fluxes = {
      {.boundary = {0, HeatSide::right}, .times = {0.}, .values = {q}, .second = HeatBoundary{1, HeatSide::left}}};
  p.numerics.cells = 16;
  p.numerics.growth = 1.25;
  p.numerics.tolerance = 1e-7;
  const auto solver = make_solver(p);
  solver->advance_to(t);
  const double rise = 2. * q * std::sqrt(t / pi) / (e_1 + e_2), area = pi * (25e-3 * 25e-3 - 20e-3 * 20e-3);
  // The rise begins as a root of time: cells that grow by 1.25 and steps of 1e-7 leave 3e-6.
  for (const HeatBoundary& face : {HeatBoundary{0, HeatSide::right}, HeatBoundary{1, HeatSide::left}})
    EXPECT_NEAR(solver->mean_temperature(face) - T_amb, rise, 1e-5 * rise);
  const double into_steel = solver->body_capacity(0) * (solver->body_mean(0) - T_amb);
  // A mean over the volume is met to 2e-7.
  EXPECT_NEAR(into_steel, q * area * t * e_1 / (e_1 + e_2), 1e-6 * q * area * t);
  const HeatEnergy e = solver->energy();
  EXPECT_NEAR(e.input, q * area * t, 1e-12 * e.input);
  EXPECT_LT(std::fabs(e.residual()), 1e-9 * e.input);  // roundoff of an interface 1e6 times stiffer than the cells
}

struct Cylinders {
  static constexpr double a = 20e-3, c = 30e-3, b = 45e-3, L = 12e-3, k_1 = 46., k_2 = 15., R = 3e-4, q = 4e5,
                          T_a = 300., T_b = 340.;
  static constexpr double A = 2. * pi * c * L;
  static HeatConductionProblem problem(double s) {
    HeatConductionProblem p;
    p.bodies = {{"inner", {0., L}, {a, c}, 7800., PropertyTable(k_1), PropertyTable(460.)},
                {"outer", {0., L}, {c, b}, 7800., PropertyTable(k_2), PropertyTable(460.)}};
    p.interfaces = {{{0, HeatSide::outer}, {1, HeatSide::inner}, R}};
    p.fixed = {{{0, HeatSide::inner}, T_a}, {{1, HeatSide::outer}, T_b}};
    p.fluxes = {{.boundary = {0, HeatSide::outer},
                 .times = {0.},
                 .values = {q},
                 .second = HeatBoundary{1, HeatSide::inner},
                 .resistance_beyond = s}};
    return p;
  }
};

TEST(HeatInAnInterface, DividesBetweenCylindersByTheirResistancesAndItsPlaceInTheContact) {
  using C = Cylinders;
  const double R_1 = std::log(C::c / C::a) / (2. * pi * C::k_1 * C::L),
               R_2 = std::log(C::b / C::c) / (2. * pi * C::k_2 * C::L);
  for (const double s : {0., 0.25, 0.5, 1.}) {
    const auto solver = make_solver(C::problem(s));
    solver->advance_to(2000.);
    const double to_a = R_1 + (1. - s) * C::R / C::A, to_b = R_2 + s * C::R / C::A;
    const double T_0 = (C::q * C::A + C::T_a / to_a + C::T_b / to_b) / (1. / to_a + 1. / to_b);
    const double T_1 = C::T_a + R_1 * (T_0 - C::T_a) / to_a, T_2 = C::T_b + R_2 * (T_0 - C::T_b) / to_b;
    const double face_1 = solver->mean_temperature({0, HeatSide::outer}),
                 face_2 = solver->mean_temperature({1, HeatSide::inner});
    std::printf("  s = %.2f: faces %.6f K (%.6f), %.6f K (%.6f)\n", s, face_1, T_1, face_2, T_2);
    EXPECT_NEAR(face_1, T_1, 1e-6 * (T_0 - C::T_a)) << s;
    EXPECT_NEAR(face_2, T_2, 1e-6 * (T_0 - C::T_a)) << s;
    const HeatEnergy e = solver->energy();
    EXPECT_LT(std::fabs(e.residual()), 1e-9 * e.input) << s;
  }
}

TEST(HeatInAnInterface, EntersWhereTheSidesLieOnEachOtherAndNowhereElse) {
  HeatConductionProblem p;
  p.bodies = {{"long", {0., 40e-3}, {20e-3, 30e-3}, 7800., PropertyTable(46.), PropertyTable(460.)},
              {"short", {10e-3, 22e-3}, {30e-3, 34e-3}, 7800., PropertyTable(46.), PropertyTable(460.)}};
  p.interfaces = {{{0, HeatSide::outer}, {1, HeatSide::inner}, 1e-5}};
  p.fluxes = {{.boundary = {1, HeatSide::inner},
               .times = {0., 0.2},
               .values = {1e6, 0.},
               .second = HeatBoundary{0, HeatSide::outer}},
              {.boundary = {0, HeatSide::outer}, .times = {0.}, .values = {1e4}}};
  const auto solver = make_solver(p);
  solver->advance_to(0.5);
  const double covered = 2. * pi * 30e-3 * 12e-3, free = 2. * pi * 30e-3 * 28e-3;
  const HeatEnergy e = solver->energy();
  EXPECT_NEAR(e.input, covered * 1e6 * 0.2 + free * 1e4 * 0.5, 1e-12 * e.input);
  EXPECT_LT(std::fabs(e.residual()), 1e-10 * e.input);
}

}  // namespace
}  // namespace rotordrop
