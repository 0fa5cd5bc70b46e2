// Hollow cylinder a < r < b, insulated at its ends, at T_0 until its bore is held at T_0 + Delta from t = 0 on; its outside stays held at T_0.
//   steady:    theta_s = Delta ln(b/r)/ln(b/a),   heat flow 2 pi k L Delta/ln(b/a)
//   transient: theta = theta_s - sum_n C_n R_n(r) exp(-D beta_n^2 t),   R_n = J0(beta r) Y0(beta a) - Y0(beta r) J0(beta a),
// R_n vanishes at a, and beta_n are the roots of R_n(b) = 0. C_n = integral(r theta_s R_n)/integral(r R_n^2), where Green's identity
// (theta_s is harmonic) and the standard integral of Bessel functions give
//   integral(r theta_s R_n) = a Delta R_n'(a)/beta^2,   R_n'(a) = -2/(pi a),
//   integral(r R_n^2) = (b^2 R_n'(b)^2 - a^2 R_n'(a)^2)/(2 beta^2).
#include <gtest/gtest.h>

#include <boost/math/special_functions/bessel.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/errors.h"
#include "fe_room.h"

namespace rotordrop {
namespace {

using boost::math::cyl_bessel_j;
using boost::math::cyl_neumann;
using std::numbers::pi;

struct Cylinder {
  double a = 35e-3, b = 50e-3, length = 15e-3, k = 46., rho = 7800., c = 460., start = 293.15, jump = 80.;
  [[nodiscard]] double time(double fourier) const { return fourier * (b - a) * (b - a) * rho * c / k; }
  [[nodiscard]] double steady(double r) const { return jump * std::log(b / r) / std::log(b / a); }
  [[nodiscard]] double steady_flow() const { return 2. * pi * k * length * jump / std::log(b / a); }
  [[nodiscard]] double rise(double r, double t) const {
    const auto R = [&](double beta, double at) {
      return cyl_bessel_j(0, beta * at) * cyl_neumann(0, beta * a) -
             cyl_neumann(0, beta * at) * cyl_bessel_j(0, beta * a);
    };
    double theta = steady(r);
    const double step = pi / (b - a) / 40.;
    int n = 0;
    for (double low = 0.5 * step; n < 120; low += step) {
      double x = low, y = low + step;
      if (R(x, b) * R(y, b) > 0.) continue;
      for (int i = 0; i < 100; ++i) (R(x, b) * R(0.5 * (x + y), b) > 0. ? x : y) = 0.5 * (x + y);
      const double beta = x, at_a = -2. / (pi * a);
      const double at_b = -beta * (cyl_bessel_j(1, beta * b) * cyl_neumann(0, beta * a) -
                                   cyl_neumann(1, beta * b) * cyl_bessel_j(0, beta * a));
      const double norm = 0.5 * (b * b * at_b * at_b - a * a * at_a * at_a);
      theta -= a * jump * at_a / norm * R(beta, r) * std::exp(-k / (rho * c) * beta * beta * t);
      ++n;
    }
    return theta;
  }
  [[nodiscard]] HeatConductionProblem problem() const {
    HeatConductionProblem p;
    p.bodies = {{"ring", {0., length}, {a, b}, rho, PropertyTable(k), PropertyTable(c)}};
    p.fixed = {{{0, HeatSide::inner}, start + jump}, {{0, HeatSide::outer}, start}};
    p.initial_temperature = start;
    p.numerics.cells = 16;
    p.numerics.growth = 1.25;
    return p;
  }
};

TEST(FixedTemperature, LeavesALogarithmicProfileAndItsHeatFlowInAHollowCylinder) {
  const Cylinder c;
  auto p = c.problem();
  p.numerics.degree = 4;
  const auto solver = make_solver(p);
  solver->advance_to(c.time(20.));
  // 16 elements of fourth degree leave 2e-10 of ln r, and less of its flow.
  for (const double r : {c.a, 36e-3, 40e-3, 43.7e-3, 49e-3, c.b})
    EXPECT_NEAR(solver->temperature(0, 4e-3, r) - c.start, c.steady(r), 1e-9 * c.jump) << "r = " << r;
  const HeatEnergy before = solver->energy();
  const double duration = c.time(1.);
  solver->advance_to(c.time(20.) + duration);
  const HeatEnergy after = solver->energy();
  EXPECT_NEAR((after.input - before.input) / duration, c.steady_flow(), 1e-9 * c.steady_flow());
  EXPECT_NEAR((after.lost - before.lost) / duration, c.steady_flow(), 1e-9 * c.steady_flow());
}

// Between Fourier 0 and 0.003 the layer is thinner than what these cells resolve to 1e-5.
TEST(FixedTemperature, SendsAStepThroughAHollowCylinderAsTheEigenfunctionSeriesSays) {
  const Cylinder c;
  auto p = c.problem();
  p.numerics.degree = 3;
  const auto solver = make_solver(p);
  std::printf("  Fourier   error/jump at quarter, half, three quarters    residual/input\n");
  for (const double fourier : {0.003, 0.01, 0.03, 0.1, 0.3, 1., 10.}) {
    const double t = c.time(fourier);
    solver->advance_to(t);
    std::printf("  %7.3f ", fourier);
    for (const double part : {0.25, 0.5, 0.75}) {
      const double r = c.a + part * (c.b - c.a);
      const double error = (solver->temperature(0, 7e-3, r) - c.start - c.rise(r, t)) / c.jump;
      std::printf("  %9.1e", error);
      EXPECT_LT(std::fabs(error), 1e-5) << "at r = " << r << ", Fourier " << fourier;
    }
    const HeatEnergy e = solver->energy();
    std::printf("  %9.1e\n", e.residual() / e.input);
    EXPECT_LT(std::fabs(e.residual()), 1e-10 * e.input);
    EXPECT_NEAR(solver->temperature(0, 0., c.a), c.start + c.jump, 1e-10);
  }
}

// Warm inside, cold inside: what comes in and what is lost change places.
TEST(FixedTemperature, BooksHeatAsInputOrLossByItsDirection) {
  Cylinder c;
  const auto warm = make_solver(c.problem());
  c.jump = -c.jump;
  const auto cold = make_solver(c.problem());
  for (const auto* solver : {&warm, &cold}) (*solver)->advance_to(c.time(0.1));
  EXPECT_GT(warm->energy().input, 2. * warm->energy().lost);
  EXPECT_NEAR(cold->energy().lost, warm->energy().input, 1e-9 * warm->energy().input);
  EXPECT_NEAR(cold->energy().input, warm->energy().lost, 1e-9 * warm->energy().input);
  EXPECT_NEAR(cold->energy().stored, -warm->energy().stored, 1e-9 * warm->energy().input);
}

TEST(FixedTemperature, ClosesEnergyBesideFluxConvectionTablesAndAnInterface) {
  HeatConductionProblem p;
  const PropertyTable k({{293., 46.}, {400., 43.}, {600., 38.}}),
      heat_capacity({{293., 460.}, {330., 480.}, {600., 560.}});
  p.bodies = {{"ring", {0., 20e-3}, {35e-3, 40e-3}, 7800., k, heat_capacity},
              {"housing", {-5e-3, 25e-3}, {40e-3, 60e-3}, 7100., PropertyTable(40.), PropertyTable(500.)}};
  p.interfaces = {{{0, HeatSide::outer}, {1, HeatSide::inner}, 1e-4}};
  p.fluxes = {{{0, HeatSide::inner}, {0., 2e-3}, {3e7, 1e5}}};
  // They share corners with the flux, with each other and with the convection; the housing's bore is half covered.
  p.fixed = {{{0, HeatSide::left}, 350.}, {{1, HeatSide::inner}, 280.}, {{1, HeatSide::left}, 310.}};
  p.convections = {{{1, HeatSide::outer}, 23., 0.25, 293.15}, {{0, HeatSide::right}, 300., 0., 290.}};
  const auto solver = make_solver(p);
  for (const double t : {1e-3, 2e-3, 0.3, 20.}) {
    solver->advance_to(t);
    const HeatEnergy e = solver->energy();
    EXPECT_LT(std::fabs(e.residual()), 1e-10 * e.input) << "t = " << t;
  }
  EXPECT_EQ(solver->temperature(0, 0., 37e-3), 350.);
  EXPECT_EQ(solver->temperature(1, -5e-3, 40e-3), 280.) << "the first one counts at a corner";
}

TEST(FixedTemperature, CannotBeReduced) {
  const auto solver = make_solver(Cylinder().problem());
  EXPECT_THROW(static_cast<void>(solver->reduce({})), SolverError);
}

// Kirchhoff: with k = k_0 + slope (T - T_0), k_0 theta + slope theta^2/2 is what the profile of constant k is scaled to. A conductivity that grows a
// hundredfold from the outside to the bore: matrices without its slope do not bring Newton's iteration to its end.
TEST(FixedTemperature, LeavesTheProfileOfASteepConductivity) {
  const Cylinder c;
  const double k_0 = 10., k_1 = 1000., slope = (k_1 - k_0) / c.jump;
  const auto rise = [&](double r) {
    const double integral = (k_0 + 0.5 * slope * c.jump) * c.steady(r);
    return (std::sqrt(k_0 * k_0 + 2. * slope * integral) - k_0) / slope;
  };
  auto p = c.problem();
  p.bodies[0].conductivity = PropertyTable({{c.start, k_0}, {c.start + c.jump, k_1}});
  p.numerics.degree = 4;
  p.numerics.cells = 3;
  for (const auto kind : {HeatLinearSolver::direct, HeatLinearSolver::multigrid}) {
    p.numerics.solver = kind;
    const auto solver = make_solver(p);
    for (int i = 0; i < 12; ++i) solver->advance_window(c.time(4.));
    // The mesh's error, largest where k is small.
    for (const double r : {36e-3, 40e-3, 43.7e-3, 49e-3})
      EXPECT_NEAR(solver->temperature(0, 4e-3, r) - c.start, rise(r), 1e-4 * c.jump) << "r = " << r;
    const HeatEnergy e = solver->energy();
    EXPECT_LT(std::fabs(e.residual()), 1e-9 * e.input);
  }
}

}  // namespace
}  // namespace rotordrop
