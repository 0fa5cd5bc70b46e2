#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "base/number_pool.h"
#include "base/row_tile.h"

namespace rotordrop {

/// Rows of numbers that come one by one, or several side by side, and are read column by column: kept in blocks that stay in the processor's cache while they fill, column after column.
class RowStore {
 public:
  explicit RowStore(std::size_t row_size = 0);

  /// Where there is no room left, the store stays as it was. @param row [row_size()] @throws std::bad_alloc
  void append(std::span<const double> row);
  void append(const RowTile& rows);
  [[nodiscard]] std::size_t row_size() const { return row_size_; }
  [[nodiscard]] std::size_t n_rows() const { return n_stored_ + n_staged_; }
  [[nodiscard]] std::size_t bytes() const { return n_rows() * row_size_ * sizeof(double); }
  /// Values of neighbouring columns, row after row. @param out [n_rows(), size]
  void copy(std::size_t first, std::size_t size, double* out) const;
  /// Forgets all rows and keeps the memory for others.
  void clear() { n_stored_ = n_staged_ = 0; }

 private:
  static constexpr std::size_t tile_rows = RowTile::width;  // a line of the cache for each column
  /// Of columns in a block. Multiples of a page would put all lines of a tile into the same few places of the cache.
  [[nodiscard]] std::size_t stride() const { return block_rows_ % 64 == 0 ? block_rows_ + tile_rows : block_rows_; }
  void store_staged();
  /// Has blocks for so many more rows.
  void reserve(std::size_t n_rows);
  /// Puts rows into blocks. @param put  (column, first, n, to): n of its values from row `first` on
  template <class Put>
  void store(std::size_t n_rows, const Put& put);

  std::size_t row_size_ = 0, block_rows_ = 0;
  std::size_t n_stored_ = 0, n_staged_ = 0;  // rows in blocks, and those that wait
  std::vector<double> staged_;               // [tile_rows, row_size]
  NumberPool pool_;
  std::vector<double*> blocks_;  // [row_size, stride()]
};

}  // namespace rotordrop
