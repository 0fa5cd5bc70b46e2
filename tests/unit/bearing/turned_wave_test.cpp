// A wave around a surface that turns: A sin(m (azimuth - turned) + phase), from sine and cosine of m times the azimuth.
#include "bearing/turned_wave.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rotordrop {
namespace {

TEST(TurnedWave, HasTheHeightAndTheSlopeOfItsSine) {
  constexpr double A = 3e-6, phase = 0.7;
  for (const int m : {1, 3, 14})
    for (const double turned : {0., 2.5, -40.})
      for (const double azimuth : {0., 1., -2.}) {
        const TurnedWave wave(m, A, phase, turned);
        const double argument = m * (azimuth - turned) + phase, s = std::sin(m * azimuth), c = std::cos(m * azimuth);
        // Rounding of arguments of up to 600 radians.
        EXPECT_NEAR(wave.height(s, c), A * std::sin(argument), A * 1e-12) << m << " " << turned << " " << azimuth;
        EXPECT_NEAR(wave.slope(s, c), A * std::cos(argument), A * 1e-12) << m << " " << turned << " " << azimuth;
      }
}

TEST(TurnedWave, MultiplesOfAnAngleAreThoseOfTheLibrary) {
  for (const double angle : {0., 0.3, -2., 3.1})
    for (int order = 1; order <= 1000; ++order) {
      const SineCosine at = multiple_of(order, SineCosine{std::sin(angle), std::cos(angle)});
      // Sine and cosine are rounded by 1.1e-16, which the multiple has `order` times; each of some twenty products rounds again.
      const double allowed = (order + 20.) * 3e-16;
      ASSERT_NEAR(at.sine, std::sin(order * angle), allowed) << order << " times " << angle;
      ASSERT_NEAR(at.cosine, std::cos(order * angle), allowed) << order << " times " << angle;
    }
}

}  // namespace
}  // namespace rotordrop
