#include "laws/vector_power.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rotordrop {
namespace {

TEST(VectorPower, AgreesWithTheStandardLibrary) {
  for (const double a : {11. / 18., 0.5, 1.1, 2.5, -0.39})
    for (double x = 1e-20; x < 2.; x *= 1.37)
      EXPECT_NEAR(vector_power(x, a) / std::pow(x, a), 1., 1e-13) << x << "^" << a;
}

TEST(VectorPower, KeepsWhatIsNotANumber) {
  EXPECT_TRUE(std::isnan(vector_power(std::numeric_limits<double>::quiet_NaN(), 0.6)));
}

}  // namespace
}  // namespace rotordrop
