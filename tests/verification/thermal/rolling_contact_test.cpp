// The conductance of a rolling contact against a computation of a ball's pass.
//
// An elliptic spot (semi-axes a across, b along the motion) between two half spaces of different temperature, both passing it at U. A flux 1 over a
// rectangle, for ever, warms the surface of a medium that passes at U by
//   integral over t of (1/(e sqrt(pi t))) X(x - U t) Y(y) dt,   X(x) = [erf((x - x_1)/sqrt(4 kappa t)) - erf((x - x_2)/sqrt(4 kappa t))]/2, Y alike:
// what was released a time t ago is U t downstream. The spot is covered with rectangles; the fluxes that bring both surfaces together follow from collocation, and
// their sum is the conductance. Valid for every Peclet number U b/kappa. validation/rolling_conduction.py does the same on a finer mesh with other tools, over all
// Peclet numbers from 0.1 to 1000 and ellipses from 1 to 15, and records it.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "laws/heat/rolling_conduction.h"

namespace rotordrop {
namespace {

using std::numbers::pi;

struct Rectangle {
  double x_1, x_2, y_1, y_2;  // and its mirror image at -y
  [[nodiscard]] double area() const { return 2. * (x_2 - x_1) * (y_2 - y_1); }
};

/// The half y > 0 of an ellipse, in bands that have the area of their piece of it; finer towards the rim.
std::vector<Rectangle> cover(double a, double b, int n_across, int n_along) {
  const auto area = [&](double y) {
    const double s = std::min(y / a, 1.);
    return 0.5 * a * (s * std::sqrt(1. - s * s) + std::asin(s));
  };
  std::vector<Rectangle> cells;
  for (int j = 0; j < n_across; ++j) {
    const double low = a * std::sin(0.5 * pi * j / n_across), high = a * std::sin(0.5 * pi * (j + 1) / n_across);
    const double half = b * (area(high) - area(low)) / (high - low);
    for (int i = 0; i < n_along; ++i)
      cells.push_back({-half * std::cos(pi * i / n_along), -half * std::cos(pi * (i + 1) / n_along), low, high});
  }
  return cells;
}

Eigen::MatrixXd influence(const std::vector<Rectangle>& cells, const ConductingBody& body, double U, int n_times) {
  const auto n = static_cast<Eigen::Index>(cells.size());
  const double k = body.conductivity, kappa = k / body.volumetric_capacity, e = k / std::sqrt(kappa);
  double smallest = HUGE_VAL, largest = 0.;
  for (const auto& c : cells) {
    smallest = std::min({smallest, c.x_2 - c.x_1, c.y_2 - c.y_1});
    largest = std::max(largest, c.y_2);
  }
  const double first = std::min(2.5e-4 * smallest * smallest / kappa, 1e-2 * smallest / U),
               last = 1e3 * largest * largest / kappa;
  const double step = std::log(last / first) / (n_times - 1);
  // Until `first` an element only warms itself, as an evenly heated half space.
  Eigen::MatrixXd rise = Eigen::MatrixXd::Identity(n, n) * (2. * std::sqrt(first / pi) / e);
  for (int s = 0; s < n_times; ++s) {
    const double t = first * std::exp(s * step), weight = step * (s == 0 || s + 1 == n_times ? 0.5 : 1.);
    const double spread = 1. / std::sqrt(4. * kappa * t), factor = weight * std::sqrt(t / pi) / e / 4.;
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto& to = cells[static_cast<std::size_t>(i)];
      const double x = 0.5 * (to.x_1 + to.x_2) - U * t, y = 0.5 * (to.y_1 + to.y_2);
      for (Eigen::Index j = 0; j < n; ++j) {
        const auto& from = cells[static_cast<std::size_t>(j)];
        const double X = std::erf((x - from.x_1) * spread) - std::erf((x - from.x_2) * spread);
        if (X == 0.) continue;
        const double Y = std::erf((y - from.y_1) * spread) - std::erf((y - from.y_2) * spread) +
                         std::erf((y + from.y_2) * spread) - std::erf((y + from.y_1) * spread);
        rise(i, j) += factor * X * Y;
      }
    }
  }
  return rise;
}

/// [W/K] of a contact between two bodies.
double computed(double a, double b, const ConductingBody& one, const ConductingBody& other, double U) {
  const auto cells = cover(a, b, 6, 14);
  const Eigen::MatrixXd rise = influence(cells, one, U, 80) + influence(cells, other, U, 80);
  const Eigen::VectorXd flux = rise.partialPivLu().solve(Eigen::VectorXd::Ones(rise.rows()));
  double watts = 0.;
  for (std::size_t i = 0; i < cells.size(); ++i) watts += flux(static_cast<Eigen::Index>(i)) * cells[i].area();
  return watts;
}

const ConductingBody bearing_steel{42., 7800. * 470.}, silicon_nitride{25., 3200. * 700.};

TEST(RollingContact, ConductsWhatThePassOfABallGives) {
  const double a = 0.4e-3;
  for (const double ellipticity : {1., 3., 8., 15.})
    for (const double peclet : {0.1, 3., 100.})
      for (const auto& ball : {bearing_steel, silicon_nitride}) {
        const double b = a / ellipticity;
        const double U = peclet * bearing_steel.conductivity / bearing_steel.volumetric_capacity / b;
        const double pass = computed(a, b, bearing_steel, ball, U);
        const double found = contact_conduction(bearing_steel, ball, a, ellipticity, 0., 0.14).conductance(1., U);
        printf("a/b %4.0f  U b/kappa %6.1f  pass %.5f W/K  formula %.5f W/K  %+.2f %%\n", ellipticity, peclet, pass,
               found, 100. * (found / pass - 1.));
        EXPECT_NEAR(found / pass, 1., 0.06) << "what docs/theory/model.md, section 6, promises";
      }
}

TEST(RollingContact, MatchesTheRecordedComputations) {
  std::ifstream file(std::string(ROTORDROP_SOURCE_DIR) + "/validation/rolling_conduction.json");
  ASSERT_TRUE(file.is_open());
  const auto recorded = nlohmann::json::parse(file);
  const double b = 1e-4;
  const ConductingBody one{40., 4e6};
  const double kappa = one.conductivity / one.volumetric_capacity;
  double largest = 0.;
  int n = 0;
  for (const auto& entry : recorded.at("spots")) {
    const double ratio = entry.at("ratio"), U = entry.at("peclet").get<double>() * kappa / b;
    const double g = spot_conduction(one, ratio * b, ratio).per_root(1., U) / (one.conductivity * b);
    largest = std::max(largest, std::fabs(g / entry.at("computed").get<double>() - 1.));
    ++n;
  }
  EXPECT_EQ(n, 40);
  EXPECT_LT(largest, 0.06);
  for (const auto& entry : recorded.at("pairs")) {
    const double ratio = entry.at("ratio"), U = entry.at("peclet").get<double>() * kappa / b;
    const double k = entry.at("conductivity").get<double>() * one.conductivity;
    const ConductingBody other{k, k / (entry.at("diffusivity").get<double>() * kappa)};
    const double G = contact_conduction(one, other, ratio * b, ratio, 0., 0.14).conductance(1., U);
    EXPECT_NEAR(G / (one.conductivity * b) / entry.at("computed").get<double>(), 1., 0.06) << entry.dump();
  }
  printf("largest error of a spot %.2f %%\n", 100. * largest);
}

}  // namespace
}  // namespace rotordrop
