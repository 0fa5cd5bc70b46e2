// ISO 21940-11: e_per omega = G. G6.3 at 3000 rpm: e_per = 6.3e-3 / (100 pi) = 20.05 um, the value of the standard's chart; 100 kg: 2005 g mm.
// Parts in two planes: same resultant, and no moment about the centre of gravity when in phase.
#include "rotor/balance_grade.h"

#include <gtest/gtest.h>

#include <numbers>

namespace rotordrop {
namespace {

TEST(BalanceGrade, PermitsMassTimesGradeOverSpeed) {
  const double omega = 3000. * std::numbers::pi / 30.;
  EXPECT_NEAR(permissible_unbalance(100., 6.3e-3, omega), 2005.35e-6, 0.01e-6) << "kg m";
  EXPECT_NEAR(permissible_unbalance(100., 6.3e-3, 2. * omega), 0.5 * permissible_unbalance(100., 6.3e-3, omega), 1e-18);
}

TEST(BalanceGrade, IsSplitByTheLeverAboutTheCentreOfGravity) {
  const double x_A = 0.1, x_B = 0.9, x_G = 0.3, U = 2e-3;
  const auto [A, B] = unbalance_in_planes(U, x_A, x_B, x_G);
  EXPECT_NEAR(A, 0.75 * U, 1e-18) << "the plane nearer to the centre of gravity has more";
  EXPECT_NEAR(A + B, U, 1e-18);
  EXPECT_NEAR(A * (x_A - x_G) + B * (x_B - x_G), 0., 1e-18) << "kg m2";
  const auto [b, a] = unbalance_in_planes(U, x_B, x_A, x_G);
  EXPECT_NEAR(a, A, 1e-18) << "whichever plane comes first";
  EXPECT_NEAR(b, B, 1e-18);
}

}  // namespace
}  // namespace rotordrop
