#pragma once
// A circumference cut into cells, and what a moving band leaves in each.
#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <vector>

#include "base/wide_vectors.h"

namespace rotordrop {

/// A band of the length 2 b whose middle goes evenly from one angle to the other [rad].
struct SweptBand {
  double low, high, half_angle;
};

/// Cells that lie one after another around the circumference; numbers beyond the last cell are those of further turns.
struct CellRange {
  long first;
  std::size_t n;
  /// The first one as one of so many cells.
  [[nodiscard]] std::size_t first_of(std::size_t n_cells) const {
    const auto count = static_cast<long>(n_cells);
    return static_cast<std::size_t>(((first % count) + count) % count);
  }
};
CellRange cells_under(const SweptBand& band, double cell_angle);

/// Heat of a swept band that is cut across its length into pieces of equal length, each of which gives off its own.
struct PiecesOfBand {
  /// Of the pieces from the lower angle up [J], of one list of them after another [n_lists][n_pieces].
  const double* heat;
  std::size_t n_pieces, n_lists;
};
/// What falls on each cell of a range that holds all cells under the band; of each list the cells' sum is that of its pieces.
/// A piece is a band of its own. Length of a band below the angle c, summed over the way of its middle p and divided by 2 b times the way:
///   integral of [r(c - p + b) - r(c - p - b)] dp,  r(x) = max(x, 0), whose integral is r^2/2.
/// @param into  [n_lists][stride] [J]: of cells of the range in their order
/// @param stride  whole vectors (vector_length), range.n at least
void spread_pieces(const SweptBand& band, const PiecesOfBand& pieces, double cell_angle, const CellRange& range,
                   std::size_t stride, double* into);

/// Divides what a band gives off evenly over its length 2 b while its middle goes evenly from one angle to the other [rad]; any number of turns.
/// @param half_angle  b over the radius [rad], > 0; a band that reaches round covers all
/// @param give        called with a cell's index and its share; the shares' sum is 1. A cell may be called more than once.
template <class Give>
void spread_over_cells(std::size_t n_cells, double from, double to, double half_angle, Give&& give) {
  using std::numbers::pi;
  const double cell_angle = 2. * pi / static_cast<double>(n_cells), b = std::min(half_angle, pi);
  const SweptBand band{std::min(from, to), std::max(from, to), b};
  const CellRange range = cells_under(band, cell_angle);
  std::array<double, 64> few;
  std::vector<double> many;
  const std::size_t stride = filled_up(range.n);
  if (stride > few.size()) many.resize(stride);
  double* const shares = many.empty() ? few.data() : many.data();
  const double whole = 1.;
  spread_pieces(band, {&whole, 1, 1}, cell_angle, range, stride, shares);
  std::size_t cell = range.first_of(n_cells);
  for (std::size_t i = 0; i < range.n; ++i, cell = cell + 1 == n_cells ? 0 : cell + 1)
    if (shares[i] > 0.) give(cell, shares[i]);
}

}  // namespace rotordrop
