#include "laws/arc_cells.h"

#include <numeric>

#include "base/real.h"

namespace rotordrop {
namespace {

/// Part of a piece's heat that falls below a cell's far edge, as if the piece went on without end: (r(u)^2 - r(u - way)^2) / (2 way length), r(x) = max(x, 0). The
/// edge lies u beyond where the piece begins. Written without the difference of squares. A band at rest goes a ten-millionth of its length.
struct Ramp {
  double start, length, way, scale;
  ROTORDROP_KERNEL Ramp(const SweptBand& band, std::size_t n_pieces) {
    length = 2. * band.half_angle / static_cast<double>(n_pieces);
    way = std::max(band.high - band.low, 1e-7 * band.half_angle);
    start = 0.5 * (band.low + band.high - way) - band.half_angle;
    scale = 0.5 / (way * length);
  }
  ROTORDROP_KERNEL double operator()(double u) const {
    const double within = smaller(larger(u, 0.), way);
    return within * (u + (u - within)) * scale;
  }
};

/// Far edges of cells.
struct Edges {
  double first, cell_angle;
  [[nodiscard]] ROTORDROP_KERNEL double operator[](std::size_t i) const {
    return (first + static_cast<double>(i + 1)) * cell_angle;
  }
};

/// From what falls below the far edge of each cell to what falls on the cell; all of it below the last.
ROTORDROP_KERNEL void take_differences(std::size_t n, double all, double* cells) {
  cells[n - 1] = all;
#pragma omp simd
  for (std::size_t i = n - 1; i > 0; --i) cells[i] -= cells[i - 1];
}

/// A band in one piece: every list gets the same shares of its heat.
ROTORDROP_KERNEL void spread_whole(const SweptBand& band, const PiecesOfBand& pieces, const Edges& given, std::size_t n,
                                   std::size_t stride, double* into) {
  const Edges edges = given;  // copies that no store can change
  const PiecesOfBand lists = pieces;
  const Ramp ramp(band, 1);
#pragma omp simd
  for (std::size_t i = 0; i < whole_vectors(stride); ++i) {
    const double u = edges[i] - ramp.start;
    into[i] = ramp(u) - ramp(u - ramp.length);
  }
  take_differences(n, 1., into);
  for (std::size_t list = lists.n_lists; list-- > 0;) {
    const double heat = lists.heat[list];
    double* const cells = into + list * stride;
#pragma omp simd
    for (std::size_t i = 0; i < whole_vectors(stride); ++i) cells[i] = heat * into[i];
  }
}

/// Some lists at once. A piece's part is the difference of the ramps that start at its ends.
/// @param heat  [n_lists][n_pieces]
template <std::size_t n_lists>
ROTORDROP_KERNEL void spread_lists(const SweptBand& band, const double* heat, std::size_t n_pieces, const Edges& given,
                                   std::size_t n, std::size_t stride, double* into) {
  const Edges edges = given;
  const Ramp ramp(band, n_pieces);
  for (std::size_t at = 0; at < stride; at += vector_length) {
    double u[vector_length], before[vector_length], sums[n_lists][vector_length] = {};
#pragma omp simd
    for (std::size_t i = 0; i < vector_length; ++i) {
      u[i] = edges[at + i] - ramp.start;
      before[i] = ramp(u[i]);
    }
    for (std::size_t k = 0; k < n_pieces; ++k) {
      const double end = static_cast<double>(k + 1) * ramp.length;
#pragma omp simd
      for (std::size_t i = 0; i < vector_length; ++i) {
        const double here = ramp(u[i] - end), share = before[i] - here;
        before[i] = here;
#pragma GCC unroll 4
        for (std::size_t list = 0; list < n_lists; ++list) sums[list][i] += heat[list * n_pieces + k] * share;
      }
    }
#pragma GCC unroll 4
    for (std::size_t list = 0; list < n_lists; ++list)
#pragma omp simd
      for (std::size_t i = 0; i < vector_length; ++i) into[list * stride + at + i] = sums[list][i];
  }
  for (std::size_t list = 0; list < n_lists; ++list)
    take_differences(n, std::accumulate(heat + list * n_pieces, heat + (list + 1) * n_pieces, 0.),
                     into + list * stride);
}

}  // namespace

CellRange cells_under(const SweptBand& band, double cell_angle) {
  const double per_angle = 1. / cell_angle;
  const auto cell_at = [&](double angle) {
    const double place = angle * per_angle;
    const auto towards_zero = static_cast<long>(place);
    return towards_zero - (static_cast<double>(towards_zero) > place ? 1 : 0);
  };
  const long first = cell_at(band.low - band.half_angle), last = cell_at(band.high + band.half_angle);
  return {first, static_cast<std::size_t>(last - first + 1)};
}

void spread_pieces(const SweptBand& band, const PiecesOfBand& pieces, double cell_angle, const CellRange& range,
                   std::size_t stride, double* into) {
  const Edges edges{static_cast<double>(range.first), cell_angle};
  if (pieces.n_pieces == 1) return wide<spread_whole>(band, pieces, edges, range.n, stride, into);
  constexpr std::size_t at_once = 3;
  for (std::size_t list = 0; list < pieces.n_lists; list += at_once) {
    const double* const heat = pieces.heat + list * pieces.n_pieces;
    double* const cells = into + list * stride;
    switch (pieces.n_lists - list) {
      case 1:
        wide<spread_lists<1>>(band, heat, pieces.n_pieces, edges, range.n, stride, cells);
        break;
      case 2:
        wide<spread_lists<2>>(band, heat, pieces.n_pieces, edges, range.n, stride, cells);
        break;
      default:
        wide<spread_lists<at_once>>(band, heat, pieces.n_pieces, edges, range.n, stride, cells);
    }
  }
}

}  // namespace rotordrop
