#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace rotordrop {

/// Rows of numbers that come one by one and are read column by column: kept in blocks, column after column. A block is one large page of memory where
/// the system has such: thousands of small ones, each given at its first touch, took a tenth of a drop's time.
class RowStore {
 public:
  explicit RowStore(std::size_t row_size = 0);

  /// @param row [row_size()]
  void append(std::span<const double> row);
  [[nodiscard]] std::size_t row_size() const { return row_size_; }
  [[nodiscard]] std::size_t n_rows() const { return n_rows_; }
  [[nodiscard]] std::size_t bytes() const { return n_rows_ * row_size_ * sizeof(double); }
  /// Values of neighbouring columns, row after row. @param out [n_rows(), size]
  void copy(std::size_t first, std::size_t size, double* out) const;
  /// Forgets all rows and keeps the memory for others.
  void clear() { n_rows_ = 0; }

 private:
  static constexpr std::size_t tile_rows = 8;  // a line of the cache for each column
  struct Free {
    void operator()(double* block) const;
  };
  /// Of columns in a block. Multiples of a page would put all lines of a tile into the same few places of the cache.
  [[nodiscard]] std::size_t stride() const { return block_rows_ % 64 == 0 ? block_rows_ + tile_rows : block_rows_; }
  [[nodiscard]] std::size_t block_bytes() const { return row_size_ * stride() * sizeof(double); }
  void store_tile();

  std::size_t row_size_ = 0, block_rows_ = 0, n_rows_ = 0;
  std::vector<double> tile_;                             // rows that are in no block yet [tile_rows, row_size]
  std::vector<std::unique_ptr<double[], Free>> blocks_;  // [row_size, stride()]
};

}  // namespace rotordrop
