#include "study/heat/heat_balance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace rotordrop {
namespace {

TEST(HeatBalance, ItsResidualIsWhatIsNeitherStoredNorLost) {
  const auto balance = heat_balance(5., 3., 1.75);
  EXPECT_DOUBLE_EQ(balance["residual"].get<double>(), 0.25);
  EXPECT_EQ(heat_balance_text(", fe", balance), "Energy, fe: 5 J in, 3 J stored, 1.75 J lost, residual 2.5e-01 J\n");
}

TEST(HeatBalance, WarnsBeyondAThousandthOfTheLargest) {
  EXPECT_TRUE(heat_balance_warnings("", heat_balance(1000., 600., 399.01)).empty());
  const auto one = heat_balance_warnings("walls", heat_balance(1000., 600., 398.9));
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0]["code"], "heat-residual");
  EXPECT_EQ(one[0]["part"], "walls");
  EXPECT_NEAR(one[0]["worst"].get<double>(), 1.1e-3, 1e-12);
  // Heat that comes back out of a body that was warm counts as much as heat that goes in.
  EXPECT_TRUE(heat_balance_warnings("", heat_balance(0., -1000., 999.1)).empty());
  EXPECT_EQ(heat_balance_warnings("", heat_balance(0., -1000., 998.)).size(), 1u);
}

TEST(HeatBalance, NothingHappenedIsNoWarningAndNoNumberIsOne) {
  EXPECT_TRUE(heat_balance_warnings("", heat_balance(0., 0., 0.)).empty());
  EXPECT_EQ(heat_balance_warnings("", heat_balance(1., std::nan(""), 0.)).size(), 1u);
}

}  // namespace
}  // namespace rotordrop
