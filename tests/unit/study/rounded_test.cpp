#include "study/report/rounded.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace rotordrop {
namespace {

TEST(Rounded, KeepsSoManyDigits) {
  EXPECT_EQ(rounded(2. / 3., 3).dump(), "0.667");
  EXPECT_EQ(rounded(123456., 2).get<double>(), 120000.);
}

TEST(Rounded, TakesNumbersBelowTheSmallestNormalOne) {
  const double tiny = std::numeric_limits<double>::denorm_min();  // 4.94e-324
  EXPECT_EQ(rounded(tiny, 6).get<double>(), tiny);
  EXPECT_EQ(rounded(-3e-310, 6).get<double>(), -3e-310);
}

TEST(Rounded, IsNullWhereThereIsNoNumber) {
  EXPECT_TRUE(rounded(std::nan(""), 6).is_null());
  EXPECT_TRUE(rounded(std::vector<double>{1., INFINITY}, 1.)[1].is_null());
}

}  // namespace
}  // namespace rotordrop
