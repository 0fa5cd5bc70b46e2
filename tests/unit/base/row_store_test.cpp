// Rows come back as columns: of sizes that fill no tile and no block, and after the store was cleared.
#include "base/row_store.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <span>
#include <stdexcept>
#include <vector>

#include "base/memory.h"

namespace rotordrop {
namespace {

double value(std::size_t row, std::size_t column) {
  return 1e4 * static_cast<double>(row) + static_cast<double>(column);
}

void fill(RowStore& store, std::size_t n_rows, std::size_t first) {
  std::vector<double> row(store.row_size());
  for (std::size_t i = 0; i < n_rows; ++i) {
    for (std::size_t k = 0; k < row.size(); ++k) row[k] = value(first + i, k);
    store.append(row);
  }
}

void expect_rows(const RowStore& store, std::size_t n_rows, std::size_t first_row) {
  ASSERT_EQ(store.n_rows(), n_rows);
  const std::size_t n = store.row_size();
  for (const auto& [first, size] :
       {std::pair<std::size_t, std::size_t>{0, 1}, {n / 2, n - n / 2}, {n - 1, 1}, {0, n}}) {
    std::vector<double> out(n_rows * size + 1, -1.);
    store.copy(first, size, out.data());
    EXPECT_EQ(out.back(), -1.) << "nothing behind";
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < n_rows; ++i)
      for (std::size_t k = 0; k < size; ++k)
        if (out[i * size + k] != value(first_row + i, first + k)) ++wrong;
    EXPECT_EQ(wrong, 0U) << n_rows << " rows of " << n << ", " << size << " columns from " << first;
  }
}

TEST(RowStore, GivesBackColumns) {
  // 300 values: blocks of 40 rows; 40 000: of a single tile.
  for (const std::size_t row_size : {1U, 3U, 7U, 300U, 40000U}) {
    RowStore store(row_size);
    expect_rows(store, 0, 0);
    const std::size_t most = row_size > 1000 ? 30 : 2500;
    std::size_t n = 0;
    for (const std::size_t more : {1UL, 6UL, 1UL, 9UL, most}) {
      fill(store, more, n);
      n += more;
      expect_rows(store, n, 0);
    }
    EXPECT_EQ(store.bytes(), n * row_size * sizeof(double));
    store.clear();
    fill(store, 13, 7);
    expect_rows(store, 13, 7);
  }
}

/// The same rows side by side, in tiles of at most n rows.
void fill_by_tiles(RowStore& store, std::size_t n_rows, std::size_t first, std::size_t n) {
  const std::vector<double> times(RowTile::width);
  std::vector<double> values(store.row_size() * RowTile::width);
  for (std::size_t i = 0; i < n_rows; i += n) {
    const std::size_t now = std::min(n, n_rows - i);
    for (std::size_t k = 0; k < store.row_size(); ++k)
      for (std::size_t r = 0; r < now; ++r) values[k * RowTile::width + r] = value(first + i + r, k);
    store.append(RowTile{std::span(times).first(now), values.data(), store.row_size()});
  }
}

TEST(RowStore, TakesRowsSideBySideAsOneByOne) {
  for (const std::size_t row_size : {1U, 7U, 300U, 40000U}) {
    RowStore store(row_size);
    const std::size_t most = row_size > 1000 ? 30 : 2500;
    std::size_t n = 0;
    const auto add = [&](std::size_t more, std::size_t at_once) {
      at_once == 1 ? fill(store, more, n) : fill_by_tiles(store, more, n, at_once);
      n += more;
      expect_rows(store, n, 0);
    };
    add(24, 8);  // whole lines
    add(3, 1);   // rows that wait
    add(8, 8);   // behind them, over the end of a line, and of a block
    add(1, 1);
    add(most, 8);
    add(10, 5);
    add(17, 1);
    add(most, 3);
    store.clear();
    n = 0;
    add(9, 8);
  }
}

TEST(RowTile, IsCutAndReadByRows) {
  const std::vector<double> times = {1., 2., 3., 4.};
  std::vector<double> values(2 * RowTile::width), row(2);
  for (std::size_t r = 0; r < times.size(); ++r) {
    values[r] = 10. * times[r];
    values[RowTile::width + r] = 100. * times[r];
  }
  const RowTile middle = RowTile{times, values.data(), 2}.part(1, 2);
  EXPECT_EQ(middle.n_rows(), 2U);
  EXPECT_EQ(middle.times[1], 3.);
  middle.copy_row(1, row);
  EXPECT_EQ(row, (std::vector<double>{30., 300.}));
}

#if !defined(__SANITIZE_ADDRESS__)
/// The process may have so many bytes more; then as many as before.
class MemoryLimit {
 public:
  explicit MemoryLimit(std::uint64_t more) {
    ::getrlimit(RLIMIT_AS, &before_);
    rlimit tight = before_;
    tight.rlim_cur = own_memory() + more;
    ::setrlimit(RLIMIT_AS, &tight);
  }
  ~MemoryLimit() { ::setrlimit(RLIMIT_AS, &before_); }

 private:
  rlimit before_{};
};

TEST(RowStore, KeepsWhatItHasWhereThereIsNoRoomForMore) {
  for (const std::size_t at_once : {1U, 3U, 8U}) {
    RowStore store(3000);  // blocks of a tile, 192 kB
    std::size_t n = 0;
    bool is_refused = false;
    {
      const MemoryLimit limit(20'000'000);
      while (!is_refused && n < 100'000) try {
          at_once == 1 ? fill(store, 1, n) : fill_by_tiles(store, at_once, n, at_once);
          n += at_once;
        } catch (const std::bad_alloc&) {
          is_refused = true;
        }
    }
    ASSERT_TRUE(is_refused);
    ASSERT_GT(n, 24U);
    expect_rows(store, n, 0);
    fill(store, 20, n);
    expect_rows(store, n + 20, 0);
  }
}
#endif

TEST(RowStore, RefusesRowsOfAnotherSize) {
  RowStore store(3);
  const std::vector<double> row(2);
  EXPECT_THROW(store.append(row), std::invalid_argument);
  EXPECT_THROW(store.append(RowTile{row, row.data(), 2}), std::invalid_argument);
  EXPECT_EQ(store.n_rows(), 0U);
}

TEST(RowStore, MayHaveNoColumns) {
  RowStore store;
  store.append(std::span<const double>());
  EXPECT_EQ(store.n_rows(), 1U);
  EXPECT_EQ(store.bytes(), 0U);
}

}  // namespace
}  // namespace rotordrop
