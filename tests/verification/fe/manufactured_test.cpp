// Orders of convergence against a manufactured solution: two bodies of different materials on each other at r = m, contact resistance R between
// them, conductivity k_i = k_i0 (1 + beta_i (T - T_r)) and heat capacity linear in temperature too.
//
// In the Kirchhoff variable theta = integral of k from T_r to T,  T = T_r + (sqrt(1 + 2 beta theta/k_0) - 1)/beta, the equation reads
//   rho c(T)/k(T) theta_t = theta_rr + theta_r/r + theta_xx + source,
// and heat flows outward with -theta_r. With s(x, t) = S cos(w x + 0.4) exp(-t/tau) let at the interface
//   flux q = q_0 + q_1 s,   T_2 = T_20 + s,   T_1 = T_2 + R q,   so that T_i = T_i0 + m_i s with m_2 = 1, m_1 = 1 + R q_1,
// and around it  theta_i = theta_i(T_i0 + m_i s) - q (r - m) + A_i (r - m)^2 s.  With B = k_i(T_i0 + m_i s) m_i - q_1 (r - m) + A_i (r - m)^2:
//   theta_t = B s_t,  theta_x = B s_x,  theta_xx = B s_xx + k_i0 beta_i m_i^2 s_x^2,  theta_r = -q + 2 A_i (r - m) s,  theta_rr = 2 A_i s.
// All outer boundaries get the flux that theta says.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "fe_room.h"

namespace rotordrop {
namespace {

constexpr double T_r = 300., m = 45e-3, R = 2e-4, length = 30e-3, S = 15., w = 120., tau = 0.1;
constexpr double q_0 = 4e4, q_1 = 1.5e3, T_20 = 340.;

struct Body {
  double k_0, beta, c_0, c_1, rho, A;
  double T_0, slope;  // of the temperature at the interface: T_0 + slope s
  [[nodiscard]] double k(double T) const { return k_0 * (1. + beta * (T - T_r)); }
  [[nodiscard]] double c(double T) const { return c_0 + c_1 * (T - T_r); }
};
const Body bodies[2] = {{46., -6e-4, 460., 0.4, 7800., 5e5, T_20 + R* q_0, 1. + R* q_1},
                        {20., 1.5e-3, 700., 0.9, 4000., 1e5, T_20, 1.}};

double s_of(double x, double t) { return S * std::cos(w * x + 0.4) * std::exp(-t / tau); }
double s_x_of(double x, double t) { return -w * S * std::sin(w * x + 0.4) * std::exp(-t / tau); }

struct Exact {
  double T, theta_r, theta_x, source;
};
Exact exact(std::size_t i, double x, double r, double t) {
  const Body& b = bodies[i];
  const double s = s_of(x, t), s_x = s_x_of(x, t), d = r - m;
  const double u = b.T_0 + b.slope * s - T_r;
  const double theta = b.k_0 * (u + 0.5 * b.beta * u * u) - (q_0 + q_1 * s) * d + b.A * d * d * s;
  const double T = T_r + (std::sqrt(1. + 2. * b.beta * theta / b.k_0) - 1.) / b.beta;
  const double B = b.k(u + T_r) * b.slope - q_1 * d + b.A * d * d;
  const double theta_r = -(q_0 + q_1 * s) + 2. * b.A * d * s;
  const double theta_xx = -B * w * w * s + b.k_0 * b.beta * b.slope * b.slope * s_x * s_x;
  return {T, theta_r, B * s_x, -b.rho * b.c(T) / b.k(T) * B * s / tau - (2. * b.A * s + theta_r / r + theta_xx)};
}

HeatConductionProblem manufactured(int degree, int cells) {
  const auto table = [](auto f) { return PropertyTable({{250., f(250.)}, {500., f(500.)}}); };
  HeatConductionProblem p;
  const std::array<double, 2> r[2] = {{30e-3, m}, {m, 70e-3}};
  for (std::size_t i = 0; i < 2; ++i) {
    const Body& b = bodies[i];
    p.bodies.push_back({i == 0 ? "ring" : "housing",
                        {0., length},
                        r[i],
                        b.rho,
                        table([&](double T) { return b.k(T); }),
                        table([&](double T) { return b.c(T); })});
    p.fluxes.push_back(
        {{i, HeatSide::left}, {}, {}, [i](double x, double y, double t) { return -exact(i, x, y, t).theta_x; }});
    p.fluxes.push_back(
        {{i, HeatSide::right}, {}, {}, [i](double x, double y, double t) { return exact(i, x, y, t).theta_x; }});
  }
  p.fluxes.push_back(
      {{0, HeatSide::inner}, {}, {}, [](double x, double y, double t) { return -exact(0, x, y, t).theta_r; }});
  p.fluxes.push_back(
      {{1, HeatSide::outer}, {}, {}, [](double x, double y, double t) { return exact(1, x, y, t).theta_r; }});
  p.interfaces = {{{0, HeatSide::outer}, {1, HeatSide::inner}, R}};
  p.initial_temperature = T_20;
  p.initial_field = [](std::size_t i, double x, double y) { return exact(i, x, y, 0.).T; };
  p.volume_source = [](std::size_t i, double x, double y, double t) { return exact(i, x, y, t).source; };
  p.numerics.degree = degree;
  p.numerics.cells = cells;
  p.numerics.grading = 1.;
  p.numerics.tolerance = 1e-9;
  return p;
}

double error_at(HeatConductionSolver& solver, double t) {
  solver.advance_to(t);
  return solver.difference([t](std::size_t i, double x, double r) { return exact(i, x, r, t).T; });
}

TEST(HeatOfTwoMaterials, ConvergesInSpaceWithOneOrderMoreThanTheDegree) {
  for (const int degree : {1, 2, 3}) {
    std::printf("  degree %d: cells  L2 error [K m^1.5]  order\n", degree);
    double last = 0.;
    for (const int cells : {3, 6, 12}) {
      const auto solver = make_solver(manufactured(degree, cells));
      const double error = error_at(*solver, 0.2);
      const double order = last > 0. ? std::log2(last / error) : 0.;
      std::printf("           %5d  %18.3e  %5.2f\n", cells, error, order);
      if (cells == 12) {
        EXPECT_GT(order, degree + 0.85);
      }
      last = error;
    }
  }
}

TEST(HeatOfTwoMaterials, ConvergesInTimeWithOrderThreeOrBetter) {
  std::printf("  step [s]   L2 error [K m^1.5]  order\n");
  double last = 0.;
  for (const double step : {0.1, 0.05, 0.025, 0.0125}) {
    auto problem = manufactured(4, 8);
    problem.numerics.fixed_step = step;
    const auto solver = make_solver(problem);
    const double error = error_at(*solver, 0.2);
    const double order = last > 0. ? std::log2(last / error) : 0.;
    std::printf("  %8.4f   %18.3e  %5.2f\n", step, error, order);
    if (last > 0.) {
      EXPECT_GT(order, 3.);
    }
    last = error;
  }
}

}  // namespace
}  // namespace rotordrop
