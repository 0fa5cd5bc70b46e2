#include "machine/speed_growth.h"

#include <gtest/gtest.h>

#include "case/case.h"

namespace rotordrop {
namespace {

TEST(SpeedGrowth, OfARingIsThatOfADiscUpToItsShoulders) {
  // Timoshenko & Goodier, rotating disc with a hole: u(a) = rho a / (4 E) [(3 + nu) b^2 + (1 - nu) a^2].
  auto p = read_case(ROTORDROP_SOURCE_DIR "/params/neisi2019.toml", {}).parameters;
  auto b = *p.bearings.front().touchdown();
  const auto& steel = material_of(p, b.ring);
  const double a = 0.5 * b.inner_ring_diameters[0];
  const auto bore = [&](double outside) {
    return steel.rho * a / (4. * steel.E) * ((3. + steel.nu) * outside * outside + (1. - steel.nu) * a * a);
  };
  b.inner_shoulder_diameter = 82.9e-3;
  EXPECT_NEAR(ring_growth_by_speed(p, b).bore, bore(41.45e-3), 1e-12 * bore(41.45e-3));
  b.inner_shoulder_diameter.reset();
  const double outside = 0.5 * b.inner_ring_diameters[1];
  EXPECT_NEAR(ring_growth_by_speed(p, b).bore, bore(outside), 1e-12 * bore(outside));
}

}  // namespace
}  // namespace rotordrop
