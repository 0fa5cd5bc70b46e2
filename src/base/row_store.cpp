#include "base/row_store.h"

#include <algorithm>
#include <stdexcept>

namespace rotordrop {
namespace {

/// Rows of a block that stays in the processor's cache.
std::size_t rows_of_block(std::size_t row_size, std::size_t tile_rows) {
  constexpr std::size_t block_bytes = 100'000, most_rows = 1024;
  const std::size_t fit = block_bytes / (sizeof(double) * std::max<std::size_t>(row_size, 1));
  return std::clamp(fit / tile_rows * tile_rows, tile_rows, most_rows);
}

}  // namespace

RowStore::RowStore(std::size_t row_size)
    : row_size_(row_size), block_rows_(rows_of_block(row_size, tile_rows)), tile_(tile_rows * row_size) {}

void RowStore::append(std::span<const double> row) {
  if (row.size() != row_size_) throw std::invalid_argument("RowStore: a row of another size");
  const std::size_t in_tile = n_rows_ % tile_rows;
  std::copy(row.begin(), row.end(), tile_.begin() + static_cast<std::ptrdiff_t>(in_tile * row_size_));
  ++n_rows_;
  if (in_tile + 1 == tile_rows) store_tile();
}

void RowStore::store_tile() {
  const std::size_t first = n_rows_ - tile_rows, block = first / block_rows_;
  if (block == blocks_.size()) blocks_.push_back(pool_.take(row_size_ * stride()));
  double* column = blocks_[block] + first % block_rows_;
  const double* from = tile_.data();
  for (std::size_t k = 0; k < row_size_; ++k, column += stride(), ++from)
    for (std::size_t r = 0; r < tile_rows; ++r) column[r] = from[r * row_size_];
}

void RowStore::copy(std::size_t first, std::size_t size, double* out) const {
  const std::size_t in_blocks = n_rows_ / tile_rows * tile_rows;
  for (std::size_t k = 0; k < size; ++k) {
    double* to = out + k;
    for (std::size_t done = 0; done < in_blocks; done += block_rows_) {
      const double* column = blocks_[done / block_rows_] + (first + k) * stride();
      const std::size_t n = std::min(block_rows_, in_blocks - done);
      if (size == 1) {
        to = std::copy_n(column, n, to);
        continue;
      }
      for (std::size_t r = 0; r < n; ++r, to += size) *to = column[r];
    }
    for (std::size_t r = 0; r < n_rows_ - in_blocks; ++r, to += size) *to = tile_[r * row_size_ + first + k];
  }
}

}  // namespace rotordrop
