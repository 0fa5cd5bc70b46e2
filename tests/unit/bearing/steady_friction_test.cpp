// Friction of a ring at rest in its balls. A drop's bearing (TouchdownBearing) has the same law in its own code: the same ring in the same place
// turning with the same speed must make the same heat.
#include "bearing/statics/steady_friction.h"

#include <gtest/gtest.h>

#include "../../verification/bearing/test_bearings.h"
#include "laws/bearing_friction.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;
using TB = TouchdownBearing;

RingReport ring_at(const std::vector<BallRowGeometry>& rows, double y, double z, double growth) {
  RingSurroundings around;
  around.radial_growth = growth;
  RingVector q = RingVector::Zero();
  q[1] = y;
  q[2] = z;
  return report_ring(RingStatics(rows, around), q);
}

HeatInput heat_of_drop(const TouchdownBearingData& data, double y, double z, double growth, double speed) {
  const TB bearing(data);
  std::vector<double> state(TB::n_state, 0.), rates(TB::n_state), ledger(TB::n_ledger);
  state[TB::ring_y] = y;
  state[TB::ring_z] = z;
  state[TB::ring_spin] = speed;
  SupportInput in;
  in.growth.inner_race = growth;
  SupportOutput out;
  bearing.evaluate(in, state, rates, ledger, out);
  return out.heat;
}

TEST(SteadyFriction, MakesTheHeatOfADropsBearingInTheSamePlace) {
  for (const bool with_spin : {false, true})
    for (const double speed : {1., 300., 1500.})
      for (const double y : {0., -2 * um, 5 * um}) {
        auto data = touchdown("TB", angular_contact_pair());
        data.load_law = FrictionLoadLaw::equivalent;
        data.add_spin_heat = with_spin;
        const auto heat = heat_of_drop(data, y, um, 3 * um, speed);
        const auto ring = ring_at(data.rows, y, um, 3 * um);
        const double M = steady_friction(data, ring, speed).total();
        EXPECT_NEAR(M * speed, heat.inner + heat.outer, 1e-9 * M * speed) << "W";
        EXPECT_NEAR(inner_heat_share(data), heat.inner / (heat.inner + heat.outer), 1e-12);
      }
}

TEST(SteadyFriction, TakesTheEquivalentLoadWhateverTheBearingsOwnLaw) {
  auto data = touchdown("TB", angular_contact_pair());
  data.load_law = FrictionLoadLaw::radial;
  const auto M = steady_friction(data, ring_at(data.rows, 0., 0., 0.), 1500.);
  // Per row P1 = 0.9 * 290 N * cot 25 deg and P0 = 0.38 * 290 N, C0 / 2
  const double P1 = 0.9 * 290. / std::tan(25 * deg), P0 = 0.38 * 290.;
  EXPECT_NEAR(M.load, 2. * 0.001 * std::pow(P0 / 15.5e3, 0.33) * P1 * 85e-3, 1e-9) << "N m";
  EXPECT_EQ(M.spin, 0.);
}

TEST(SteadyFriction, OfADeepGrooveRowDoesNotSeeUniformPressure) {
  const auto data = touchdown("TB", {deep_groove_row()});
  // Pressed evenly all round: no resultant but rounding.
  EXPECT_NEAR(steady_friction(data, ring_at(data.rows, 0., 0., 25 * um), 1500.).load, 0., 1e-12) << "N m";
  EXPECT_GT(steady_friction(data, ring_at(data.rows, 25 * um, 0., 0.), 1500.).load, 1e-3);
}

}  // namespace
}  // namespace rotordrop
