// Power balance of a bearing whose cage has a speed of its own: as in touchdown_power_test.cpp, with the heat of slipping balls among the heats.
#include <gtest/gtest.h>

#include <random>

#include "power_balance.h"
#include "test_bearings.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;
using TB = TouchdownBearing;

TouchdownBearingData with_free_cage(TouchdownBearingData data) {
  const auto& row = data.rows.front();
  FreeCage cage;
  cage.n_balls = static_cast<double>(row.n_balls) * static_cast<double>(data.rows.size());
  cage.ball_mass = row.ball_mass;
  cage.ball_diameter = row.ball_diameter;
  cage.pitch_radius = 0.5 * row.pitch_diameter;
  cage.gamma = row.ball_diameter * std::cos(row.contact_angle) / row.pitch_diameter;
  cage.inertia = 2e-5;
  cage.traction = 0.07;
  cage.slip = 0.5;
  cage.pocket_friction = 0.1;
  data.free_cage = cage;
  return data;
}

TEST(FreeCageInABearing, FindsEveryWattOfItsPowerBalance) {
  auto tight = deep_groove_row();
  tight.radial_clearance = -12 * um;  // all balls loaded: the energy is smooth
  auto few = tight;
  few.n_balls = 4;  // the races' normal forces turn the cage; of many balls their sum hardly does
  auto pair = touchdown("X pair", angular_contact_pair(900.));
  pair.centrifugal_growth = {.bore = 2.1e-12, .inner_race = 1.9e-12, .inner_width = -0.5e-12};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> one(-1, 1);
  for (const auto& data : {with_free_cage(touchdown("deep groove", {tight})),
                           with_free_cage(touchdown("four balls", {few})), with_free_cage(pair)}) {
    const TB bearing(data);
    ASSERT_EQ(bearing.state_entries().size(), TB::n_state + 2u);
    for (int i = 0; i < 60; ++i) {
      Instant s;
      s.y.assign(TB::n_state + 2, 0.);
      s.y[TB::ring_y] = 2 * um * one(random);
      s.y[TB::ring_z] = 2 * um * one(random);
      s.y[TB::ring_vy] = 0.1 * one(random);
      s.y[TB::ring_vz] = 0.1 * one(random);
      s.y[TB::cage_angle] = 20 * one(random);
      s.y[TB::ring_spin] = 1500 * one(random);
      s.y[bearing.free_cage_at()] = 600 * one(random);
      s.y[bearing.free_cage_at() + 1] = 5000 * one(random);
      const double direction = pi * one(random), distance = (275 + 10 * one(random)) * um;
      s.in.journal = {.y = s.y[TB::ring_y] + distance * std::cos(direction),
                      .z = s.y[TB::ring_z] + distance * std::sin(direction),
                      .velocity_y = 0.5 * one(random),
                      .velocity_z = 0.5 * one(random)};
      s.in.rotor_spin = {3., 1500 * one(random)};
      s.in.growth.inner_race = 0.5 * um * one(random);
      s.growth_rate.inner_race = 1e-3 * one(random);
      std::vector<double> rates(s.y.size()), ledger(bearing.ledger_entries().size());
      SupportOutput out;
      bearing.evaluate(s.in, s.y, rates, ledger, out);
      const auto& j = s.in.journal;
      const double work_of_rotor = -out.force_on_rotor.y * j.velocity_y - out.force_on_rotor.z * j.velocity_z -
                                   out.force_on_rotor.torque * s.in.rotor_spin.speed;
      const double heat = out.heat.rub + out.heat.inner + out.heat.outer,
                   growth = out.energy_gradient.dot(s.growth_rate);
      const double dU = energy_rate(bearing, s, rates, 5e-7);
      const double residual = dU - work_of_rotor + heat + out.other_dissipation - out.prescribed_work - growth;
      double scale = std::fabs(dU);
      for (const double P : {work_of_rotor, heat, out.prescribed_work, growth}) scale = std::max(scale, std::fabs(P));
      EXPECT_LT(std::fabs(residual), 1e-9 * scale + 2e-7)
          << data.name << " W of " << scale << "; 2e-7 W is roundoff of 400 J over 0.5 us";
      EXPECT_GT(ledger.back(), 1.) << "W: balls slip";
      EXPECT_EQ(ledger[TB::cage_work], 0.) << "no one prescribes the cage's motion";
    }
  }
}

}  // namespace
}  // namespace rotordrop
