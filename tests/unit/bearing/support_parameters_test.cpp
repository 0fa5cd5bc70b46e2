// Supports with another law along z: springs along each axis; film and stop are round and act in any direction.
//
// ROUND STOP: at (y, z) beyond the gap g the springs give -K_y y, -K_z z, the stop -K_s (r - g) (y, z) / r, r = |(y, z)|.
// ROUND FILM, centred, pi film (San Andres, notes 13): force against any velocity pi/2 mu R L^3 / c^3 times it, along it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bearing/support/support_parameters.h"

namespace rotordrop {
namespace {

SupportParameters springs_of_two_laws(const std::string& type) {
  SupportParameters p;
  p.type = type;
  p.mass = 5.;
  p.K_y = 2e8;
  p.C_y = 0.;
  SupportLawParameters z;
  z.type = "linear";
  z.K_z = 5e7;
  z.C_z = 0.;
  p.z = z;
  return p;
}

TEST(SupportOfTwoLaws, MeetsItsRoundStopInAnyDirection) {
  SupportParameters p = springs_of_two_laws("linear");
  p.stop = StopParameters{20e-6, 4e8, 0.};
  const auto law = support_law(p, {0.05, 0.02});
  for (const double angle : {0., 0.5, 1.5707963267948966, 2.5, 4.}) {
    const double y = 30e-6 * std::cos(angle), z = 30e-6 * std::sin(angle), N = 4e8 * 10e-6;
    const double f_y = -2e8 * y - N * std::cos(angle), f_z = -5e7 * z - N * std::sin(angle);
    const auto moving = law->evaluate({y, z, 0., 0.}, {}, {});
    const auto rest = law->rest(y, z);
    EXPECT_NEAR(moving.y, f_y, 1e-6) << "N, angle " << angle;
    EXPECT_NEAR(moving.z, f_z, 1e-6) << "N, angle " << angle;
    EXPECT_NEAR(rest.force_y, f_y, 1e-6) << "N, angle " << angle;
    EXPECT_NEAR(rest.force_z, f_z, 1e-6) << "N, angle " << angle;
    EXPECT_NEAR(law->energy({y, z, 0., 0.}, {}), 0.5 * (2e8 * y * y + 5e7 * z * z + N * 10e-6), 1e-12) << "J";
  }
}

TEST(SupportOfTwoLaws, HasARoundFilmAndMetalBehindIt) {
  SupportParameters p = springs_of_two_laws("squeeze-film");
  p.squeeze_film = SqueezeFilmParameters{0.02, 100e-6, {}, {}, true};
  const auto law = support_law(p, {0.06, 0.025});
  const double V = 0.01, F = 0.5 * std::numbers::pi * 0.02 * 0.06 * std::pow(0.025, 3) / 1e-12 * V;
  for (const double angle : {0., 0.5, 1.5707963267948966, 2.5}) {
    const auto f = law->evaluate({0., 0., V * std::cos(angle), V * std::sin(angle)}, {}, {});
    EXPECT_NEAR(f.y, -F * std::cos(angle), 1e-9 * F) << angle;
    EXPECT_NEAR(f.z, -F * std::sin(angle), 1e-9 * F) << angle;
    EXPECT_NEAR(f.loss, F * V, 1e-9 * F * V) << angle;
  }
  EXPECT_NEAR(law->rest(0., 99e-6).force_z, -5e7 * 99e-6 - 1e9 * 1e-6, 1e-6) << "N: metal at 98 % of the clearance";
  EXPECT_NEAR(acting_stop(p)->gap, 98e-6, 1e-15) << "m";
}

}  // namespace
}  // namespace rotordrop
