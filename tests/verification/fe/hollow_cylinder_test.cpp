// Hollow cylinder a < r < b, insulated at its ends, at ambient temperature until a constant flux q enters the bore; convection h outside.
// With the rise theta over ambient, diffusivity D and Biot number through h/k:
//   steady:    theta_s = (q a/k) (ln(b/r) + k/(h b))
//   transient: theta = theta_s - sum_n C_n R_n(r) exp(-D beta_n^2 t),   R_n = J0(beta r) Y1(beta a) - Y0(beta r) J1(beta a),
// R_n' = 0 at a, and beta_n are the roots of k R_n'(b) + h R_n(b) = 0. C_n = integral(r theta_s R_n)/integral(r R_n^2), where Green's
// identity (theta_s is harmonic and meets the same condition at b) and the standard integral of Bessel functions give
//   integral(r theta_s R_n) = a q R_n(a)/(k beta^2),   R_n(a) = -2/(pi beta a),
//   integral(r R_n^2) = b^2/2 R_n(b)^2 (1 + (h/(k beta))^2) - a^2/2 R_n(a)^2.
#include <gtest/gtest.h>

#include <boost/math/special_functions/bessel.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "fe_room.h"

namespace rotordrop {
namespace {

using boost::math::cyl_bessel_j;
using boost::math::cyl_neumann;
using std::numbers::pi;

struct Cylinder {
  double a = 35e-3, b = 50e-3, k = 46., rho = 7800., c = 460., q = 1e6, h = 2000.;
  [[nodiscard]] double diffusivity() const { return k / (rho * c); }
  [[nodiscard]] double time(double fourier) const { return fourier * (b - a) * (b - a) / diffusivity(); }

  [[nodiscard]] double R(double beta, double r) const {
    return cyl_bessel_j(0, beta * r) * cyl_neumann(1, beta * a) - cyl_neumann(0, beta * r) * cyl_bessel_j(1, beta * a);
  }
  [[nodiscard]] double dR(double beta, double r) const {
    return -beta * (cyl_bessel_j(1, beta * r) * cyl_neumann(1, beta * a) -
                    cyl_neumann(1, beta * r) * cyl_bessel_j(1, beta * a));
  }
  [[nodiscard]] std::vector<double> roots(std::size_t n) const {
    const auto f = [&](double beta) { return k * dR(beta, b) + h * R(beta, b); };
    std::vector<double> found;
    const double step = pi / (b - a) / 40.;
    for (double low = 1e-3 * step; found.size() < n; low += step) {
      double x = low, y = low + step;
      if (f(x) * f(y) > 0.) continue;
      for (int i = 0; i < 100; ++i) (f(x) * f(0.5 * (x + y)) > 0. ? x : y) = 0.5 * (x + y);
      found.push_back(0.5 * (x + y));
    }
    return found;
  }
  [[nodiscard]] double rise(double r, double t, const std::vector<double>& betas) const {
    double theta = q * a / k * (std::log(b / r) + k / (h * b));
    for (const double beta : betas) {
      const double R_a = -2. / (pi * beta * a), R_b = R(beta, b);
      const double norm = 0.5 * b * b * R_b * R_b * (1. + std::pow(h / (k * beta), 2)) - 0.5 * a * a * R_a * R_a;
      theta -= a * q * R_a / (k * beta * beta) / norm * R(beta, r) * std::exp(-diffusivity() * beta * beta * t);
    }
    return theta;
  }
};

HeatConductionProblem problem_of(const Cylinder& c) {
  HeatConductionProblem p;
  p.bodies = {{"ring", {0., 15e-3}, {c.a, c.b}, c.rho, PropertyTable(c.k), PropertyTable(c.c)}};
  p.fluxes = {{{0, HeatSide::inner}, {0.}, {c.q}}};
  p.convections = {{{0, HeatSide::outer}, c.h, 0., 293.15}};
  p.numerics.cells = 24;
  p.numerics.growth = 1.25;
  return p;
}

TEST(HollowCylinder, FollowsTheEigenfunctionSeriesTo1e5OfTheBoresRise) {
  const Cylinder c;
  const auto betas = c.roots(60);
  const auto solver = make_solver(problem_of(c));
  std::printf("  Fourier   bore rise [K]   error/bore rise: bore      middle     outside\n");
  for (const double fourier : {0.01, 0.03, 0.1, 0.3, 1., 3., 30.}) {
    const double t = c.time(fourier);
    solver->advance_to(t);
    EXPECT_EQ(solver->time(), t);
    const double bore = c.rise(c.a, t, betas);
    std::printf("  %6.2f   %12.6f              ", fourier, bore);
    for (const double r : {c.a, 0.5 * (c.a + c.b), c.b}) {
      const double error = (solver->temperature(0, 3e-3, r) - 293.15 - c.rise(r, t, betas)) / bore;
      std::printf("  %9.1e", error);
      EXPECT_LT(std::fabs(error), 1e-5) << "at r = " << r << ", Fourier " << fourier;
    }
    std::printf("\n");
    EXPECT_NEAR(solver->mean_temperature({0, HeatSide::inner}), solver->temperature(0, 0., c.a), 1e-9 * bore);
    const HeatEnergy e = solver->energy();
    EXPECT_NEAR(e.input, c.q * 2. * pi * c.a * 15e-3 * t, 1e-12 * e.input);
    EXPECT_LT(std::fabs(e.residual()), 1e-10 * e.input);
  }
  const auto s = solver->statistics();
  std::printf("  %zu unknowns, %ld steps (%ld rejected), %ld factorisations\n", s.unknowns, s.steps, s.rejected_steps,
              s.factorisations);
}

// The same after a pulse: superposition of the flux and, from its end on, of its negative.
TEST(HollowCylinder, ForgetsAPulseAsTheSeriesDoes) {
  const Cylinder c;
  const auto betas = c.roots(60);
  auto problem = problem_of(c);
  const double end = c.time(0.05);
  problem.fluxes = {{{0, HeatSide::inner}, {0., end}, {c.q, 0.}}};
  const auto solver = make_solver(problem);
  for (const double fourier : {0.05, 0.06, 0.1, 1.}) {
    const double t = c.time(fourier);
    solver->advance_to(t);
    for (const double r : {c.a, 0.5 * (c.a + c.b), c.b}) {
      const double later = t > end ? c.rise(r, t - end, betas) : 0.;
      EXPECT_NEAR(solver->temperature(0, 3e-3, r) - 293.15, c.rise(r, t, betas) - later, 1e-5 * c.rise(c.a, end, betas))
          << "Fourier " << fourier;
    }
  }
  EXPECT_LT(std::fabs(solver->energy().residual()), 1e-10 * solver->energy().input);
}

}  // namespace
}  // namespace rotordrop
