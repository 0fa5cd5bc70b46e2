// A fit that opens is told of once.
#include "analysis/watch/fit_watch.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace rotordrop {
namespace {

const std::vector<Observable> observables = {
    {"/bearings/TB1/orbit", "m", "", 2, {}},
    {"/fe/TB1/housing_fit_open", "1", "", 1, {}, Observed::housing_fit_open, "TB1"},
    {"/fe/TB2/housing_fit_open", "1", "", 1, {}, Observed::housing_fit_open, "TB2"}};

TEST(FitWatch, TellsOnceOfEveryFit) {
  std::vector<std::string> told;
  FitWatch watch(observables, 1, false, [&](const std::string& text) { told.push_back(text); });
  watch.row(0.001, std::vector{9., 9., 9., 0., 0.});
  EXPECT_TRUE(told.empty());
  watch.row(0.002, std::vector{9., 9., 9., 0., 0.25});
  watch.row(0.003, std::vector{9., 9., 9., 0., 0.5});
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("TB2's outer ring in its housing begins to open before t = 2 ms: 25 %"), std::string::npos)
      << told[0];
  watch.row(0.004, std::vector{9., 9., 9., 1., 0.5});
  ASSERT_EQ(told.size(), 2U);
  EXPECT_NE(told[1].find("TB1's"), std::string::npos) << told[1];
}

}  // namespace
}  // namespace rotordrop
