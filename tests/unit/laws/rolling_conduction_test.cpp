// Conduction between a ball and its races, and spreading from a strip.
//
// AT REST a round spot of one temperature and radius a conducts 4 k a, an ellipse 2 pi k a / K(m), m = 1 - (b/a)^2.
// ROLLING FAST each point of the surface is stepped to the spot's temperature for t = 2 y(x)/U, y = b sqrt(1 - x^2/a^2), and takes 2 e sqrt(t/pi):
//   G = integral from -a to a of U 2 e sqrt(2 b sqrt(1 - x^2/a^2) / (pi U)) dx, here by quadrature.
// IN SERIES two equal bodies halve the conductance of one; a film of thickness h adds h/(k pi a b).
// INTO A SPHERE of conductivity k that warms evenly: flux q''(theta) = sum q_n P_n(cos theta) on its surface gives there, over the volume's mean,
//   q_0 r/(5 k) + sum over n >= 1 of q_n r P_n/(k n)
// (q_0: T = q_0 rho^2/(2 k r) + const, mean over the volume 3/5 of the surface's; n: T ~ rho^n). A band of half width a around the equator: flux on |x| < sin(a/r).
// STRIPS. A strip as wide as the slab spreads nothing. Others: finite differences of the slab, cell-centred.
#include "laws/heat/rolling_conduction.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/legendre.hpp>
#include <cmath>
#include <numbers>

#include "laws/heat/strip_spreading.h"

namespace rotordrop {
namespace {

using std::numbers::pi;
const ConductingBody steel{46., 7800. * 470.}, ceramic{30., 3200. * 700.};
constexpr double axis_factor = 1.1e-4;  // [m/N^(1/3)]

TEST(SpotConduction, IsExactAtRestAndAtHighSpeed) {
  const double k = steel.conductivity, e = std::sqrt(k * steel.volumetric_capacity);
  for (const double ellipticity : {1., 3., 8., 15.})
    for (const double load : {0.5, 30., 900.}) {
      const double u = std::cbrt(load), a = axis_factor * u, b = a / ellipticity;
      const auto spot = spot_conduction(steel, axis_factor, ellipticity);
      const double K = boost::math::ellint_1(std::sqrt(1. - b * b / (a * a)));
      EXPECT_NEAR(u * spot.per_root(u, 0.) / (2. * pi * k * a / K), 1., 1e-12);
      if (ellipticity == 1.) {
        EXPECT_NEAR(u * spot.per_root(u, 0.) / (4. * k * a), 1., 1e-12);
      }

      const double U = 1e12;  // [m/s]: so fast that G0 is below 1e-9 of it
      boost::math::quadrature::tanh_sinh<double> quadrature;
      const double fast = quadrature.integrate(
          [&](double x) { return 2. * e * U * std::sqrt(2. * b * std::sqrt(1. - x * x / (a * a)) / (pi * U)); }, -a, a);
      EXPECT_NEAR(u * spot.per_root(u, U) / fast, 1., 1e-9);
      EXPECT_GT(spot.per_root(u, 1.), spot.per_root(u, 0.1));
    }
}

TEST(ContactConduction, PutsRaceFilmAndBallInSeries) {
  const double ellipticity = 7., u = 3.1, U = 4., a = axis_factor * u, b = a / ellipticity;
  const auto alike = contact_conduction(steel, steel, axis_factor, ellipticity, 0., 0.14);
  const double g = u * spot_conduction(steel, axis_factor, ellipticity).per_root(u, U);
  EXPECT_NEAR(alike.conductance(u, U), 0.5 * g, 1e-12);
  const double g_c = u * spot_conduction(ceramic, axis_factor, ellipticity).per_root(u, U);
  const double film = 0.14 * pi * a * b / 0.1e-6;
  const auto oiled = contact_conduction(steel, ceramic, axis_factor, ellipticity, 0.1e-6, 0.14);
  EXPECT_NEAR(1. / oiled.conductance(u, U), 1. / g + 1. / g_c + 1. / film, 1e-10);
  EXPECT_EQ(oiled.conductance(0., U), 0.) << "no load";
}

RowConduction row_of(const ConductingBody& ball) {
  return {contact_conduction(steel, ball, axis_factor, 8., 0., 0.14),
          contact_conduction(steel, ball, 1.05 * axis_factor, 6., 0., 0.14),
          repeating_track_conductance(ball.conductivity, 4.7e-3, 0.4e-3)};
}

TEST(RowConduction, IsAStarOfContactsAndBulk) {
  const auto row = row_of(ceramic);
  const auto G = row.of_balls(3., 3., 3.2, 5.);
  const double G_i = row.inner.conductance(3., 5.), G_o = row.outer.conductance(3.2, 5.), G_b = row.into_ball;
  // Between two ends of the star the third left to float: series of two arms.
  const auto floating = [](double direct, double by_way_1, double by_way_2) {
    return direct + by_way_1 * by_way_2 / (by_way_1 + by_way_2);
  };
  EXPECT_NEAR(floating(G.inner_to_outer, G.inner_to_ball, G.outer_to_ball), 3. * G_i * G_o / (G_i + G_o), 1e-12);
  EXPECT_NEAR(floating(G.inner_to_ball, G.inner_to_outer, G.outer_to_ball), 3. * G_i * G_b / (G_i + G_b), 1e-12);
  // A ball that only its inertia presses outwards conducts at the outer race alone.
  const auto outer = row.of_row(0., 0., 10., 90., 5.);
  EXPECT_EQ(outer.inner_to_ball, 0.);
  EXPECT_EQ(outer.inner_to_outer, 0.);
  EXPECT_GT(outer.outer_to_ball, 0.);
  const auto none = row.of_row(0., 0., 0., 0., 5.);
  EXPECT_EQ(none.inner_to_ball + none.outer_to_ball + none.inner_to_outer, 0.);
}

TEST(RowConduction, OfSumsIsThatOfItsBalls) {
  // Loads as (cos b - c)^1.5 over the loaded part, the shape of a radially loaded row with clearance (c > 0) or preload (c < 0).
  for (const auto& ball : {steel, ceramic}) {
    const auto row = row_of(ball);
    for (const double speed : {0., 0.3, 5., 25.})
      for (const double c : {-100., -2., -1., 0., 0.5, 0.9}) {
        BallConductances exact;
        double roots = 0., loads = 0.;
        constexpr int n_balls = 23;
        for (int j = 0; j < n_balls; ++j) {
          const double Q = 500. * std::pow(std::max(std::cos(2. * pi * (j + 0.3) / n_balls) - c, 0.), 1.5);
          exact.add(row.of_balls(1., std::cbrt(Q), std::cbrt(Q), speed));
          roots += std::cbrt(Q);
          loads += Q;
        }
        const auto found = row.of_row(roots, loads, roots, loads, speed);
        // Hoelder's inequality between the powers 1/3 and 1 of the loads: at most 3 % here, none for equal loads.
        const double tolerance = c == -100. ? 1e-4 : 0.03;
        EXPECT_NEAR(found.inner_to_ball / exact.inner_to_ball, 1., tolerance) << c << " " << speed;
        EXPECT_NEAR(found.outer_to_ball / exact.outer_to_ball, 1., tolerance) << c << " " << speed;
        EXPECT_NEAR(found.inner_to_outer / exact.inner_to_outer, 1., 2. * tolerance) << c << " " << speed;
      }
  }
}

TEST(BallTrack, IsThatOfABandOnASphere) {
  const double k = 46., r = 4.76e-3;
  for (const double a : {0.1e-3, 0.4e-3, 0.8e-3}) {
    // One watt. Even n only; integrals of P_n over the band by P_(n+1) - P_(n-1) = (2n + 1) integral of P_n.
    const double x = std::sin(a / r), flux = 1. / (4. * pi * r * r * x);
    double rise = 1. / (4. * pi * r * r) * r / (5. * k);
    const int n_terms = static_cast<int>(40. * r / a);
    for (int n = 2; n <= n_terms; n += 2) {
      const double integral =
          2. / (2 * n + 1.) * (boost::math::legendre_p(n + 1, x) - boost::math::legendre_p(n - 1, x));
      const double q_n = 0.5 * (2 * n + 1.) * flux * integral;
      rise += q_n * r / (k * n) * integral / (2. * x);  // mean over the band
    }
    // The closed form is that of a narrow band: its error rises with a/r, and is 2.3 % at 0.4 mm.
    EXPECT_NEAR(1. / repeating_track_conductance(k, r, a) / rise, 1., 0.005 + 0.25 * a / r) << a;
  }
  EXPECT_NEAR(1. / wandering_track_conductance(k, r), 1. / (4. * pi * r * r) * r / (5. * k), 1e-12);
}

/// Mean of the strip over mean of the surface for 1 W/m, by finite differences: cell-centred, uniform flux out of the far side.
double spreading_by_differences(double W, double t, double from, double to, double k, int n) {
  const int rows = static_cast<int>(std::lround(n * t / W));
  const double h = W / n, flux = 1. / (to - from);
  std::vector<double> T(static_cast<std::size_t>(n * rows), 0.);
  const auto at = [&](int i, int j) -> double& { return T[static_cast<std::size_t>(j * n + i)]; };
  const auto share = [&](int i) {  // of cell i under the strip
    return std::max(0., std::min((i + 1) * h, to) - std::max(i * h, from)) / h;
  };
  for (int sweep = 0; sweep < 20000; ++sweep) {
    double change = 0.;
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < n; ++i) {
        double sum = 0., count = 0.;
        const auto neighbour = [&](int a, int b) {
          if (a < 0 || a >= n || b < 0 || b >= rows) return;
          sum += at(a, b);
          count += 1.;
        };
        neighbour(i - 1, j), neighbour(i + 1, j), neighbour(i, j - 1), neighbour(i, j + 1);
        const double source = (j == 0 ? share(i) * flux * h / k : 0.) - (j == rows - 1 ? h / W / k : 0.);
        const double step = 1.9 * ((sum + source) / count - at(i, j));
        at(i, j) += step;
        change = std::max(change, std::fabs(step));
      }
    if (change < 1e-9 / k) break;
  }
  double strip = 0., all = 0.;
  for (int i = 0; i < n; ++i) {
    const double surface = at(i, 0) + share(i) * flux * 0.5 * h / k;
    strip += share(i) * surface * h / (to - from);
    all += surface / n;
  }
  return strip - all;
}

TEST(StripSpreading, IsThatOfFiniteDifferences) {
  struct Strip {
    double W, t, middle, a;
  };
  for (const auto& s :
       {Strip{16e-3, 4e-3, 8e-3, 1e-3}, Strip{16e-3, 8e-3, 5e-3, 2e-3}, Strip{8e-3, 4e-3, 1e-3, 1e-3}}) {
    const double coarse = spreading_by_differences(s.W, s.t, s.middle - s.a, s.middle + s.a, 46., 64),
                 fine = spreading_by_differences(s.W, s.t, s.middle - s.a, s.middle + s.a, 46., 128);
    const double found = strip_spreading(s.W, s.t, {s.middle}, s.a, 46.);
    printf("differences %.6f %.6f, series %.6f K m/W\n", coarse, fine, found);
    // The differences' own error: up to 1.7 % with 64 cells, 0.5 % with 128.
    EXPECT_NEAR(found / fine, 1., 0.01);
    EXPECT_LT(std::fabs(found - fine), std::fabs(found - coarse) + 1e-12) << "differences converge to it";
  }
}

TEST(StripSpreading, VanishesWithoutUnheatedParts) {
  EXPECT_NEAR(strip_spreading(8e-3, 4e-3, {4e-3}, 4e-3, 46.), 0., 1e-15);
  // Two strips that are each other's mirror image: each half a slab of its own, with half the heat.
  EXPECT_NEAR(strip_spreading(32e-3, 4e-3, {6e-3, 26e-3}, 0.4e-3, 46.),
              0.5 * strip_spreading(16e-3, 4e-3, {6e-3}, 0.4e-3, 46.), 1e-6);
}

TEST(StripSpreading, SeesASlabBehindAsMoreThickness) {
  const std::vector<double> middle = {8e-3};
  EXPECT_NEAR(strip_spreading(16e-3, 3e-3, middle, 0.5e-3, 46., {0., 4e-3}),
              strip_spreading(16e-3, 7e-3, middle, 0.5e-3, 46.), 1e-15);
  EXPECT_NEAR(strip_spreading(16e-3, 3e-3, middle, 0.5e-3, 46., {1e6, 4e-3}),
              strip_spreading(16e-3, 3e-3, middle, 0.5e-3, 46.), 1e-9);
}

}  // namespace
}  // namespace rotordrop
