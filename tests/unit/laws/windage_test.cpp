// Friction of rotating bodies in gas.
//
// BY HAND
//   Free cylinder, laminar: 4 pi mu omega r^2 a length is the torque of an infinitely long cylinder in still gas (velocity omega r^2 / distance, shear
//   stress 2 mu omega). C pi rho omega^2 r^4 with C = 4/Re is the same.
//   Turbulent: the law is implicit; it is checked by putting the result into it, and once by iteration.
//   Enclosed, slow: Couette's torque in a narrow gap, 2 pi mu omega r^3 / g a length, is C = 2 / Re; the fit 5 (g/r)^0.3 / Re meets it at g/r = 0.047.
//   Disc face: Re = 1e5 laminar 1.935/316.228 = 0.0061190; Re = 1e6 turbulent 0.073/15.8489 = 0.0046060.
#include "laws/windage.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rotordrop {
namespace {

TEST(FreeCylinder, IsStokesianWhenSlow) {
  EXPECT_DOUBLE_EQ(free_cylinder_coefficient(0.01), 400.);
  EXPECT_DOUBLE_EQ(free_cylinder_coefficient(20.), 0.2);
}

TEST(FreeCylinder, SatisfiesTheTurbulentLaw) {
  for (const double Re : {200., 1e4, 1e6, 7e6}) {
    const double C = free_cylinder_coefficient(Re);
    EXPECT_NEAR(1. / std::sqrt(C), -0.6 + 4.07 * std::log10(Re * std::sqrt(C)), 1e-10) << Re;
  }
  // x = 1/sqrt(C) = -0.6 + 4.07 log10(1e6/x) by fixed-point iteration: 18.65, 18.648, 18.6485: C = 0.0028755
  EXPECT_NEAR(free_cylinder_coefficient(1e6), 0.0028755, 1e-7);
}

TEST(FreeCylinder, HasNoJumpBetweenItsPieces) {
  double last = free_cylinder_coefficient(10.);
  for (double Re = 10.; Re < 300.; Re *= 1.001) {
    const double C = free_cylinder_coefficient(Re);
    EXPECT_LE(C, last);
    EXPECT_NEAR(C / last, 1., 0.002) << Re;
    last = C;
  }
}

TEST(EnclosedCylinder, IsCouettesFlowWhenSlowAndNarrow) {
  EXPECT_NEAR(enclosed_cylinder_coefficient(10., std::pow(0.4, 1. / 0.3)) * 10., 2., 1e-12);
}

TEST(EnclosedCylinder, PiecesMeet) {
  for (const double Re : {64., 500., 1e4})
    EXPECT_NEAR(enclosed_cylinder_coefficient(Re * 0.999999, 0.02) / enclosed_cylinder_coefficient(Re, 0.02), 1., 0.06)
        << Re;
  // (0.02)^0.3 = 0.309249; 0.0325 * 0.309249 / (1e5)^0.2 = 0.00100506
  EXPECT_NEAR(enclosed_cylinder_coefficient(1e5, 0.02), 1.00506e-3, 1e-8);
}

TEST(DiscFace, ByHand) {
  // by hand above, five digits
  EXPECT_NEAR(disc_face_coefficient(1e5), 0.0061190, 5e-8);
  EXPECT_NEAR(disc_face_coefficient(1e6), 0.0046060, 5e-8);
}

}  // namespace
}  // namespace rotordrop
