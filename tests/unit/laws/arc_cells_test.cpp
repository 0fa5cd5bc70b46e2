// What a moving band leaves in the cells of a circumference.
#include "laws/arc_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace {

using namespace rotordrop;
using std::numbers::pi;

// At rest each cell gets the part of the band that lies in it.
TEST(ArcCells, LieUnderTheBand) {
  const std::size_t n_cells = 100;
  const double cell_angle = 2. * pi / static_cast<double>(n_cells), half_angle = 0.11;
  for (const double middle : {-20., -0.3, -0.1, 0.02, 0.4, 20.}) {
    std::vector<double> got(n_cells), expected(n_cells);
    spread_over_cells(n_cells, middle, middle, half_angle, [&](std::size_t cell, double share) { got[cell] += share; });
    for (long i = -400; i < 400; ++i) {
      const double low = std::max(static_cast<double>(i) * cell_angle, middle - half_angle);
      const double high = std::min(static_cast<double>(i + 1) * cell_angle, middle + half_angle);
      expected[static_cast<std::size_t>(i + 400) % n_cells] += std::max(high - low, 0.) / (2. * half_angle);
    }
    // The band goes a ten-millionth of its length, so that no formula divides by its way.
    for (std::size_t cell = 0; cell < n_cells; ++cell) EXPECT_NEAR(got[cell], expected[cell], 1e-7) << middle;
  }
}

// A band in pieces leaves what its pieces leave one by one, each as a band of its own.
TEST(ArcCells, PiecesOfABandLieSideBySide) {
  std::vector<double> heat;  // of the second list twice as much, and so on
  for (int k = 0; k < 20; ++k) heat.push_back(3. * std::sin(1. + k));
  const std::size_t n = heat.size(), n_cells = 100;
  const double cell_angle = 2. * pi / static_cast<double>(n_cells), half_angle = 0.2;
  for (const double way : {0., 1e-3, 0.3, 9.})
    for (const std::size_t n_lists : {1u, 2u, 3u, 7u}) {
      const SweptBand band{1., 1. + way, half_angle};
      const CellRange range = cells_under(band, cell_angle);
      const std::size_t stride = (range.n + 7) / 8 * 8;
      std::vector<double> all, found(n_lists * stride), expected(n_cells), folded(n_cells);
      for (std::size_t list = 1; list <= n_lists; ++list)
        for (const double joules : heat) all.push_back(static_cast<double>(list) * joules);
      spread_pieces(band, {all.data(), n, n_lists}, cell_angle, range, stride, found.data());
      for (std::size_t k = 0; k < n; ++k) {
        const double half = half_angle / static_cast<double>(n),
                     at = 1. - half_angle + (2. * static_cast<double>(k) + 1.) * half;
        spread_over_cells(n_cells, at, at + way, half,
                          [&](std::size_t cell, double share) { expected[cell] += share * heat[k]; });
      }
      for (std::size_t i = 0; i < range.n; ++i) {
        folded[(static_cast<std::size_t>(range.first) + i) % n_cells] += found[i];
        for (std::size_t list = 1; list < n_lists; ++list)
          EXPECT_NEAR(found[list * stride + i], static_cast<double>(list + 1) * found[i], 1e-12);
      }
      for (std::size_t cell = 0; cell < n_cells; ++cell) EXPECT_NEAR(folded[cell], expected[cell], 1e-12) << way;
    }
}

TEST(ArcCells, ShareOutExactlyOneOverAnyWay) {
  for (const double way : {0., 1e-12, 0.01, 1., 20.}) {
    std::vector<double> got(100);
    spread_over_cells(100, -0.4, way - 0.4, 0.05, [&](std::size_t cell, double share) { got[cell] += share; });
    EXPECT_NEAR(std::accumulate(got.begin(), got.end(), 0.), 1., 1e-14) << way;
  }
}

}  // namespace
