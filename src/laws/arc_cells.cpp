#include "laws/arc_cells.h"

namespace rotordrop {
namespace {

/// (r(x - low)^2 - r(x - high)^2) / (2 way), r(x) = max(x, 0), without the difference of squares. A band at rest goes a ten-millionth of its length.
struct Ramp {
  double low, way, high, per_way;
  ROTORDROP_KERNEL explicit Ramp(const SweptBand& band) {
    way = std::max(band.high - band.low, 1e-7 * band.half_angle);
    low = 0.5 * (band.low + band.high - way);
    high = low + way;
    per_way = 0.5 / way;
  }
  ROTORDROP_KERNEL double operator()(double x) const {
    const double at_low = std::max(x - low, 0.), at_high = std::max(x - high, 0.);
    return std::min(at_low, way) * (at_low + at_high) * per_way;
  }
};

/// What falls below the far edge of each cell, all of it below the last; then what falls on the cell. A piece's part is the difference of the ramps that
/// start at its ends.
ROTORDROP_KERNEL void spread(const SweptBand& band, const PiecesOfBand& pieces, double cell_angle, double first,
                             std::size_t n, std::size_t stride, double* into) {
  constexpr std::size_t at_once = 16;
  const Ramp ramp(band);
  const double b = band.half_angle, length = 2. * b / static_cast<double>(pieces.n_pieces), per_length = 1. / length;
  for (std::size_t at = 0; at < n; at += vector_length) {
    const double edge = first + static_cast<double>(at + 1);
    Octet x, before;
#pragma omp simd
    for (std::size_t i = 0; i < vector_length; ++i) {
      x[i] = (edge + static_cast<double>(i)) * cell_angle + b;
      before[i] = ramp(x.value[i]) * per_length;
    }
    for (std::size_t done = 0; done < pieces.n_pieces; done += at_once) {
      double shares[at_once][vector_length];
      const std::size_t n_here = std::min(at_once, pieces.n_pieces - done);
      for (std::size_t piece = 0; piece < n_here; ++piece) {
        const double end = static_cast<double>(done + piece + 1) * length;
#pragma omp simd
        for (std::size_t i = 0; i < vector_length; ++i) {
          const double here = ramp(x.value[i] - end) * per_length;
          shares[piece][i] = before.value[i] - here;
          before[i] = here;
        }
      }
      for (std::size_t list = 0; list < pieces.n_lists; ++list) {
        Octet sum;
        double* const cells = into + list * stride + at;
        if (done > 0) add_product(sum, 1., cells);
        for (std::size_t piece = 0; piece < n_here; ++piece)
          add_product(sum, pieces.heat[list * pieces.n_pieces + done + piece], shares[piece]);
#pragma omp simd
        for (std::size_t i = 0; i < vector_length; ++i) cells[i] = sum.value[i];
      }
    }
  }
  for (std::size_t list = 0; list < pieces.n_lists; ++list) {
    double* const cells = into + list * stride;
    cells[n - 1] = 0.;
    for (std::size_t piece = 0; piece < pieces.n_pieces; ++piece)
      cells[n - 1] += pieces.heat[list * pieces.n_pieces + piece];
    for (std::size_t i = n; --i > 0;) cells[i] -= cells[i - 1];
  }
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
  wide<spread>(band, pieces, cell_angle, static_cast<double>(range.first), range.n, stride, into);
}

}  // namespace rotordrop
