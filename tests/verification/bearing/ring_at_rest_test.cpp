// A touchdown bearing starts in equilibrium: nothing moves until the rotor comes.
//
// Balls press rings by waves and by preload, with or without weight, and bend them where they can; an inner ring that is eccentric by a wave of first order
// rests off the axis.
#include <gtest/gtest.h>

#include "power_balance.h"
#include "test_bearings.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;
using TB = TouchdownBearing;

constexpr double heavy = 9.81, weightless = 0., nearly_weightless = 1e-6;  // [m/s^2]

std::vector<TouchdownBearingData> bearings_at_rest() {
  auto few_balls = row(8, 9.525e-3, 85e-3, 25 * deg, steel);
  std::vector<TouchdownBearingData> all;
  for (const bool bends : {false, true})
    for (const bool is_free : {false, true}) {
      auto wavy = touchdown("pair, waves", angular_contact_pair(290.));
      wavy.race_waves = {{true, 2, 4 * um, 0.3}, {false, 1, 4 * um, 1.}};
      auto coarse = touchdown("pair of 8 balls a row", pair(few_balls, 2000.));
      auto loose = touchdown("deep groove with clearance", {deep_groove_row()});
      for (auto* d : {&wavy, &coarse, &loose}) {
        if (bends) d->bending = bent(RingBendingModel::arc, 8, d != &loose, d->air_gap);
        if (is_free) d->free_ring = FreeRing{3e-4, 2e-4, 0., 32e-3, 32e-3, {}, 37e-3, 5e8};
        d->name += bends ? ", bent" : ", rigid";
        all.push_back(*d);
      }
    }
  return all;
}

TEST(RingAtRest, IsInEquilibriumWithItsWavesItsShapesAndItsWeight) {
  double largest_bend = 0.;
  for (const double gravity : {heavy, weightless, nearly_weightless})
    for (auto data : bearings_at_rest()) {
      data.gravity_y = -gravity;
      const TB bearing(data);
      std::vector<double> y(bearing.state_entries().size()), rates(y.size()), ledger(bearing.ledger_entries().size());
      bearing.initial_state(y);
      SupportInput in;
      SupportOutput out;
      std::vector<double> loads(bearing.rows()[0].n_balls() * bearing.rows().size() + bearing.n_shapes());
      out.observed_details = loads;
      bearing.evaluate(in, y, rates, ledger, out);
      double of_balls = 0.;
      for (std::size_t j = 0; j + bearing.n_shapes() < loads.size(); ++j) of_balls += loads[j];
      // What the search leaves: 1e-6 of the weight where the balls hardly resist, or the roundoff of forces that are differences of the balls' loads.
      const double enough = 1e-6 * data.ring_mass * gravity + 1e-12 * of_balls;
      EXPECT_NEAR(data.ring_mass * rates[TB::ring_vy], 0., enough) << data.name << ", N";
      EXPECT_NEAR(data.ring_mass * rates[TB::ring_vz], 0., enough) << data.name << ", N";
      EXPECT_NEAR(rates[TB::ring_spin], 0., 1e-12) << data.name;
      if (data.free_ring) {
        EXPECT_NEAR(data.ring_mass * rates[TB::ring_vx], 0., enough) << data.name << ", N";
        EXPECT_NEAR(data.free_ring->diametral_inertia * rates[TB::tilt_rate_y], 0., 0.05 * enough)
            << data.name << ", N m: the arm is 43 mm";
        EXPECT_NEAR(data.free_ring->diametral_inertia * rates[TB::tilt_rate_z], 0., 0.05 * enough) << data.name;
      }
      for (std::size_t k = 0; k < bearing.n_shapes(); ++k) {
        const auto& rings = *data.bending;
        const auto& h = k < rings.n_inner() ? rings.inner[k / 2] : rings.outer[(k - rings.n_inner()) / 2];
        const double mass = rings.dynamic_mass(h);
        EXPECT_NEAR(mass * rates[bearing.shapes_at() + bearing.n_shapes() + k], 0., enough)
            << data.name << ", N, shape " << k;
        largest_bend = std::max(largest_bend, std::fabs(y[bearing.shapes_at() + k]));
      }
    }
  EXPECT_GT(largest_bend, 0.5 * um) << "m: rings bend";
}

}  // namespace
}  // namespace rotordrop
