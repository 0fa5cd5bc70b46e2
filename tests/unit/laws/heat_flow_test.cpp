// Convection from the housing, Jaeger's share.
//
// JAEGER. Two half-spaces share a heat q so that their surfaces' rises agree; one heated for a time t under a flux q rises by 2 q sqrt(t/pi)/e.
// A point of a moving surface is under the band for t = band / |v|, of a surface at rest for the contact's duration. So
//   q_ring sqrt(t_ring)/e_ring = q_rotor sqrt(t_rotor)/e_rotor.
// With equal materials, a band of 5.9 mm, 2.2 ms of contact, rotor surface 1591.74 * 34.75 mm = 55.31 m/s: t_rotor = 0.10667 ms, sqrt(2.2/0.10667)
// = 4.5414: rotor : ring = 0.8195 : 0.1805. With the ring at half speed sqrt(2): 0.5858. At 0.95 of the rotor's 0.5064.
#include "laws/heat/heat_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rotordrop {
namespace {

using std::numbers::pi;

TEST(HousingConvection, IsTwentyThreeTimesTheFourthRoot) {
  EXPECT_NEAR(housing_convection(16.), 46., 1e-12) << "W/m2 K";
  EXPECT_NEAR(housing_convection(1.), 23., 1e-12) << "W/m2 K";
  EXPECT_EQ(housing_convection(0.), 0.);
  EXPECT_EQ(housing_convection(-5.), 0.) << "a housing colder than the surroundings exchanges nothing";
}

TEST(JaegerShare, GivesTheRotorMostWhileTheRingRests) {
  const JaegerShare law{5.9e-3, 2.2e-3, 1.};
  const double v = 15200. * pi / 30. * 34.75e-3;
  // by hand above, four digits
  EXPECT_NEAR(1. - law.to_ring(v, 0.), 0.8195, 5e-5);
  EXPECT_NEAR(1. - law.to_ring(v, 0.5 * v), 0.5858, 5e-5);
  EXPECT_NEAR(1. - law.to_ring(v, 0.95 * v), 0.5064, 5e-5);
  // As docs/theory/model.md quotes them, two digits.
  EXPECT_NEAR(1. - law.to_ring(v, 0.), 0.82, 0.005);
  EXPECT_NEAR(1. - law.to_ring(v, 0.5 * v), 0.59, 0.005);
  EXPECT_NEAR(1. - law.to_ring(v, 0.95 * v), 0.51, 0.005);
}

TEST(RubShare, IsTheConstantOrJaegers) {
  RubShare share{0.66, false, {5.9e-3, 2.2e-3, 1.}};
  EXPECT_EQ(share.to_ring(40., 10.), 0.66);
  share.by_jaeger = true;
  EXPECT_NEAR(share.to_ring(40., 10.), 1. / 3., 1e-12) << "sqrt(40/10) = 2: one third into the ring";
}

TEST(JaegerShare, LetsTheSurfacesRisesAgree) {
  for (const double e : {0.5, 1., 2.3})  // e_rotor / e_ring
    for (const double v_rotor : {0.3, 20., -55.})
      for (const double v_ring : {0., 3., -30.}) {
        const JaegerShare law{5.9e-3, 2.2e-3, e};
        const auto time = [](double v) { return std::fmin(2.2e-3, 5.9e-3 / std::fabs(v)); };
        const double ring = law.to_ring(v_rotor, v_ring), rotor = 1. - ring;
        EXPECT_NEAR(ring * std::sqrt(time(v_ring)), rotor * std::sqrt(time(v_rotor)) / e, 1e-12);
      }
}

}  // namespace
}  // namespace rotordrop
