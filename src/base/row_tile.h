#pragma once
#include <cstddef>
#include <span>

namespace rotordrop {

/// Up to eight rows of numbers side by side.
struct RowTile {
  static constexpr std::size_t width = 8;
  std::span<const double> times;   ///< of the rows, 1 to 8 [s]
  const double* values = nullptr;  ///< number k of row i stands at [k * width + i]
  std::size_t row_size = 0;        ///< numbers of a row

  [[nodiscard]] std::size_t n_rows() const { return times.size(); }
  [[nodiscard]] RowTile part(std::size_t first, std::size_t n) const {
    return {times.subspan(first, n), values + first, row_size};
  }
  /// @param out  [row_size]
  void copy_row(std::size_t row, std::span<double> out) const {
    for (std::size_t k = 0; k < row_size; ++k) out[k] = values[k * width + row];
  }
};

}  // namespace rotordrop
