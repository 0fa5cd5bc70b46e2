// Power balance of a touchdown bearing, its forces and torques.
//
// Every joule that the bearing's energy gains or loses in an instant is found among
//   dU/dt = - force_on_rotor . journal velocity - torque_on_rotor * rotor speed      (work of the rotor on the bearing)
//           - heat (rub + inner + outer) - other dissipation + prescribed work (cage, waves, growth by the ring's speed)
//           + energy_gradient . growth rate.
// dU/dt is a numerical derivative of energy() along the state's rates, the journal's velocity and the growth's rate.
//
// MOMENTUM. The ring's rate of momentum less its weight, plus the support's with its spring and damper to ground, is the force of the rotor.
// SPIN. On the ring acts F_t r_b less M, on the rotor -F_t r_r: each with its own radius, so that rub heat = F_t (omega_r r_r - omega_i r_b + v_t) = F_t v_s.
//
// SENSE. A rotor spinning from +y towards +z that lies on the bottom of the bore: its lowest point moves by omega x r = omega x (-r y) = -omega r z. Friction
// drives the ring's bottom towards -z, which turns it with the rotor (x cross -y = -z), and pushes the rotor towards +z: like a wheel on the road, whose top moves with +z.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "laws/ball_kinematics.h"
#include "laws/bearing_friction.h"
#include "power_balance.h"
#include "test_bearings.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;
using TB = TouchdownBearing;

struct Evaluation {
  std::vector<double> rates = std::vector<double>(TB::n_state + 1),  // with a bristle of sticking friction
      ledger = std::vector<double>(TB::n_ledger);
  SupportOutput out;
};

Evaluation evaluate(const TB& bearing, const SupportInput& in, const std::vector<double>& y) {
  Evaluation e;
  bearing.evaluate(in, y, e.rates, e.ledger, e.out);
  return e;
}

/// The ring within +-4 um in its balls (all of which carry load in the bearings below), the rotor deep in the bore or clear of it.
Instant random_instant(std::mt19937& random, bool in_contact) {
  std::uniform_real_distribution<double> one(-1, 1);
  Instant s;
  s.y.assign(TB::n_state + 1, 0.);
  auto& y = s.y;
  y[TB::support_y] = 2e-6 * one(random);
  y[TB::support_z] = 2e-6 * one(random);
  y[TB::ring_y] = y[TB::support_y] + 2 * um * one(random);
  y[TB::ring_z] = y[TB::support_z] + 2 * um * one(random);
  y[TB::ring_vy] = 0.1 * one(random);
  y[TB::ring_vz] = 0.1 * one(random);
  y[TB::support_vy] = 0.03 * one(random);
  y[TB::support_vz] = 0.03 * one(random);
  y[TB::ring_angle] = 20 * one(random);
  y[TB::cage_angle] = 20 * one(random);
  y[TB::ring_spin] = 1500 * one(random);
  const double direction = pi * one(random),
               distance = (in_contact ? 275 + 10 * one(random) : 150 + 50 * one(random)) * um;
  s.in.journal.y = y[TB::ring_y] + distance * std::cos(direction);
  s.in.journal.z = y[TB::ring_z] + distance * std::sin(direction);
  s.in.journal.velocity_y = 0.5 * one(random);
  s.in.journal.velocity_z = 0.5 * one(random);
  s.in.rotor_spin = {3., 1500 * one(random)};
  s.in.ring_temperature = 340.;
  y[TB::n_state] = 2 * um * std::sin(1e6 * y[TB::ring_y]);
  s.in.growth = {1 * um * one(random),   1 * um * one(random),   0.5 * um * one(random), 0.5 * um * one(random),
                 0.2 * um * one(random), 0.5 * um * one(random), 0.5 * um * one(random), 0.5 * um * one(random)};
  s.growth_rate = {3e-3 * one(random), 3e-3 * one(random), 1e-3 * one(random), 1e-3 * one(random),
                   1e-3 * one(random), 1e-3 * one(random), 1e-3 * one(random), 1e-3 * one(random)};
  return s;
}

/// 5 um at 15200 rpm.
const Expansion speed_growth{.bore = 2.1e-12, .inner_race = 1.9e-12, .inner_width = -0.5e-12};

/// Bearings whose balls all carry load in random_instant's states, so that the energy is smooth; with every extra.
std::vector<TouchdownBearingData> lively_bearings() {
  auto tight = deep_groove_row();
  tight.radial_clearance = -12 * um;
  auto a = touchdown("deep groove", {tight});
  a.gravity_z = 1.3;
  a.race_waves = {{true, 2, 0.5 * um, 0.3}, {false, 5, 0.3 * um, 1.}};
  a.bore_waves = {{3, 2 * um, 0.4}, {1, 3 * um, -1.}};
  auto b = touchdown("X pair", angular_contact_pair(900.));
  b.load_law = FrictionLoadLaw::equivalent;
  b.add_spin_heat = true;
  b.static_rating = 62e3;
  b.contact.K = 1.73e9;
  b.friction = {0.12, 0.05, 0.2, 0.5, true};
  b.race_waves = {{true, 7, 0.3 * um, 2.}};
  b.bore_waves = {{2, 1 * um, 0.}};
  auto c = b, d = a;
  c.name = "X pair, balls with inertia";
  d.name = "deep groove, balls with inertia";
  for (auto* data : {&c, &d})
    for (auto& r : data->rows) r.has_inertia = true;
  auto e = c;
  e.name = "X pair, gyroscopic moments shared by the races";
  for (auto& r : e.rows) r.inner_gyroscopic_share = 0.5;
  auto f = b;
  f.name = "X pair with sticking friction";
  f.sticking = StickingFriction{1e8, 2e-3};
  auto g = e;
  g.name = "X pair with everything: shared moments, sticking by tables of friction";
  g.sticking = f.sticking;
  g.friction = {.mu = 0.12, .regularisation_speed = 0.05, .has_tables = true};
  g.friction.over_speed = {{0., 0.16}, {60., 0.04}};
  g.friction.over_temperature = {{300., 1.}, {400., 0.5}};
  return {a, b, touchdown("plain X pair", angular_contact_pair(900.)), c, d, e, f, g};
}

TEST(TouchdownBearing, FindsEveryWattOfItsPowerBalance) {
  std::mt19937 random(3);
  auto bearings = lively_bearings();
  bearings.push_back(bearings[1]);
  bearings.back().name = "X pair that grows by its speed";
  bearings.back().centrifugal_growth = speed_growth;
  bearings[bearings.size() - 2].centrifugal_growth = speed_growth;  // the one with everything
  for (const auto& data : bearings) {
    const TB bearing(data);
    double worst = 0.;
    for (int i = 0; i < 60; ++i) {
      const bool in_contact = i % 3 != 0;
      const auto s = random_instant(random, in_contact);
      const auto e = evaluate(bearing, s.in, s.y);
      ASSERT_EQ(e.out.heat.is_in_contact, in_contact);
      const auto& j = s.in.journal;
      const double work_of_rotor = -e.out.force_on_rotor.y * j.velocity_y - e.out.force_on_rotor.z * j.velocity_z -
                                   e.out.force_on_rotor.torque * s.in.rotor_spin.speed;
      const double heat = e.out.heat.rub + e.out.heat.inner + e.out.heat.outer,
                   growth = e.out.energy_gradient.dot(s.growth_rate);
      const double dU = energy_rate(bearing, s, e.rates, 5e-7);
      const double residual = dU - work_of_rotor + heat + e.out.other_dissipation - e.out.prescribed_work - growth;
      double scale = std::fabs(dU);
      for (const double P : {work_of_rotor, heat, e.out.other_dissipation, e.out.prescribed_work, growth})
        scale = std::max(scale, std::fabs(P));
      worst = std::max(worst, std::fabs(residual) / scale);
      // Balls with inertia are in balance to about 1e-8 of their loads only, some 1e3 N at 1e-2 m/s, 46 of them.
      const double balance = data.rows[0].has_inertia ? 1e-5 : 0.;
      EXPECT_LT(std::fabs(residual), 1e-9 * scale + 2e-7 + balance)
          << data.name << (in_contact ? ", in contact" : ", apart") << " W of " << scale
          << "; 2e-7 W is roundoff of 400 J over 0.5 us, twice 3e-14 J and the sum's own";
    }
    printf("%s: worst residual %.1e of the largest power\n", data.name.c_str(), worst);
  }
}

TEST(TouchdownBearing, BalancesItsPowerWithFreeBallsToo) {
  // A ball that just touches within the derivative's reach (1e-7 m) adds 2/5 K (1e-7)^2.5 / 5e-7 s = 0.03 W.
  std::mt19937 random(5);
  auto data = touchdown("deep groove with clearance", {deep_groove_row()});
  data.race_waves = {{true, 2, 4 * um, 0.}};
  auto heavy = data;
  heavy.rows[0].has_inertia = true;
  const TB light_balls(data), heavy_balls(heavy);
  std::uniform_real_distribution<double> angle(-pi, pi);
  for (int i = 0; i < 60; ++i) {
    const TB& bearing = i % 2 ? heavy_balls : light_balls;
    auto s = random_instant(random, true);
    const double direction = angle(random);
    const double dy = 24 * um * std::cos(direction),
                 dz = 24 * um * std::sin(direction);  // the ring lies in its clearance of 19 um
    s.y[TB::ring_y] += dy;
    s.y[TB::ring_z] += dz;
    s.in.journal.y += dy;
    s.in.journal.z += dz;
    const auto e = evaluate(bearing, s.in, s.y);
    const auto& j = s.in.journal;
    const double balance = energy_rate(bearing, s, e.rates, 5e-7) + e.out.force_on_rotor.y * j.velocity_y +
                           e.out.force_on_rotor.z * j.velocity_z + e.out.force_on_rotor.torque * s.in.rotor_spin.speed +
                           e.out.heat.rub + e.out.heat.inner + e.out.heat.outer + e.out.other_dissipation -
                           e.out.prescribed_work - e.out.energy_gradient.dot(s.growth_rate);
    EXPECT_NEAR(balance, 0., 0.1) << "W, of some 1e4 W";
  }
}

TEST(TouchdownBearing, DissipatesNeverLessThanNothing) {
  std::mt19937 random(6);
  for (const auto& data : lively_bearings()) {
    const TB bearing(data);
    for (int i = 0; i < 200; ++i) {
      const auto s = random_instant(random, i % 2);
      const auto e = evaluate(bearing, s.in, s.y);
      EXPECT_GE(e.out.heat.rub, 0.);
      EXPECT_GE(e.out.heat.inner, 0.);
      EXPECT_GE(e.out.heat.outer, 0.);
      EXPECT_GE(e.out.other_dissipation, 0.);
      EXPECT_GE(e.ledger[TB::contact_damping], 0.);
      EXPECT_GE(e.ledger[TB::ball_damping], 0.);
      EXPECT_GE(e.ledger[TB::support_damping], 0.);
      EXPECT_NEAR(e.ledger[TB::contact_damping] + e.ledger[TB::ball_damping] + e.ledger[TB::support_damping],
                  e.out.other_dissipation, 1e-12 * e.out.other_dissipation);
      EXPECT_NEAR(e.ledger[TB::waviness_work] + e.ledger[TB::cage_work] + e.ledger[TB::inertia_of_balls],
                  e.out.prescribed_work, 1e-10 * (1. + std::fabs(e.out.prescribed_work)));
    }
  }
}

TEST(TouchdownBearing, GivesTheRotorWhatRingAndSupportGet) {
  std::mt19937 random(4);
  for (const auto& d : lively_bearings()) {
    const TB bearing(d);
    for (int i = 0; i < 40; ++i) {
      const auto s = random_instant(random, i % 2);
      const auto& y = s.y;
      const auto e = evaluate(bearing, s.in, y);
      const double on_ring_y = d.ring_mass * (e.rates[TB::ring_vy] - d.gravity_y) +
                               d.support_mass * e.rates[TB::support_vy] + d.support_stiffness_y * y[TB::support_y] +
                               d.support_damping_y * y[TB::support_vy];
      const double on_ring_z = d.ring_mass * (e.rates[TB::ring_vz] - d.gravity_z) +
                               d.support_mass * e.rates[TB::support_vz] + d.support_stiffness_z * y[TB::support_z] +
                               d.support_damping_z * y[TB::support_vz];
      const double scale = d.support_mass * (std::fabs(e.rates[TB::support_vy]) + std::fabs(e.rates[TB::support_vz])) +
                           std::hypot(e.out.force_on_rotor.y, e.out.force_on_rotor.z) + 1e4;
      EXPECT_NEAR(on_ring_y, -e.out.force_on_rotor.y, 1e-11 * scale) << "N";
      EXPECT_NEAR(on_ring_z, -e.out.force_on_rotor.z, 1e-11 * scale) << "N";
    }
  }
}

TEST(TouchdownBearing, RubHeatIsFrictionTimesSlipAndBothTorquesHaveTheirOwnRadius) {
  std::mt19937 random(8);
  for (const auto& d : lively_bearings()) {
    if (d.sticking) continue;  // its force follows the bristle (sticking_test.cpp)
    const TB bearing(d);
    for (int i = 0; i < 40; ++i) {
      const auto s = random_instant(random, true);
      const auto e = evaluate(bearing, s.in, s.y);
      const double ey = s.in.journal.y - s.y[TB::ring_y], ez = s.in.journal.z - s.y[TB::ring_z], r = std::hypot(ey, ez),
                   ny = ey / r, nz = ez / r;
      // On the ring, along t = x cross n = (-n_z, n_y): the force's part across the normal.
      const double F_t = e.out.force_on_rotor.y * nz - e.out.force_on_rotor.z * ny,
                   N = -e.out.force_on_rotor.y * ny - e.out.force_on_rotor.z * nz;
      const double v_t =
          (s.in.journal.velocity_z - s.y[TB::ring_vz]) * ny - (s.in.journal.velocity_y - s.y[TB::ring_vy]) * nz;
      const double v_s = s.in.rotor_spin.speed * d.rotor_radius - s.y[TB::ring_spin] * d.bore_radius + v_t;
      EXPECT_NEAR(e.out.heat.rub, F_t * v_s, 1e-9 * std::fabs(F_t * v_s)) << "W";
      EXPECT_NEAR(e.out.force_on_rotor.torque, -F_t * d.rotor_radius, 1e-9 * std::fabs(F_t) * d.rotor_radius) << "N m";
      EXPECT_EQ(F_t > 0., v_s > 0.) << "friction drags the ring along";
      const double mu =
          d.friction.mu + (d.friction.has_stribeck ? (d.friction.static_mu - d.friction.mu) *
                                                         std::exp(-std::pow(v_s / d.friction.stribeck_speed, 2))
                                                   : 0.);
      EXPECT_NEAR(std::fabs(F_t), mu * N * std::fabs(v_s) / std::hypot(v_s, d.friction.regularisation_speed), 1e-9 * N)
          << "N";
      const double M = (e.out.heat.inner + e.out.heat.outer) / s.y[TB::ring_spin];
      EXPECT_NEAR(d.ring_spin_inertia * e.rates[TB::ring_spin], F_t * d.bore_radius - M,
                  1e-10 * (std::fabs(F_t) * d.bore_radius + std::fabs(M)))
          << "N m";
      EXPECT_NEAR(e.ledger[TB::spin_up_drive], s.in.rotor_spin.speed * F_t * d.bore_radius,
                  1e-9 * std::fabs(s.in.rotor_spin.speed * F_t) * d.bore_radius)
          << "W";
      EXPECT_NEAR(e.ledger[TB::spin_up_centres], F_t * v_t, 1e-9 * std::fabs(F_t)) << "W";
      EXPECT_NEAR(e.ledger[TB::contact_impulse], N, 1e-9 * N) << "N";
    }
  }
}

TEST(TouchdownBearing, ARotorSpinningTowardsZRollsTowardsZOnTheBottom) {
  const TB bearing(touchdown("TB1", {deep_groove_row()}));
  std::vector<double> y(TB::n_state);
  bearing.initial_state(y);
  SupportInput in;
  in.journal.y = y[TB::ring_y] - 255 * um;
  in.journal.z = y[TB::ring_z];
  in.rotor_spin.speed = 1591.7;
  const auto e = evaluate(bearing, in, y);
  EXPECT_GT(e.out.force_on_rotor.y, 0.) << "the floor holds it";
  // Friction is regularised: (0.05/55.3)^2 / 2 of mu = 4e-8.
  EXPECT_NEAR(e.out.force_on_rotor.z / e.out.force_on_rotor.y, 0.1, 1e-7)
      << "and pushes it towards +z with mu times that";
  EXPECT_LT(e.out.force_on_rotor.torque, 0.) << "braking it";
  EXPECT_GT(e.rates[TB::ring_spin], 0.) << "while the ring spins up in the same sense";
  in.rotor_spin.speed = -1591.7;
  const auto back = evaluate(bearing, in, y);
  EXPECT_NEAR(back.out.force_on_rotor.z / back.out.force_on_rotor.y, -0.1, 1e-7);
  EXPECT_GT(back.out.force_on_rotor.torque, 0.);
}

TEST(TouchdownBearing, InternalHeatIsSplitByTheRacesRadii) {
  const TB bearing(touchdown("TB2", angular_contact_pair(290.)));
  std::vector<double> y(TB::n_state);
  bearing.initial_state(y);
  y[TB::ring_spin] = 1591.7;
  const auto e = evaluate(bearing, {}, y);
  const double heat = e.out.heat.inner + e.out.heat.outer;
  // r_i : r_o = (85 - 9.525 cos 25 deg) : (85 + 9.525 cos 25 deg) = 76.3674 : 93.6326.
  EXPECT_NEAR(e.out.heat.inner / heat, 76.3674 / 170., 1e-6);
  EXPECT_NEAR(e.out.heat.inner / heat, 0.449, 0.0005);
  EXPECT_NEAR(e.out.heat.outer / heat, 0.551, 0.0005);
}

TEST(TouchdownBearing, InternalHeatIsFrictionTorqueTimesRingSpeed) {
  // Radial law: the load is the resultant of the ball forces, here the ring's weight; spin 1591.7 rad/s >> 2 rad/s of the regularisation.
  auto d = touchdown("TB1", {deep_groove_row()});
  const TB bearing(d);
  std::vector<double> y(TB::n_state);
  bearing.initial_state(y);
  y[TB::ring_spin] = 1591.7;
  const auto e = evaluate(bearing, {}, y);
  const double W = 0.21 * 9.81;
  const double M = load_torque({W, W}, 0.001, 0.33, 31e3, 90e-3) + drag_torque(15e-6, 1591.7, 90e-3, 0.25);
  EXPECT_NEAR(e.out.heat.inner + e.out.heat.outer, M * 1591.7, 1e-7 * M * 1591.7) << "W";
  // Equivalent law: two rows with 290 N each, per row P1 = 0.9 * 290 N cot 25 deg - 0.1 F_r and P0 = 0.38 * 290 N on half of C0.
  auto pair_data = touchdown("TB2", angular_contact_pair(290.));
  pair_data.load_law = FrictionLoadLaw::equivalent;
  pair_data.static_rating = 62e3;
  pair_data.gravity_y = 0.;
  const TB pair_bearing(pair_data);
  pair_bearing.initial_state(y);
  y[TB::ring_spin] = 1591.7;
  const auto p = evaluate(pair_bearing, {}, y);
  const double P = 0.9 * 290. * 2.1445069, M_pair = 2. * 0.001 * std::pow(0.38 * 290. / 31e3, 0.33) * P * 85e-3 +
                                                    drag_torque(15e-6, 1591.7, 85e-3, 0.25);
  EXPECT_NEAR(p.out.heat.inner + p.out.heat.outer, M_pair * 1591.7, 1e-6 * M_pair * 1591.7) << "W";
}

TEST(TouchdownBearing, HeatAboveTheWorkIsTakenOffTheOtherDissipation) {
  // As eq. 24 is printed: omega_b/omega_i = (d_m/d)(1 - gamma^2)/2 = 85/9.525 (1 - (9.525 cos 25 deg/85)^2)/2 = 4.415920 times the work.
  const auto d = touchdown("TB2", angular_contact_pair(290.));
  auto printed = d;
  printed.heat_over_work = 4.415920;
  const TB bearing(d), as_printed(printed);
  std::vector<double> y(TB::n_state);
  bearing.initial_state(y);
  y[TB::ring_spin] = 1591.7;
  const auto e = evaluate(bearing, {}, y), p = evaluate(as_printed, {}, y);
  const double work = e.out.heat.inner + e.out.heat.outer, heat = p.out.heat.inner + p.out.heat.outer;
  EXPECT_NEAR(heat, 4.415920 * work, 1e-12 * heat) << "W";
  EXPECT_NEAR(p.out.heat.inner / heat, e.out.heat.inner / work, 1e-12);
  EXPECT_NEAR(p.out.other_dissipation + heat, e.out.other_dissipation + work, 1e-12 * heat) << "W, all that is lost";
  EXPECT_EQ(p.rates[TB::ring_spin], e.rates[TB::ring_spin]) << "the motion is the same";
}

TEST(TouchdownBearing, SpinMomentsAddTheirPowerIfAsked) {
  // All 2 x 23 balls alike under 290 N: Q = 290/(23 sin phi); power = 46 M_s omega_i sin phi under outer-race control (nominal angle).
  auto d = touchdown("TB2", angular_contact_pair(290.));
  d.gravity_y = 0.;
  auto with = d;
  with.add_spin_heat = true;
  const TB plain(d), spinning(with);
  std::vector<double> y(TB::n_state);
  plain.initial_state(y);
  y[TB::ring_spin] = 1000.;
  const auto a = evaluate(plain, {}, y), b = evaluate(spinning, {}, y);
  const double A = 0.04 * 9.525e-3, Bx = A * std::sin(25 * deg) + d.rows[0].preload_offset,
               B = std::hypot(A * std::cos(25 * deg), Bx), Q = 290. / 23. * B / Bx;
  const double M_s = 3. / 8. * 0.1 * Q * 6e-5 * std::cbrt(Q) * 1.02;
  EXPECT_NEAR(b.out.heat.inner + b.out.heat.outer - a.out.heat.inner - a.out.heat.outer,
              46. * M_s * 1000. * std::sin(25 * deg), 1e-6 * 46. * M_s * 1000.)
      << "W";
}

TEST(TouchdownBearing, StartsAtRestInEquilibrium) {
  for (const auto& d : {touchdown("TB1", {deep_groove_row()}), touchdown("TB2", angular_contact_pair(290.))}) {
    const TB bearing(d);
    std::vector<double> y(TB::n_state);
    bearing.initial_state(y);
    const auto e = evaluate(bearing, {}, y);
    EXPECT_NEAR(e.rates[TB::ring_vy], 0., 1e-6 * 9.81) << "m/s2, " << d.name;
    EXPECT_NEAR(e.rates[TB::ring_vz], 0., 1e-6 * 9.81) << "m/s2";
    EXPECT_NEAR(e.rates[TB::support_vy], 0., 1e-6 * 9.81) << "m/s2";
    EXPECT_NEAR(y[TB::support_y], -d.ring_mass * 9.81 / d.support_stiffness_y, 1e-18)
        << "m: the support carries the ring";
  }
  std::vector<double> y(TB::n_state);
  auto d = touchdown("TB1", {deep_groove_row()});
  d.support_stiffness_y = 2.7e9;
  TB(d).initial_state(y);
  EXPECT_NEAR(y[TB::ring_y], -19.287 * um, 0.001 * um) << "m";
}

TEST(TouchdownBearing, SpeedsOfBothSurfacesAreSeenFromTheRubbingSpot) {
  // The line of centres turns at v_t / distance; the spot moves along the bore with r_b times that.
  const TB bearing(touchdown("TB1", {deep_groove_row()}));
  std::vector<double> y(TB::n_state);
  bearing.initial_state(y);
  SupportInput in;
  in.journal.y = y[TB::ring_y];
  in.journal.z = y[TB::ring_z] + 260 * um;
  in.journal.velocity_y = -0.02;  // n = (0, 1), t = (-1, 0): 0.02 m/s along t
  in.rotor_spin.speed = 1000.;
  y[TB::ring_spin] = 400.;
  const auto e = evaluate(bearing, in, y);
  const double spot = 35e-3 * 0.02 / (260 * um);
  EXPECT_NEAR(e.out.heat.rotor_surface_speed, 34.75 - spot, 1e-9) << "m/s";
  EXPECT_NEAR(e.out.heat.ring_surface_speed, 14. - spot, 1e-9) << "m/s";
}

}  // namespace
}  // namespace rotordrop
