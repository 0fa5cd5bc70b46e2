// Orders of convergence against a manufactured solution, in two bodies of one material, bonded:
//   u_x = A s r^n,  u_r = B c r^n,  s = sin(p x), c = cos(p x),  theta = C sin(q x) r^2
// with the strains  xx: A p c r^n,  rr: n B c r^(n-1),  tt: B c r^(n-1),  2 xr: n A s r^(n-1) - B p s r^n,  their trace
// A p c r^n + (n+1) B c r^(n-1), and body force = - div sigma:
//   f_x = -(sigma_xx,x + sigma_xr,r + sigma_xr/r),   f_r = -(sigma_rr,r + sigma_xr,x + (sigma_rr - sigma_tt)/r).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "fe_room.h"

namespace rotordrop {
namespace {

constexpr double A = 3., B = 5., n = 4., p = 130., q = 90., C = 3e4, T_0 = 293.15;
constexpr double E = 2.05e11, nu = 0.3, alpha = 11.8e-6;
constexpr double lambda = E * nu / ((1. + nu) * (1. - 2. * nu)), mu = 0.5 * E / (1. + nu), beta = E / (1. - 2. * nu);
constexpr double L = 30e-3;

AxialRadial exact(std::size_t, double x, double r) {
  return {A * std::sin(p * x) * std::pow(r, n), B * std::cos(p * x) * std::pow(r, n)};
}
double rise(double x, double r) { return C * std::sin(q * x) * r * r; }

AxialRadial body_force(std::size_t, double x, double r) {
  const double s = std::sin(p * x), c = std::cos(p * x);
  const double r1 = std::pow(r, n - 1.), r2 = std::pow(r, n - 2.), r0 = std::pow(r, n);
  const double hot = beta * alpha * C;
  const double xx_x = -lambda * p * s * (A * p * r0 + (n + 1.) * B * r1) - 2. * mu * A * p * p * s * r0 -
                      hot * q * std::cos(q * x) * r * r;
  const double xr_r = mu * s * (n * (n - 1.) * A * r2 - n * B * p * r1), xr = mu * s * (n * A * r2 - B * p * r1);
  const double rr_r = lambda * c * (A * p * n * r1 + (n + 1.) * (n - 1.) * B * r2) +
                      2. * mu * n * (n - 1.) * B * c * r2 - hot * std::sin(q * x) * 2. * r;
  const double xr_x = mu * p * c * (n * A * r1 - B * p * r0);
  return {-(xx_x + xr_r + xr), -(rr_r + xr_x + 2. * mu * (n - 1.) * B * c * r2)};
}
struct Stress {
  double xx, rr, xr;
};
Stress stress(double x, double r) {
  const double s = std::sin(p * x), c = std::cos(p * x), r1 = std::pow(r, n - 1.), r0 = std::pow(r, n);
  const double common = lambda * (A * p * c * r0 + (n + 1.) * B * c * r1) - beta * alpha * rise(x, r);
  return {common + 2. * mu * A * p * c * r0, common + 2. * mu * n * B * c * r1, mu * s * (n * A * r1 - B * p * r0)};
}

ElasticProblem manufactured(int degree, int cells) {
  ElasticProblem problem;
  const std::array<double, 2> extent[2] = {{30e-3, 45e-3}, {45e-3, 70e-3}};
  for (std::size_t i = 0; i < 2; ++i) {
    problem.bodies.push_back({i == 0 ? "ring" : "housing", {0., L}, extent[i], 7800., E, nu, PropertyTable(alpha), 0.});
    problem.holds.push_back({{i, HeatSide::right}, true, true, exact});
    problem.tractions.push_back({{i, HeatSide::left}, 0., [](std::size_t, double x, double r) {
                                   return AxialRadial{-stress(x, r).xx, -stress(x, r).xr};
                                 }});
  }
  problem.tractions.push_back({{0, HeatSide::inner}, 0., [](std::size_t, double x, double r) {
                                 return AxialRadial{-stress(x, r).xr, -stress(x, r).rr};
                               }});
  problem.tractions.push_back({{1, HeatSide::outer}, 0., [](std::size_t, double x, double r) {
                                 return AxialRadial{stress(x, r).xr, stress(x, r).rr};
                               }});
  problem.fits = {{"cut", {0, HeatSide::outer}, {1, HeatSide::inner}, 0., FitKind::bonded}};
  problem.body_force = body_force;
  problem.numerics.degree = degree;
  problem.numerics.cells = cells;
  return problem;
}

TEST(ElasticityOfTwoBodies, ConvergesWithOneOrderMoreThanTheDegree) {
  for (const int degree : {1, 2, 3}) {
    std::printf("  degree %d: cells  L2 error/norm  order\n", degree);
    double last = 0.;
    for (const int cells : {3, 6, 12}) {
      const auto solver = make_elastic_solver(manufactured(degree, cells));
      solver->solve(solver->interpolate([](std::size_t, double x, double r) { return T_0 + rise(x, r); }), 0.);
      const double error = solver->difference(exact), norm = solver->difference([](std::size_t, double, double) {
        return AxialRadial{0., 0.};
      });
      const double order = last > 0. ? std::log2(last / error) : 0.;
      std::printf("           %5d  %13.3e  %5.2f\n", cells, error / norm, order);
      if (cells == 12) {
        EXPECT_GT(order, degree + 0.85);
        EXPECT_LT(error, (degree == 1 ? 1e-1 : 1e-2) * norm);
      }
      last = error;
    }
  }
}

}  // namespace
}  // namespace rotordrop
