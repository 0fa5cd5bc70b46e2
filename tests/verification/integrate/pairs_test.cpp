// Tableaus of the own methods against the conditions of their orders.
//
// A method with weights b has order p if for every rooted tree of up to p vertices (Hairer, Norsett & Wanner, Solving Ordinary Differential Equations
// I, 2nd ed., II.2)
//   sum_i b_i u_i(tree) = 1 / gamma(tree)
//   u_i(tree) = product over the root's branches of sum_j a_ij u_j(branch),  gamma(tree) = vertices x product of gamma over the branches.
// An interpolant of order q has theta^vertices / gamma on the right; the error e = b - b_embedded of a pair p(p - 1) gives zero up to p - 1 vertices.
// The rate at the start of the step before is that of the exact solution at -1/ratio, in steps: there u_i(tree) is the product over the root's branches
// of (-1/ratio)^vertices / gamma, each of the branch.
#include "integrate/pairs.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <optional>
#include <vector>

namespace rotordrop {
namespace {

struct Tree {
  std::vector<Tree> branches;
  [[nodiscard]] int vertices() const {
    return std::accumulate(branches.begin(), branches.end(), 1, [](int n, const Tree& t) { return n + t.vertices(); });
  }
  [[nodiscard]] double gamma() const {
    return std::accumulate(branches.begin(), branches.end(), 1. * vertices(),
                           [](double product, const Tree& t) { return product * t.gamma(); });
  }
};

using Stages = std::array<long double, most_stages>;

/// @param past  where the step before began, in steps
Stages weights_of(const EmbeddedTableau& pair, long double past, const Tree& tree) {
  const auto start = static_cast<std::size_t>(pair.start);
  Stages u;
  u.fill(1.L);
  for (const Tree& branch : tree.branches) {
    const Stages inner = weights_of(pair, past, branch);
    for (std::size_t i = 0; i < start; ++i) u[i] *= std::pow(past, branch.vertices()) / branch.gamma();
    for (std::size_t i = start; i < most_stages; ++i) {
      long double sum = 0.L;
      for (std::size_t j = 0; j < i; ++j) sum += pair.a[i][j] * inner[j];
      u[i] *= sum;
    }
  }
  return u;
}

/// All trees of n vertices, by n from 1.
using Forest = std::map<int, std::vector<Tree>>;

/// Appends all trees that further branches make of a tree. Branches come in falling order, so that each tree is found once.
/// @param vertices     of the further branches together
/// @param size, index  the first branch that is allowed: its vertices, and its place among those of so many
void grow(const Forest& smaller, int vertices, int size, std::size_t index, Tree& tree, std::vector<Tree>& out) {
  if (vertices == 0) out.push_back(tree);
  for (int s = std::min(size, vertices); s > 0; --s) {
    const auto& branches = smaller.at(s);
    const std::size_t last = s == size ? index : branches.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
      tree.branches.push_back(branches[i]);
      grow(smaller, vertices - s, s, i, tree, out);
      tree.branches.pop_back();
    }
  }
}

Forest trees_up_to(int most) {
  Forest trees = {{1, {Tree{}}}};
  for (int n = 2; n <= most; ++n) {
    Tree root;
    std::vector<Tree> found;
    grow(trees, n - 1, n - 1, trees.at(n - 1).size() - 1, root, found);
    trees[n] = found;
  }
  return trees;
}

TEST(RootedTrees, AreCompleteUpToSixVertices) {
  const Forest trees = trees_up_to(6);
  const std::array<std::size_t, 6> known = {1, 1, 2, 4, 9, 20};
  for (int n = 1; n <= 6; ++n) EXPECT_EQ(trees.at(n).size(), known[static_cast<std::size_t>(n - 1)]) << n;
}

struct KnownPair {
  IntegrationMethod method;
  int order, interpolant_order;
  double accuracy;                   // of the sums
  std::optional<double> ratio = {};  // of a two-step method
};

/// Coefficients that are fractions are good to roundoff; Tsitouras' are published with 16 digits, and numbers of up to 88 cancel in his interpolant.
constexpr KnownPair known_pairs[] = {{IntegrationMethod::tsitouras, 5, 4, 2e-14},
                                     {IntegrationMethod::bogacki_shampine, 3, 3, 1e-15},
                                     {IntegrationMethod::sofroniou_spaletta, 4, 3, 1e-15},
                                     {IntegrationMethod::two_step_runge_kutta, 3, 3, 1e-15, 0.},
                                     {IntegrationMethod::two_step_runge_kutta, 4, 3, 1e-14, 0.2},
                                     {IntegrationMethod::two_step_runge_kutta, 4, 3, 1e-15, 1.},
                                     {IntegrationMethod::two_step_runge_kutta, 4, 3, 1e-15, 5.}};

class Tableau : public testing::TestWithParam<KnownPair> {
 protected:
  Tableau() : pair(tableau_of(GetParam().method)) {
    if (const auto ratio = GetParam().ratio) {
      set_two_step(pair, *ratio);
      past = *ratio > 0. ? -1. / *ratio : 0.;  // at zero nothing counts it
    }
  }
  EmbeddedTableau pair;
  double past = 0.;
  const std::size_t n = static_cast<std::size_t>(pair.n_stages), start = static_cast<std::size_t>(pair.start);

  /// sum_i w_i u_i - right over all trees of so many vertices, the largest.
  template <class Weight>
  [[nodiscard]] double largest_defect(int vertices, const Weight& weight, double right) const {
    double largest = 0.;
    const Forest trees = trees_up_to(vertices);
    for (const Tree& tree : trees.at(vertices)) {
      const Stages u = weights_of(pair, past, tree);
      long double sum = -static_cast<long double>(right) / tree.gamma();
      for (std::size_t i = 0; i < n; ++i) sum += weight(i) * u[i];
      largest = std::max(largest, static_cast<double>(std::fabs(sum)));
    }
    return largest;
  }
};

TEST_P(Tableau, HasNodesThatAreTheSumsOfItsRows) {
  for (std::size_t i = 0; i < n; ++i)
    EXPECT_NEAR(std::accumulate(pair.a[i].begin(), pair.a[i].end(), 0.), pair.c[i], 2e-15) << i;
}

TEST_P(Tableau, IsExplicitAndEndsWithTheStep) {
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i; j < most_stages; ++j) EXPECT_EQ(pair.a[i][j], 0.) << i << " " << j;
  EXPECT_EQ(pair.c[start], 0.);
  EXPECT_EQ(pair.c[n - 1], 1.) << "first same as last";
}

TEST_P(Tableau, FulfilsTheConditionsOfItsOrder) {
  const auto weight = [&](std::size_t i) { return pair.a[n - 1][i]; };
  if (GetParam().ratio != 0.) {
    EXPECT_EQ(pair.order, GetParam().order);
  }
  for (int order = 1; order <= GetParam().order; ++order)
    EXPECT_LT(largest_defect(order, weight, 1.), GetParam().accuracy) << order;
  EXPECT_GT(largest_defect(GetParam().order + 1, weight, 1.), 1e-4) << "the next order";
}

TEST_P(Tableau, EstimatesItsErrorByAMethodOfTheOrderBelow) {
  const auto weight = [&](std::size_t i) { return pair.e[i]; };
  for (int order = 1; order < GetParam().order; ++order) EXPECT_LT(largest_defect(order, weight, 0.), 2e-15) << order;
  EXPECT_GT(largest_defect(GetParam().order, weight, 0.), 5e-4) << "an estimate that sees nothing";
}

TEST_P(Tableau, InterpolatesWithTheOrderOfItsPolynomial) {
  for (const double theta : {0.2, 0.5, 0.9}) {
    const auto weight = [&](std::size_t i) { return pair.weight(i, theta); };
    for (int order = 1; order <= GetParam().interpolant_order; ++order)
      EXPECT_LT(largest_defect(order, weight, std::pow(theta, order)), GetParam().accuracy) << order << " " << theta;
  }
}

TEST_P(Tableau, InterpolatesSmoothlyFromStepToStep) {
  // Exact for polynomials of degree four.
  const auto slope = [&](std::size_t i, double theta) {
    constexpr double h = 0.25;
    return (8. * (pair.weight(i, theta + h) - pair.weight(i, theta - h)) -
            (pair.weight(i, theta + 2. * h) - pair.weight(i, theta - 2. * h))) /
           (12. * h);
  };
  const double accuracy = 10. * GetParam().accuracy;  // of numbers up to 30 outside the step
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(pair.weight(i, 0.), 0.) << i;
    EXPECT_NEAR(pair.weight(i, 1.), pair.a[n - 1][i], GetParam().accuracy) << i;
    EXPECT_NEAR(slope(i, 0.), i == start ? 1. : 0., accuracy) << "begins with the first rate " << i;
    EXPECT_NEAR(slope(i, 1.), i == n - 1 ? 1. : 0., accuracy) << "ends with the last rate " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(OwnPairs, Tableau, testing::ValuesIn(known_pairs));

TEST(TwoStepMethod, BeginsAsOneWithoutAStepBefore) {
  const EmbeddedTableau& begins = tableau_of(IntegrationMethod::two_step_runge_kutta);
  EXPECT_TRUE(sees_past(begins));
  for (const auto& row : begins.a) EXPECT_EQ(row[0], 0.);
}

TEST(OwnPairs, AreAllTested) {
  for (const auto& kind : integration_methods)
    EXPECT_EQ(std::any_of(std::begin(known_pairs), std::end(known_pairs),
                          [&](const KnownPair& known) { return known.method == kind.method; }),
              kind.make == make_embedded_pair)
        << kind.name;
}

TEST(OwnPairs, AreThoseThatTheirMakerMakes) {
  for (const MethodKind& kind : integration_methods)
    EXPECT_EQ(is_own_pair(kind.method), kind.make == make_embedded_pair) << kind.name;
}

}  // namespace
}  // namespace rotordrop
