// A ring under a rotor that is held on it with constant force N and turns with constant speed, no friction in the bearing:
//   J omega' = mu(v) N r_b,   v = v_r - omega r_b,   so  v' = -(N r_b^2/J) mu(v).
// With mu = m_0 + m_1 v on a straight piece of its table:
//   v(t) = (v_0 + m_0/m_1) exp(-m_1 N r_b^2 t/J) - m_0/m_1,
// and the heat is N times the integral of mu(v) v dt = (J/r_b^2) integral of v dv = J (v_0^2 - v^2)/(2 r_b^2), whatever mu.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "test_bearings.h"

namespace {

using namespace rotordrop;
using namespace rotordrop::testing;
using TB = TouchdownBearing;

struct Spinning {
  double slip = 0, heat = 0;
};

/// Classical Runge-Kutta over the ring's spin and the heat; everything else is held.
Spinning spin_up(const TouchdownBearingData& data, double rotor_speed, double end, double temperature) {
  const TB bearing(data);
  std::vector<double> y(TB::n_state, 0.), rates(TB::n_state), ledger(TB::n_ledger);
  SupportInput in;
  in.rotor_spin.speed = rotor_speed;
  in.journal.y = -(data.air_gap + 10e-6);
  in.ring_temperature = temperature;
  SupportOutput out;
  const int n = 2000;
  const double h = end / n;
  Spinning s;
  const auto rate = [&](double spin) {
    y[TB::ring_spin] = spin;
    bearing.evaluate(in, y, rates, ledger, out);
    return std::pair{rates[TB::ring_spin], out.heat.rub};
  };
  double spin = 0.;
  for (int i = 0; i < n; ++i) {
    const auto [a1, q1] = rate(spin);
    const auto [a2, q2] = rate(spin + 0.5 * h * a1);
    const auto [a3, q3] = rate(spin + 0.5 * h * a2);
    const auto [a4, q4] = rate(spin + h * a3);
    spin += h / 6. * (a1 + 2. * a2 + 2. * a3 + a4);
    s.heat += h / 6. * (q1 + 2. * q2 + 2. * q3 + q4);
  }
  s.slip = rotor_speed * data.rotor_radius - spin * data.bore_radius;
  return s;
}

TouchdownBearingData without_bearing_friction() {
  auto data = touchdown("TB", {deep_groove_row()});
  data.f1_z = data.f2 = 0.;
  data.friction.regularisation_speed = 1e-6;
  data.friction.has_tables = true;
  data.friction.over_speed = {{0., 0.16}, {60., 0.04}};
  return data;
}

TEST(FrictionTables, SpinARingUpAsTheClosedFormSays) {
  const auto data = without_bearing_friction();
  const double N = data.contact.K * std::pow(10e-6, data.contact.n), v_0 = 1591. * data.rotor_radius;
  const double m_0 = 0.16, m_1 = -0.12 / 60., J = data.ring_spin_inertia, r = data.bore_radius;
  const double end = 20e-3;
  const Spinning s = spin_up(data, 1591., end, 0.);
  const double expected = (v_0 + m_0 / m_1) * std::exp(-m_1 * N * r * r * end / J) - m_0 / m_1;
  ASSERT_GT(expected, 1.) << "still sliding";
  ASSERT_LT(expected, 0.8 * v_0);
  EXPECT_NEAR(s.slip, expected, 1e-9 * v_0) << "m/s";
  EXPECT_NEAR(s.heat, 0.5 * J * (v_0 * v_0 - expected * expected) / (r * r), 1e-9 * 0.5 * J * v_0 * v_0 / (r * r))
      << "J";
}

TEST(FrictionTables, AWarmRingTakesTheTablesFactor) {
  auto data = without_bearing_friction();
  data.friction.over_temperature = {{300., 1.}, {400., 0.5}};
  const double N = data.contact.K * std::pow(10e-6, data.contact.n), v_0 = 1591. * data.rotor_radius;
  const double m_0 = 0.75 * 0.16, m_1 = -0.75 * 0.12 / 60., J = data.ring_spin_inertia, r = data.bore_radius;
  const double end = 20e-3;
  const double expected = (v_0 + m_0 / m_1) * std::exp(-m_1 * N * r * r * end / J) - m_0 / m_1;
  EXPECT_NEAR(spin_up(data, 1591., end, 350.).slip, expected, 1e-9 * v_0) << "m/s";
}

}  // namespace
