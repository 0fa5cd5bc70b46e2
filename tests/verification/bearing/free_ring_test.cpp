// An inner ring with all five degrees of freedom.
//
// POWER. As in touchdown_power_test.cpp; the rotor's work now has an axial part and two moments.
//
// SMALL MOTIONS about a loaded place: M q'' + G q' + K q = 0. K is that of RingStatics, which the dynamics do not use; of the spinning ring's angular
// momentum (I_p omega, I_p omega psi_z + I_d psi_y', -I_p omega psi_y + I_d psi_z') follow psi_y'' = -a psi_z', psi_z'' = +a psi_y' with
// a = I_p omega / I_d: nutation with a, in the sense of the spin.
//
// A JOURNAL TILTED BY theta past the ring presses with K/w (delta + theta x)^n per length:
//   F = K/(w theta (n+1)) [(delta + theta x)^(n+1)],   M = integral of x times that, over -w/2 .. w/2.
//
// A SHOULDER tilted by theta past its face of mean radius r: force K (u - gap), moment K theta r^2 / 2. Its friction's torque is mu F r.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "bearing/statics/ring_equilibrium.h"
#include "bearing/statics/ring_statics.h"
#include "power_balance.h"
#include "test_bearings.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;
using TB = TouchdownBearing;

TouchdownBearingData free_ring(TouchdownBearingData d) {
  d.free_ring = FreeRing{.polar_inertia = 2.9e-4,
                         .diametral_inertia = 1.6e-4,
                         .gravity_x = 2.,
                         .width = 20e-3,
                         .contact_length = 20e-3,
                         .shoulders = {{-1., 100 * um}, {1., 150 * um}},
                         .shoulder_radius = 37e-3,
                         .shoulder_stiffness = 5e8};
  return d;
}

/// The bristles of sticking friction follow the ring; bearings without them leave their rates at zero.
constexpr std::size_t n_with_bristles = TB::n_state_free + 6;

struct Evaluation {
  std::vector<double> rates = std::vector<double>(n_with_bristles), ledger = std::vector<double>(TB::n_ledger);
  SupportOutput out;
};

Evaluation evaluate(const TB& bearing, const SupportInput& in, const std::vector<double>& y) {
  Evaluation e;
  bearing.evaluate(in, y, e.rates, e.ledger, e.out);
  return e;
}

std::vector<double> at_rest(const TB& bearing) {
  std::vector<double> y(TB::n_state_free);
  bearing.initial_state(y);
  return y;
}

/// The ring within 2 um in its balls, the journal 275 um aside and tilted, against one shoulder or between both.
Instant random_instant(std::mt19937& random, int kind) {
  std::uniform_real_distribution<double> one(-1, 1);
  Instant s;
  s.y.resize(n_with_bristles);
  auto& y = s.y;
  for (const auto i : {TB::ring_y, TB::ring_z, TB::ring_x, TB::support_y, TB::support_z}) y[i] = 2 * um * one(random);
  for (const auto i : {TB::ring_vy, TB::ring_vz, TB::ring_vx, TB::support_vy, TB::support_vz}) y[i] = 0.1 * one(random);
  for (const auto i : {TB::tilt_y, TB::tilt_z}) y[i] = 3e-5 * one(random);
  for (const auto i : {TB::tilt_rate_y, TB::tilt_rate_z}) y[i] = 5 * one(random);
  y[TB::ring_spin] = 1500 * one(random);
  y[TB::cage_angle] = 20 * one(random);
  auto& j = s.in.journal;
  const double direction = pi * one(random);
  j.x = kind == 0 ? 0. : kind == 1 ? 110 * um + y[TB::ring_x] : -160 * um + y[TB::ring_x];
  j.y = y[TB::ring_y] + 275 * um * std::cos(direction);
  j.z = y[TB::ring_z] + 275 * um * std::sin(direction);
  j.theta_y = 5e-5 * one(random);
  j.theta_z = 5e-5 * one(random);
  for (auto* v : {&j.velocity_x, &j.velocity_y, &j.velocity_z}) *v = 0.3 * one(random);
  for (std::size_t i = TB::n_state_free; i < n_with_bristles; ++i)
    y[i] = 2 * um * std::sin(5. * static_cast<double>(i) + 1e6 * y[TB::ring_y]);
  for (auto* v : {&j.tilt_rate_y, &j.tilt_rate_z}) *v = 3 * one(random);
  s.in.rotor_spin = {3., 1500 * one(random)};
  return s;
}

/// Over so short a time that no ball or shoulder comes to touch: over 0.5 us one of them does, which leaves 2e-4 W.
constexpr double short_time = 1e-7;  // [s]

TEST(FreeRing, FindsEveryWattOfItsPowerBalance) {
  std::mt19937 random(31);
  auto tight = deep_groove_row();
  tight.radial_clearance = -12 * um;
  auto deep = free_ring(touchdown("deep groove", {tight}));
  deep.bore_waves = {{3, 2 * um, 0.4}};
  auto pair = free_ring(touchdown("X pair", angular_contact_pair(900.)));
  auto heavy = pair;
  heavy.name = "X pair, balls with inertia";
  for (auto& row : heavy.rows) row.has_inertia = true;
  auto shared = heavy;
  shared.name = "X pair, gyroscopic moments shared by the races";
  for (auto& row : shared.rows) row.inner_gyroscopic_share = 0.5;
  auto sticking = pair;
  sticking.name = "X pair with sticking friction";
  sticking.sticking = StickingFriction{1e8, 2e-3};
  auto everything = shared;
  everything.name = "X pair with everything: shared moments, sticking by tables of friction, grown rings";
  everything.sticking = sticking.sticking;
  everything.friction.has_tables = true;
  everything.friction.over_speed = {{0., 0.16}, {60., 0.04}};
  everything.friction.over_temperature = {{300., 1.}, {400., 0.5}};
  for (const auto& data : {deep, pair, heavy, shared, sticking, everything}) {
    const TB bearing(data);
    double largest_axial = 0., largest_moment = 0.;
    for (int i = 0; i < 60; ++i) {
      auto s = random_instant(random, i % 3);
      if (data.friction.has_tables) {
        s.in.ring_temperature = 340.;
        s.in.growth = {1 * um, 2 * um, 0.5 * um, -0.4 * um, 0.2 * um, 0.5 * um, -0.3 * um};
      }
      const auto e = evaluate(bearing, s.in, s.y);
      const auto& j = s.in.journal;
      const Force& f = e.out.force_on_rotor;
      const double work_of_rotor = -f.x * j.velocity_x - f.y * j.velocity_y - f.z * j.velocity_z -
                                   f.moment_y * j.tilt_rate_y - f.moment_z * j.tilt_rate_z -
                                   f.torque * s.in.rotor_spin.speed;
      const double heat = e.out.heat.rub + e.out.heat.inner + e.out.heat.outer;
      const double dU = energy_rate(bearing, s, e.rates, short_time);
      const double residual = dU - work_of_rotor + heat + e.out.other_dissipation - e.out.prescribed_work;
      const double scale = std::max({std::fabs(dU), std::fabs(work_of_rotor), heat});
      // Balls with inertia stop their iteration at 2e-5 of their loads, and their power is that before the last step. With 1e-10 nothing of this is left.
      const double balance = data.rows[0].has_inertia ? 5e-4 : 0.;
      EXPECT_LT(std::fabs(residual), 1e-9 * scale + 1e-5 + balance)
          << data.name << ", W of " << scale << "; 1e-5 W is roundoff of 400 J over 0.1 us";
      EXPECT_GE(e.out.heat.rub, 0.);
      EXPECT_GE(e.out.other_dissipation, 0.);
      largest_axial = std::max(largest_axial, std::fabs(f.x));
      largest_moment = std::max(largest_moment, std::hypot(f.moment_y, f.moment_z));
    }
    EXPECT_GT(largest_axial, 1e3) << "N: shoulders took part";
    EXPECT_GT(largest_moment, 1.) << "N m";
  }
}

TEST(FreeRing, WattsOfTheSpinUpAreThoseOfBothTorques) {
  // omega_r T_r - omega_i T_i + (friction force times the rest of the slip) is the rub heat, for bore and shoulders together.
  std::mt19937 random(32);
  const TB bearing(free_ring(touchdown("X pair", angular_contact_pair(900.))));
  for (int i = 0; i < 30; ++i) {
    const auto s = random_instant(random, i % 3);
    const auto e = evaluate(bearing, s.in, s.y);
    const auto& d = bearing.data();
    const double M = (e.out.heat.inner + e.out.heat.outer) / s.y[TB::ring_spin];
    const double on_ring = d.ring_spin_inertia * e.rates[TB::ring_spin] + M;
    const double rub = d.rotor_radius / d.bore_radius * e.ledger[TB::spin_up_drive] - s.y[TB::ring_spin] * on_ring +
                       e.ledger[TB::spin_up_centres];
    EXPECT_NEAR(rub, e.out.heat.rub, 1e-9 * std::max(std::fabs(e.ledger[TB::spin_up_drive]), e.out.heat.rub));
  }
}

/// Rows without damping and a heavy, stiff support, so that the ring moves alone.
TouchdownBearingData undamped(std::vector<BallRowGeometry> rows) {
  auto d = free_ring(touchdown("X pair", std::move(rows)));
  for (auto& row : d.rows) row.damping_beta = 0.;
  return d;
}

TEST(FreeRing, SmallMotionsHaveTheStaticStiffness) {
  constexpr std::array<std::size_t, 5> place{TB::ring_x, TB::ring_y, TB::ring_z, TB::tilt_y, TB::tilt_z};
  constexpr std::array<std::size_t, 5> rate{TB::ring_vx, TB::ring_vy, TB::ring_vz, TB::tilt_rate_y, TB::tilt_rate_z};
  const auto data = undamped(angular_contact_pair(400.));
  const TB bearing(data);
  RingVector q;
  q << 2e-6, -3e-6, 1e-6, 2e-5, -1e-5, 0.;
  std::vector<double> y(TB::n_state_free);
  for (std::size_t i = 0; i < 5; ++i) y[place[i]] = q[static_cast<Eigen::Index>(i)];
  const auto K = RingStatics(data.rows, {}).stiffness(q);
  const double m = data.ring_mass, I = data.free_ring->diametral_inertia;
  const std::array<double, 5> inertia{m, m, m, I, I};
  for (std::size_t j = 0; j < 5; ++j) {
    const double h = j < 3 ? 1e-8 : 1e-6;
    for (std::size_t i = 0; i < 5; ++i) {
      const double slope = derivative(
                               [&](double t) {
                                 auto moved = y;
                                 moved[place[j]] += h * t;
                                 return evaluate(bearing, {}, moved).rates[rate[i]];
                               },
                               1.) /
                           h;
      const auto at = [](std::size_t k) { return static_cast<Eigen::Index>(k); };
      const double scale = std::sqrt(K(at(i), at(i)) * K(at(j), at(j)));
      EXPECT_NEAR(-inertia[i] * slope, K(at(i), at(j)), 1e-6 * scale)
          << i << ", " << j << ": differences over 10 nm leave about 1e-8";
    }
  }
}

TEST(FreeRing, NutatesWithItsSpin) {
  auto loose = deep_groove_row();
  loose.radial_clearance = 200 * um;  // no ball touches
  const auto data = undamped({loose});
  const TB bearing(data);
  std::vector<double> y(TB::n_state_free);
  y[TB::ring_spin] = 1000.;
  y[TB::tilt_rate_y] = 2.;
  const double a = 2.9e-4 / 1.6e-4 * 1000.;
  auto rates = evaluate(bearing, {}, y).rates;
  EXPECT_NEAR(rates[TB::tilt_rate_y], 0., 1e-9);
  EXPECT_NEAR(rates[TB::tilt_rate_z], 2. * a, 1e-9 * a) << "1/s2: from y towards z, as the spin";
  y[TB::tilt_rate_y] = 0.;
  y[TB::tilt_rate_z] = 2.;
  rates = evaluate(bearing, {}, y).rates;
  EXPECT_NEAR(rates[TB::tilt_rate_y], -2. * a, 1e-9 * a) << "1/s2";
}

TEST(FreeRing, ATiltedJournalPressesMoreAtOneEnd) {
  const auto data = free_ring(touchdown("X pair", angular_contact_pair(290.)));
  const TB bearing(data);
  std::vector<double> y(TB::n_state_free);
  SupportInput in;
  const double delta = 10 * um, theta = 2e-4, w = 20e-3, n = 10. / 9., K = data.contact.K;
  in.journal.y = -(250 * um + delta);
  in.journal.theta_z = -theta;  // lower, so deeper, at +x
  const double low = delta - theta * w / 2, high = delta + theta * w / 2;
  const double F = K / (w * theta * (n + 1)) * (std::pow(high, n + 1) - std::pow(low, n + 1));
  const auto primitive = [&](double d) { return std::pow(d, n + 2) / (n + 2) - delta * std::pow(d, n + 1) / (n + 1); };
  const double M = K / (w * theta * theta) * (primitive(high) - primitive(low));
  const auto e = evaluate(bearing, in, y);
  EXPECT_NEAR(e.out.force_on_rotor.y, F, 2e-7 * F) << "N; three Gauss points on (1 +- 0.2)^(10/9)";
  // On the ring acts -F e_y at x: M_z = x F_y < 0 for more force at +x; the rotor feels the opposite.
  EXPECT_NEAR(e.out.force_on_rotor.moment_z, M, 1e-4 * M) << "N m";
  EXPECT_NEAR(e.out.force_on_rotor.moment_y, 0., 1e-9 * M);
}

TEST(FreeRing, AShoulderTakesAxialLoadMomentAndRubs) {
  const auto data = free_ring(touchdown("X pair", angular_contact_pair(290.)));
  const TB bearing(data);
  std::vector<double> y(TB::n_state_free);
  SupportInput in;
  in.journal.x = 104 * um;  // 4 um into the shoulder at the ring's -x face
  in.journal.theta_y = 3e-5;
  in.rotor_spin.speed = 1000.;
  const auto e = evaluate(bearing, in, y);
  const double F = 5e8 * 4 * um, r = 37e-3;
  EXPECT_NEAR(e.out.force_on_rotor.x, -F, 1e-9 * F) << "N: it pushes the rotor back";
  EXPECT_NEAR(e.out.force_on_rotor.moment_y, -5e8 * 3e-5 * r * r / 2, 1e-9) << "N m: and upright";
  EXPECT_NEAR(e.out.force_on_rotor.torque, -0.1 * F * r, 1e-5 * F * r)
      << "N m; friction is regularised by (0.05/37)^2/2 = 1e-6";
  EXPECT_NEAR(e.out.heat.rub, 0.1 * F * r * 1000., 1e-5 * F * r * 1000.) << "W";
  EXPECT_TRUE(e.out.heat.is_in_contact);
  in.journal.x = -104 * um;
  EXPECT_EQ(evaluate(bearing, in, y).out.force_on_rotor.x, 0.) << "150 um to the other one";
  in.journal.x = -152 * um;
  EXPECT_NEAR(evaluate(bearing, in, y).out.force_on_rotor.x, 5e8 * 2 * um, 1e-9 * 5e8 * 2 * um);
}

TEST(FreeRing, StartsInEquilibriumUnderItsAxialWeightToo) {
  for (auto data : {free_ring(touchdown("deep groove", {deep_groove_row()})),
                    free_ring(touchdown("X pair", angular_contact_pair(290.)))}) {
    data.free_ring->gravity_x = 3 * 9.81;
    const TB bearing(data);
    const auto y = at_rest(bearing);
    const auto rates = evaluate(bearing, {}, y).rates;
    EXPECT_GT(y[TB::ring_x], 1e-9) << "m, " << data.name;
    for (const auto i : {TB::ring_vx, TB::ring_vy, TB::ring_vz})
      EXPECT_NEAR(rates[i], 0., 3e-5) << "m/s2: 1e-6 of the weight, " << data.name;
    for (const auto i : {TB::tilt_rate_y, TB::tilt_rate_z})
      EXPECT_NEAR(rates[i], 0., 1e-6 * 0.21 * 31. * 45e-3 / 1.6e-4) << "1/s2, " << data.name;
  }
}

TEST(FreeRing, RestsWhereARingWithoutTiltDoesUnderASymmetricLoad) {
  // Mirrored rows under a load across the axis neither tilt the ring nor move it along the axis.
  auto rows = angular_contact_pair(290.);
  rows[1].phase = rows[0].phase;
  std::vector<BallRow> balls;
  for (const auto& row : rows) balls.emplace_back(row, std::vector<RaceWave>{});
  const auto locked = ring_equilibrium(balls, {.y = -500.}), free = ring_equilibrium(balls, {.y = -500.}, true);
  // Both searches end at 1e-9 of the load.
  EXPECT_NEAR(free.y, locked.y, 1e-8 * std::fabs(locked.y));
  EXPECT_NEAR(free.x, 0., 1e-12);
  EXPECT_NEAR(free.psi_z, 0., 1e-10);
}

}  // namespace
}  // namespace rotordrop
