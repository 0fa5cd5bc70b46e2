// Gaps and forces of a fit's nodes: two nodes by hand, and what must hold of any.
#include "thermal/section/fit_opening.h"

#include <gtest/gtest.h>

#include <random>

namespace rotordrop {
namespace {

FitOpenings nodes_with(std::vector<std::vector<double>> stiffness, std::vector<double> output) {
  const std::size_t n = stiffness.size();
  FitOpenings o{std::move(stiffness), {std::move(output)}, {}, std::vector<double>(n, 1.)};
  for (std::size_t i = 0; i < n; ++i) {
    o.mass.emplace_back(n, 0.);
    o.mass.back()[i] = 1.;
  }
  return o;
}

// Two nodes whose gaps pull at each other: force 1 = -6 + 3 g_1 - g_2, force 2 = p + 2 g_2 - g_1.
TEST(FitOpening, OfTwoNodesIsThatByHand) {
  FitOpening fit(nodes_with({{3., -1.}, {-1., 2.}}, {1., 10.}));
  fit.solve(std::vector<double>{6., 5.}, std::vector<double>{0., 0.});
  EXPECT_EQ(fit.added(0), 0.);
  EXPECT_EQ(fit.state().open_fraction, 0.);
  EXPECT_DOUBLE_EQ(fit.state().mean_pressure, 5.5);
  fit.solve(std::vector<double>{-6., 5.}, std::vector<double>{0., 0.});  // g_1 = 2, and 3 N are left on the other
  EXPECT_DOUBLE_EQ(fit.added(0), 2.);
  EXPECT_DOUBLE_EQ(fit.state().open_fraction, 0.5);
  EXPECT_DOUBLE_EQ(fit.state().mean_pressure, 1.5);
  EXPECT_DOUBLE_EQ(fit.state().lowest_pressure, 3.);
  fit.solve(std::vector<double>{-6., 1.},
            std::vector<double>{0., 0.});  // 3 g_1 - g_2 = 6, 2 g_2 - g_1 = -1: g = (11, 3) / 5
  EXPECT_DOUBLE_EQ(fit.added(0), 11. / 5. + 10. * 3. / 5.);
  EXPECT_DOUBLE_EQ(fit.state().open_fraction, 1.);
  EXPECT_EQ(fit.state().mean_pressure, 0.);
}

// A sum of large parts leaves roundoff, which opens nothing.
TEST(FitOpening, DoesNotBeginInRoundoff) {
  FitOpening fit(nodes_with({{3., -1.}, {-1., 2.}}, {1., 10.}));
  const std::vector<double> roundoff = {-1e-9, 1e-9};
  fit.solve(roundoff, std::vector<double>{1e6, 1e6});
  EXPECT_EQ(fit.state().open_fraction, 0.);
  fit.solve(roundoff, std::vector<double>{1., 1.});
  EXPECT_EQ(fit.state().open_fraction, 0.5);
}

// Stiffnesses of random matrices, whose entries have either sign: opening all that pull may close others, and go round in circles.
TEST(FitOpening, FindsTheOneStateOfAnyStiffness) {
  std::mt19937 random(3);
  std::normal_distribution<double> number;
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t n = 2 + static_cast<std::size_t>(trial) % 12;
    std::vector<std::vector<double>> root(n, std::vector<double>(n)), S(n, std::vector<double>(n, 0.));
    for (auto& row : root)
      for (double& value : row) value = number(random);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t k = 0; k < n; ++k) S[i][j] += root[i][k] * root[j][k];
        if (i == j) S[i][j] += 0.01;
      }
    FitOpenings o = nodes_with(S, {});
    o.output.clear();
    for (std::size_t i = 0; i < n; ++i) {
      o.output.emplace_back(n, 0.);
      o.output[i][i] = 1.;
    }
    FitOpening fit(o);
    std::vector<double> closed(n);
    for (double& value : closed) value = number(random);
    fit.solve(closed, std::vector<double>(n, 0.));
    double sum = 0., largest = 1.;
    for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::fabs(fit.added(i)));
    // roundoff, for which the search takes 1e-11 of what adds up at a node
    const double slack = 1e-9 * largest * S[0][0] * static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i) {
      double force = closed[i];
      for (std::size_t j = 0; j < n; ++j) force += S[i][j] * fit.added(j);
      EXPECT_GE(fit.added(i), -1e-9 * largest);
      EXPECT_GE(force, -slack) << "node " << i << " pulls";
      EXPECT_NEAR(force * fit.added(i), 0., slack * largest);
      sum += force;
    }
    EXPECT_NEAR(fit.state().mean_pressure, sum / static_cast<double>(n), slack);
  }
}

}  // namespace
}  // namespace rotordrop
