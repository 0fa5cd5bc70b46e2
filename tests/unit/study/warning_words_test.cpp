#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "study/drop/warning_summary.h"

namespace rotordrop {
namespace {

std::string text_of(const char* code, double worst) {
  const RunWarning warning{find_warning_kind(code), "", "lumped", 1, worst, 1e-3, 2e-3};
  return warnings_json({warning})[0]["text"].get<std::string>();
}

// Whether a share of nothing comes as infinite or as no number depends on who divides.
TEST(WarningWords, AreTheSameForEveryBalanceThatIsNoNumber) {
  for (const char* code : {"energy-residual", "heat-residual", "heat-port"}) {
    const std::string text = text_of(code, std::nan(""));
    EXPECT_EQ(text_of(code, std::numeric_limits<double>::infinity()), text);
    EXPECT_NE(text.find("is not a number at 2 ms"), std::string::npos) << text;
    EXPECT_EQ(text.find('%'), std::string::npos) << text;
  }
  EXPECT_NE(text_of("energy-residual", 0.02).find("leaves up to 2 % of the energy moved at 2 ms"), std::string::npos);
}

}  // namespace
}  // namespace rotordrop
