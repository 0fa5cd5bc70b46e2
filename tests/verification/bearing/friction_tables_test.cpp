// A ring under a rotor that is held on it with constant force N and turns with constant speed, no friction in the bearing:
//   J omega' = mu(v) N r_b,   v = v_r - omega r_b,   so  v' = -(N r_b^2/J) mu(v).
// With mu = m_0 + m_1 v on a straight piece of its table:
//   v(t) = (v_0 + m_0/m_1) exp(-m_1 N r_b^2 t/J) - m_0/m_1,
// and the heat is N times the integral of mu(v) v dt = (J/r_b^2) integral of v dv = J (v_0^2 - v^2)/(2 r_b^2), whatever mu.
//
// With sticking friction the bristle of a slip v at the temperature T rests at mu(|v|, T) N / k, with the force mu(|v|, T) N. Without slip it rests wherever
// it is below 0.8 mu(0, T) N / k; what is beyond mu(0, T) N / k yields with the rate kappa.
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

TouchdownBearingData that_stick() {
  auto data = without_bearing_friction();
  data.friction.over_temperature = {{300., 1.}, {400., 0.5}};
  data.sticking = StickingFriction{1e8, 2e-3};
  return data;
}

struct Stuck {
  double rate = 0;  // of the bristle [m/s]
  Force on_rotor;
  double rub = 0;
};
/// The rotor on the standing ring, 10 um deep in its bore; its surface slips.
Stuck stuck(const TouchdownBearingData& data, double bristle, double slip, double temperature) {
  const TB bearing(data);
  std::vector<double> y(TB::n_state + 1, 0.), rates(TB::n_state + 1), ledger(TB::n_ledger);
  y[TB::n_state] = bristle;
  SupportInput in;
  in.journal.y = -(data.air_gap + 10e-6);
  in.rotor_spin.speed = slip / data.rotor_radius;
  in.ring_temperature = temperature;
  SupportOutput out;
  bearing.evaluate(in, y, rates, ledger, out);
  return {rates[TB::n_state], out.force_on_rotor, out.heat.rub};
}

TEST(FrictionTables, SlidingBristlesHaveTheTablesForce) {
  const auto data = that_stick();
  const double N = data.contact.K * std::pow(10e-6, data.contact.n), k = data.sticking->stiffness;
  for (const double slip : {5., 30., 55.})
    for (const auto& [temperature, factor] : {std::pair{290., 1.}, {350., 0.75}, {410., 0.5}}) {
      const double force = (0.16 - 0.12 / 60. * slip) * factor * N;
      const Stuck s = stuck(data, force / k, slip, temperature);
      EXPECT_NEAR(s.rate, 0., 1e-12 * slip) << "m/s at " << slip << " m/s, " << temperature << " K";
      EXPECT_NEAR(std::hypot(s.on_rotor.y, s.on_rotor.z), std::hypot(force, N), 1e-12 * N) << "N";
      EXPECT_NEAR(s.on_rotor.torque, -force * data.rotor_radius, 1e-12 * N * data.rotor_radius) << "N m";
      EXPECT_NEAR(s.rub, force * slip, 1e-11 * force * slip) << "W";
    }
}

TEST(FrictionTables, AWarmRingLetsGoOfWhatAColdOneHolds) {
  const auto data = that_stick();
  const double N = data.contact.K * std::pow(10e-6, data.contact.n), k = data.sticking->stiffness;
  const double bristle = 0.6 * 0.16 * N / k;
  const Stuck cold = stuck(data, bristle, 0., 300.), hot = stuck(data, bristle, 0., 400.);
  EXPECT_EQ(cold.rate, 0.) << "m/s: no drift";
  EXPECT_NEAR(cold.on_rotor.torque, -k * bristle * data.rotor_radius, 1e-12 * N) << "N m";
  EXPECT_NEAR(hot.rate, -StickingFriction::rate * (bristle - 0.08 * N / k), 1e-12) << "m/s";
  EXPECT_NEAR(hot.on_rotor.torque, -0.08 * N * data.rotor_radius, 1e-12 * N) << "N m";
}

}  // namespace
