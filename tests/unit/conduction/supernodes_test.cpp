// Solves by supernodes against substitution entry by entry.
#include "conduction/supernodes.h"

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <random>
#include <utility>
#include <vector>

namespace rotordrop {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;
using Couplings = std::vector<std::pair<int, int>>;

/// The factor of a matrix that couples some unknowns, with ones on its diagonal that it does not store. Couplings are random numbers, so that no two entries are alike.
struct Factor {
  Factor(int n, const Couplings& couplings)
      : L(factor(n, couplings)), supernodes(start(), rows()), triangle(supernodes) {
    triangle.set({L.valuePtr(), n_entries()});
  }
  [[nodiscard]] std::size_t n_entries() const { return static_cast<std::size_t>(L.nonZeros()); }
  [[nodiscard]] std::span<const int> start() const {
    return {L.outerIndexPtr(), static_cast<std::size_t>(L.outerSize()) + 1};
  }
  [[nodiscard]] std::span<const int> rows() const { return {L.innerIndexPtr(), n_entries()}; }
  static Matrix factor(int n, const Couplings& couplings) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> coupling(-1., 1.);
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<double> diagonal(static_cast<std::size_t>(n), 1.);
    for (const auto& [i, j] : couplings) {
      const double a = coupling(random);
      entries.emplace_back(std::min(i, j), std::max(i, j), a);
      for (const int k : {i, j}) diagonal[static_cast<std::size_t>(k)] += std::fabs(a);
    }
    for (int i = 0; i < n; ++i) entries.emplace_back(i, i, diagonal[static_cast<std::size_t>(i)]);
    Matrix upper(n, n);
    upper.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Matrix, Eigen::Upper, Eigen::NaturalOrdering<int>> factors(upper);
    return factors.matrixL().nestedExpression();
  }
  Matrix L;
  Supernodes supernodes;
  SupernodalTriangle triangle;
};

void expect_solves(const Factor& factor, const char* what) {
  const auto n = factor.L.rows();
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1., 1.);
  Vector right(n);
  for (auto& b : right) b = number(random);
  Vector forward = right, backward = right;
  for (Eigen::Index c = 0; c < n; ++c)
    for (Matrix::InnerIterator entry(factor.L, c); entry; ++entry) forward[entry.row()] -= entry.value() * forward[c];
  for (Eigen::Index c = n; c-- > 0;)
    for (Matrix::InnerIterator entry(factor.L, c); entry; ++entry) backward[c] -= entry.value() * backward[entry.row()];
  Vector found(n + 1);
  const std::span<double> all(found.data(), static_cast<std::size_t>(n) + 1);
  constexpr double roundoff = 1e-14;  // of some dozen terms a row, times the solution
  found << right, 7.;
  factor.triangle.solve(all);
  EXPECT_LE((found.head(n) - forward).cwiseAbs().maxCoeff(), roundoff * forward.cwiseAbs().maxCoeff()) << what;
  found << right, 7.;
  factor.triangle.solve_transposed(all);
  EXPECT_LE((found.head(n) - backward).cwiseAbs().maxCoeff(), roundoff * backward.cwiseAbs().maxCoeff()) << what;
}

Couplings all_of(int first, int end) {
  Couplings couplings;
  for (int i = first; i < end; ++i)
    for (int j = i + 1; j < end; ++j) couplings.emplace_back(i, j);
  return couplings;
}

TEST(Supernodes, ADiagonalMatrixChangesNothing) { expect_solves(Factor(3, {}), "no entries"); }

TEST(Supernodes, AFullMatrixIsTakenInTheWidestSupernodes) {
  for (const int n : {1, 2, 7, 8, 9, 20}) {
    const Factor factor(n, all_of(0, n));
    expect_solves(factor, "full");
    EXPECT_EQ(factor.supernodes.list().size(), filled_up(static_cast<std::size_t>(n)) / Supernodes::most_columns);
  }
}

TEST(Supernodes, RowsBelowMayBeAnyNumberOfTiles) {
  for (int n_below = 0; n_below < 20; ++n_below)
    for (int n_columns = 1; n_columns <= 8; ++n_columns) {
      Couplings couplings = all_of(0, n_columns);
      for (int c = 0; c < n_columns; ++c)
        for (int r = 0; r < n_below; ++r) couplings.emplace_back(c, n_columns + 5 + 2 * r);  // with gaps between them
      expect_solves(Factor(n_columns + 5 + 2 * n_below, couplings), "block");
    }
}

TEST(Supernodes, ColumnsWithFewerRowsAreFilledUpWithZeros) {
  Couplings arrow = all_of(1, 9);  // the first column has one row where the next has seven
  arrow.emplace_back(0, 1);
  const Factor factor(9, arrow);
  EXPECT_EQ(factor.supernodes.list().front().n_columns, 8U);
  expect_solves(factor, "arrow");
}

TEST(Supernodes, ACouplingOfTwoPartsKeepsThemApart) {
  Couplings couplings = all_of(0, 3);
  for (const auto& pair : all_of(3, 6)) couplings.push_back(pair);
  for (const int i : {0, 1, 2, 3, 4, 5}) couplings.emplace_back(i, 6);
  const Factor factor(7, couplings);
  ASSERT_GE(factor.supernodes.list().size(), 2U);
  EXPECT_EQ(factor.supernodes.list()[0].n_columns, 3U);
  expect_solves(factor, "two parts");
}

TEST(Supernodes, FactorsOfRandomMeshesAreSolved) {
  std::mt19937 random(3);
  for (int n : {30, 100, 400}) {
    Couplings couplings;
    for (int i = 0; i + 1 < n; ++i)
      couplings.emplace_back(i, i + 1 + static_cast<int>(random() % std::min(9, n - 1 - i)));
    for (int i = 0; i < 2 * n; ++i) {
      const int a = static_cast<int>(random() % n), b = static_cast<int>(random() % n);
      if (a != b) couplings.emplace_back(a, b);
    }
    expect_solves(Factor(n, couplings), "random");
  }
}

}  // namespace
}  // namespace rotordrop
