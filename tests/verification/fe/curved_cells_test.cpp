// Integrals over cells whose properties depend on temperature, eight cells at a time, against the same sums cell by cell.
#include "thermal/fe/curved_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace rotordrop;

PropertyTable random_table(std::mt19937& random, std::size_t n_points) {
  std::uniform_real_distribution<double> step(5., 60.), value(1., 3.);
  std::vector<std::array<double, 2>> points = {{300., value(random)}};
  while (points.size() < n_points) points.push_back({points.back()[0] + step(random), value(random)});
  return PropertyTable(points);
}

struct Cell {
  const HeatBody* body;
  std::vector<unsigned int> unknowns;
  std::vector<double> weights;
  std::vector<std::array<double, 3>> metrics;
};

/// Cells of two bodies in turn, with random shapes, weights and metrics; temperatures below, within and above the tables.
struct Example {
  std::mt19937 random{11};
  std::vector<HeatBody> bodies{2};
  CellShapes shapes;
  std::vector<Cell> list;
  std::vector<double> T, T_before;

  Example(std::size_t degree, std::size_t n_cells, std::size_t n_points_of_k, std::size_t n_points_of_c) {
    std::uniform_real_distribution<double> number(-1., 1.), temperature(250., 500.);
    const std::size_t n = shapes.n = (degree + 1) * (degree + 1), n_unknowns = 3 * n_cells;
    for (auto* values : {&shapes.value, &shapes.x, &shapes.r})
      for (std::size_t i = 0; i < n * n; ++i) values->push_back(number(random));
    // Means of the unknowns' temperatures, so that those at points lie about the tables, too.
    for (std::size_t q = 0; q < n; ++q) {
      double sum = 0.;
      for (std::size_t i = 0; i < n; ++i) sum += shapes.value[q * n + i] += 2.;
      for (std::size_t i = 0; i < n; ++i) shapes.value[q * n + i] /= sum;
    }
    for (HeatBody& body : bodies) {
      body.density = 3. + number(random);
      body.conductivity = random_table(random, n_points_of_k);
      body.heat_capacity = random_table(random, n_points_of_c);
    }
    std::uniform_int_distribution<unsigned int> unknown(0, static_cast<unsigned int>(n_unknowns) - 1);
    for (std::size_t c = 0; c < n_cells; ++c) {
      Cell cell{&bodies[c % 3 == 0 ? 1 : 0], {}, {}, {}};
      for (std::size_t i = 0; i < n; ++i) {
        cell.unknowns.push_back(unknown(random));
        cell.weights.push_back(1.5 + number(random));
        cell.metrics.push_back({number(random), number(random), number(random)});
      }
      list.push_back(cell);
    }
    for (std::size_t i = 0; i < n_unknowns; ++i) {
      T.push_back(temperature(random));
      T_before.push_back(temperature(random));
    }
  }
  [[nodiscard]] CurvedCells cells() const {
    CurvedCells made(shapes);
    for (const Cell& c : list) made.add(*c.body, {c.unknowns, c.weights, c.metrics});
    return made;
  }
  /// What the cells add to ones.
  [[nodiscard]] std::vector<double> enthalpies() const {
    std::vector<double> out(T.size(), 1.);
    cells().add_enthalpy(T.data(), T_before.data(), out.data());
    return out;
  }
  [[nodiscard]] std::vector<double> flows() const {
    std::vector<double> out(T.size(), 1.);
    cells().subtract_conduction(T.data(), out.data());
    return out;
  }

  [[nodiscard]] double at(const std::vector<double>& values, const std::vector<double>& of, const Cell& cell,
                          std::size_t q) const {
    double sum = 0.;
    for (std::size_t i = 0; i < shapes.n; ++i) sum += values[q * shapes.n + i] * of[cell.unknowns[i]];
    return sum;
  }
  [[nodiscard]] std::vector<double> enthalpies_by_cell() const {
    std::vector<double> out(T.size(), 1.);
    for (const Cell& c : list)
      for (std::size_t q = 0; q < shapes.n && !c.body->heat_capacity.is_constant(); ++q)
        for (std::size_t i = 0; i < shapes.n; ++i)
          out[c.unknowns[i]] +=
              shapes.value[q * shapes.n + i] * c.weights[q] * c.body->density *
              c.body->heat_capacity.integral(at(shapes.value, T_before, c, q), at(shapes.value, T, c, q));
    return out;
  }
  [[nodiscard]] std::vector<double> flows_by_cell() const {
    std::vector<double> out(T.size(), 1.);
    for (const Cell& c : list)
      for (std::size_t q = 0; q < shapes.n && !c.body->conductivity.is_constant(); ++q) {
        const double k = c.body->conductivity.value(at(shapes.value, T, c, q)) * c.weights[q];
        const double x = at(shapes.x, T, c, q), r = at(shapes.r, T, c, q);
        const auto& [xx, xr, rr] = c.metrics[q];
        for (std::size_t i = 0; i < shapes.n; ++i)
          out[c.unknowns[i]] -=
              k * (shapes.x[q * shapes.n + i] * (xx * x + xr * r) + shapes.r[q * shapes.n + i] * (xr * x + rr * r));
      }
    return out;
  }
};

void expect_same(const std::vector<double>& found, const std::vector<double>& expected) {
  double scale = 0.;
  for (const double value : expected) scale = std::max(scale, std::fabs(value));
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-13 * scale) << i;
}

TEST(CurvedCells, SumAsCellByCell) {
  for (const std::size_t degree : {1u, 2u, 3u, 4u})
    for (const std::size_t n_points : {1u, 2u, 7u}) {
      const Example e(degree, 29, n_points, 8 - n_points);
      expect_same(e.enthalpies(), e.enthalpies_by_cell());
      expect_same(e.flows(), e.flows_by_cell());
    }
}

// Newton's iteration ends at changes of 1e-10 K: their joules must have digits of their own.
TEST(CurvedCells, SmallChangesOfTemperatureLoseNoDigits) {
  Example e(2, 8, 3, 3);
  constexpr double change = 0x1p-33;  // [K], exact beside 320 K
  e.T.assign(e.T.size(), 320.);
  e.T_before.assign(e.T.size(), 320. - change);
  double joules = 0., expected = 0.;
  for (const double value : e.enthalpies()) joules += value - 1.;
  for (const Cell& c : e.list)
    for (const double weight : c.weights)
      expected += c.body->density * c.body->heat_capacity.value(320.) * change * weight;
  EXPECT_NEAR(joules, expected, 3e-3 * expected);  // roundoff of temperatures at points: some 1e-13 K
}

TEST(CurvedCells, WhatIsNotANumberGoesOn) {
  Example e(2, 9, 3, 3);
  const unsigned int bad = e.list[4].unknowns[3];
  e.T[bad] = std::nan("");
  EXPECT_TRUE(std::isnan(e.enthalpies()[bad]));
  EXPECT_TRUE(std::isnan(e.flows()[bad]));
}

}  // namespace
