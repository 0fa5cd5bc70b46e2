#include "thermal/fe/grid_lines.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace rotordrop {
namespace {

TEST(GridLines, KeepAllEndsAndGradeNoFasterThanAsked) {
  const auto lines = grid_lines({0., 5., 25.}, {{0., 5., 0.6}, {5., 25., 2.5}, {0., 0., 0.02}}, 1.5);
  for (const double end : {0., 5., 25.}) EXPECT_TRUE(std::find(lines.begin(), lines.end(), end) != lines.end()) << end;
  // The size grows within the first cell, with a slope of 0.4: 0.02 (exp(0.4) - 1) / 0.4 = 0.0246, less to fill the length.
  EXPECT_NEAR(lines[1], 0.02, 0.005);
  for (std::size_t i = 2; i < lines.size(); ++i) {
    const double ratio = (lines[i] - lines[i - 1]) / (lines[i - 1] - lines[i - 2]);
    EXPECT_LT(ratio, 1.6) << i;
    EXPECT_GT(ratio, 1. / 1.6) << i;
  }
}

TEST(GridLines, AreEvenWithoutGrading) {
  const auto lines = grid_lines({1., 3.}, {{1., 3., 0.5}}, 1.5);
  ASSERT_EQ(lines.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(lines[i], 1. + 0.5 * static_cast<double>(i), 1e-12);
}

}  // namespace
}  // namespace rotordrop
