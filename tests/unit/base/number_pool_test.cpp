// Room that is given out belongs to one taker and stays where it is.
#include "base/number_pool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace rotordrop {
namespace {

TEST(NumberPool, GivesRoomThatNobodyElseHas) {
  NumberPool pool;
  // In small pages, over their end, in large ones, more than a large one, and a rest that fits behind it.
  const std::vector<std::size_t> sizes = {1, 12000, 40000, 20000, 200000, 100000, 8, 700000, 8};
  std::vector<double*> taken;
  double value = 0.;
  for (const std::size_t n : sizes) {
    taken.push_back(pool.take(n));
    std::fill_n(taken.back(), n, ++value);
  }
  const NumberPool moved = std::move(pool);
  for (std::size_t i = 0; i < sizes.size(); ++i)
    EXPECT_EQ(std::count(taken[i], taken[i] + sizes[i], static_cast<double>(i + 1)),
              static_cast<std::ptrdiff_t>(sizes[i]))
        << i;
  pool = {};
  *pool.take(100000) = 0.;
  EXPECT_EQ(*taken[4], 5.);
}

TEST(NumberPool, GivesNothingAwayThatWasMovedElsewhere) {
  NumberPool pool;
  std::fill_n(pool.take(100000), 100000, 1.);  // most of a large piece is left
  NumberPool moved = std::move(pool);
  double* of_moved = moved.take(70000);
  *of_moved = 2.;
  double* of_old = pool.take(70000);  // NOLINT(bugprone-use-after-move): it is empty then
  *of_old = 3.;
  EXPECT_NE(of_old, of_moved);
  EXPECT_EQ(*of_moved, 2.);
}

}  // namespace
}  // namespace rotordrop
