#include "laws/arc_cells.h"

#include "base/wide_vectors.h"

namespace rotordrop {
namespace {

ROTORDROP_KERNEL void cover(const SweptBand& band, double cell_angle, double first, std::size_t n, double* below) {
  const double b = band.half_angle, low = band.low, way = band.high - low, high = band.high;
  const bool rests = way < 1e-7 * b;
  const double per_way = rests ? 0. : 0.5 / way, per_length = 0.5 / b, middle = 0.5 * (low + high);
  // (r(x - low)^2 - r(x - high)^2) / (2 way), without the difference of squares
  const auto ramp = [&](double x) {
    const double at_low = std::max(x - low, 0.), at_high = std::max(x - high, 0.);
    return rests ? std::max(x - middle, 0.) : std::min(at_low, way) * (at_low + at_high) * per_way;
  };
#pragma omp simd
  for (std::size_t k = 0; k < n; ++k) {
    const double x = (first + static_cast<double>(k)) * cell_angle;
    below[k] = (ramp(x + b) - ramp(x - b)) * per_length;
  }
}

}  // namespace

void cover_cells(const SweptBand& band, double cell_angle, double first, std::span<double> below) {
  wide<cover>(band, cell_angle, first, below.size(), below.data());
}

}  // namespace rotordrop
