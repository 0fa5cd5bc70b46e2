#include "base/row_store.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

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
    : row_size_(row_size), block_rows_(rows_of_block(row_size, tile_rows)), staged_(tile_rows * row_size) {}

void RowStore::append(std::span<const double> row) {
  if (row.size() != row_size_) throw std::invalid_argument("RowStore: a row of another size");
  if (n_staged_ + 1 == tile_rows) reserve(tile_rows);
  std::copy(row.begin(), row.end(), staged_.begin() + static_cast<std::ptrdiff_t>(n_staged_ * row_size_));
  if (++n_staged_ == tile_rows) store_staged();
}

void RowStore::append(const RowTile& rows) {
  if (rows.row_size != row_size_) throw std::invalid_argument("RowStore: rows of another size");
  reserve(n_staged_ + rows.n_rows());
  store_staged();
  store(rows.n_rows(), [&](std::size_t column, std::size_t first, std::size_t n, double* to) {
    const double* from = rows.values + column * RowTile::width + first;
    if (n == tile_rows)
      std::memcpy(to, from, tile_rows * sizeof(double));
    else
      std::copy_n(from, n, to);
  });
}

void RowStore::store_staged() {
  const std::size_t n_rows = std::exchange(n_staged_, 0);
  store(n_rows, [&](std::size_t column, std::size_t first, std::size_t n, double* to) {
    const double* from = staged_.data() + first * row_size_ + column;
    for (std::size_t r = 0; r < n; ++r) to[r] = from[r * row_size_];
  });
}

void RowStore::reserve(std::size_t n_rows) {
  while (blocks_.size() * block_rows_ < n_stored_ + n_rows) blocks_.push_back(pool_.take(row_size_ * stride()));
}

template <class Put>
void RowStore::store(std::size_t n_rows, const Put& put) {
  for (std::size_t done = 0; done < n_rows;) {
    const std::size_t block = n_stored_ / block_rows_, at = n_stored_ % block_rows_;
    const std::size_t n = std::min(n_rows - done, block_rows_ - at);
    double* to = blocks_[block] + at;
    for (std::size_t column = 0; column < row_size_; ++column, to += stride()) put(column, done, n, to);
    n_stored_ += n;
    done += n;
  }
}

void RowStore::copy(std::size_t first, std::size_t size, double* out) const {
  for (std::size_t k = 0; k < size; ++k) {
    double* to = out + k;
    for (std::size_t done = 0; done < n_stored_; done += block_rows_) {
      const double* column = blocks_[done / block_rows_] + (first + k) * stride();
      const std::size_t n = std::min(block_rows_, n_stored_ - done);
      if (size == 1) {
        to = std::copy_n(column, n, to);
        continue;
      }
      for (std::size_t r = 0; r < n; ++r, to += size) *to = column[r];
    }
    for (std::size_t r = 0; r < n_staged_; ++r, to += size) *to = staged_[r * row_size_ + first + k];
  }
}

}  // namespace rotordrop
