// A touchdown bearing whose rings bend: its power balance, its momentum, and the forces of a shape that turns with everything else.
//
// POWER. dU/dt along the state's rates, the journal's velocity and the growth's rate is work of the rotor less heat and dissipation, plus prescribed work
// and work of growth, as in touchdown_power_test.cpp; now U has the shapes' kinetic and elastic energy, and the contact's energy over the arc.
// Over an arc U is a sum over points, each with an energy of about delta^1.61 (n + 1/2 of F = K delta^(10/9)): its second derivative is infinite where a point
// comes to touch. A point that does so within the differences' reach, 4 h to both sides, leaves an error of about f (v h)^1.61 / h: at h = 0.5 us that is up to
// 1e-3 of the power, whatever the friction; it falls with h^0.61 for each point and with h for the number of points reached. At 1 ns roundoff is left.
// MOMENTUM. Shapes with n >= 2 have none: ring and support still change theirs by the rotor's force, weight, springs and dampers alone.
// TURNING. With everything turned by an angle phi (whole steps of the arc's points), a_n + i b_n turns by n phi, and so do the forces.
// RIGID. With straight shapes the forces are those of rigid rings: exactly at a point, nearly over an arc.
#include <gtest/gtest.h>

#include <complex>
#include <random>

#include "power_balance.h"
#include "test_bearings.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;
using TB = TouchdownBearing;

Instant random_instant(const TB& bearing, std::mt19937& random, bool in_contact) {
  std::uniform_real_distribution<double> one(-1, 1);
  Instant s;
  s.y.assign(bearing.state_entries().size(), 0.);
  auto& y = s.y;
  y[TB::support_y] = 2e-6 * one(random);
  y[TB::support_z] = 2e-6 * one(random);
  y[TB::ring_y] = y[TB::support_y] + 1 * um * one(random);
  y[TB::ring_z] = y[TB::support_z] + 1 * um * one(random);
  for (const auto v : {TB::ring_vy, TB::ring_vz, TB::support_vy, TB::support_vz}) y[v] = 0.1 * one(random);
  y[TB::ring_angle] = 20 * one(random);
  y[TB::cage_angle] = 20 * one(random);
  y[TB::ring_spin] = 1500 * one(random);
  for (std::size_t k = 0; k < bearing.n_bristles(); ++k) y[bearing.bristles_at() + k] = 1 * um * one(random);
  const std::size_t at = bearing.shapes_at(), n = bearing.n_shapes();
  for (std::size_t k = 0; k < n; ++k) {
    const double order = 2. + static_cast<double>(k % bearing.data().bending->n_inner() / 2);
    y[at + k] = 4 * um / (order * order) * one(random);
    y[at + n + k] = 0.1 / order * one(random);
  }
  const double direction = pi * one(random),
               distance = (in_contact ? 275 + 10 * one(random) : 150 + 50 * one(random)) * um;
  s.in.journal.y = y[TB::ring_y] + distance * std::cos(direction);
  s.in.journal.z = y[TB::ring_z] + distance * std::sin(direction);
  s.in.journal.velocity_y = 0.5 * one(random);
  s.in.journal.velocity_z = 0.5 * one(random);
  s.in.rotor_spin = {3., 1500 * one(random)};
  s.in.growth = {1 * um * one(random),   1 * um * one(random),   0.5 * um * one(random), 0.5 * um * one(random),
                 0.2 * um * one(random), 0.5 * um * one(random), 0.5 * um * one(random)};
  s.growth_rate = {3e-3 * one(random), 3e-3 * one(random), 1e-3 * one(random), 1e-3 * one(random),
                   1e-3 * one(random), 1e-3 * one(random), 1e-3 * one(random)};
  return s;
}

/// All balls loaded, so that the energy is smooth.
std::vector<TouchdownBearingData> bent_bearings() {
  auto tight = deep_groove_row();
  tight.radial_clearance = -16 * um;
  auto a = touchdown("deep groove, arc", {tight});
  a.race_waves = {{true, 2, 0.5 * um, 0.3}, {false, 5, 0.3 * um, 1.}};
  a.bending = bent(RingBendingModel::arc, 12, false, a.air_gap);
  auto b = touchdown("X pair, point", angular_contact_pair(1500.));
  b.bending = bent(RingBendingModel::point, 12, false, b.air_gap);
  auto c = touchdown("X pair, arc, outer ring bends too", angular_contact_pair(1500.));
  c.bending = bent(RingBendingModel::arc, 8, true, c.air_gap);
  c.bore_waves = {{3, 2 * um, 0.4}};
  auto d = c;
  d.name = "X pair, balls with inertia, free ring, arc";
  for (auto& r : d.rows) r.has_inertia = true;
  d.free_ring = FreeRing{3e-4, 2e-4, 0., 32e-3, 32e-3, {}, 37e-3, 5e8};
  auto e = d;
  e.name = "gyroscopic moments shared, point, outer ring bends too";
  e.bending->model = RingBendingModel::point;
  e.bore_waves.clear();
  for (auto& r : e.rows) r.inner_gyroscopic_share = 0.5;
  auto f = a;
  f.name = "deep groove, arc, sticking";
  f.sticking = StickingFriction{1e8, 2e-3};
  auto g = d;
  g.name = "X pair, balls with inertia, free ring, arc, sticking";
  g.sticking = f.sticking;
  auto h = b;
  h.name = "X pair, point, sticking";
  h.sticking = f.sticking;
  return {a, b, c, d, e, f, g, h};
}

struct Evaluated {
  std::vector<double> rates, ledger;
  SupportOutput out;
};
Evaluated evaluate(const TB& bearing, const Instant& s) {
  Evaluated e{std::vector<double>(s.y.size()), std::vector<double>(bearing.ledger_entries().size()), {}};
  bearing.evaluate(s.in, s.y, e.rates, e.ledger, e.out);
  return e;
}

TEST(BentTouchdownBearing, FindsEveryWattOfItsPowerBalance) {
  std::mt19937 random(5);
  for (const auto& data : bent_bearings()) {
    const TB bearing(data);
    double worst = 0., largest_loss = 0.;
    // Over an arc so short that hardly a point comes to touch within it; else roundoff is less.
    const double step = data.bending->model == RingBendingModel::arc ? 1e-9 : 5e-7;
    for (int i = 0; i < 200; ++i) {
      const auto s = random_instant(bearing, random, i % 3 != 0);
      const auto e = evaluate(bearing, s);
      ASSERT_EQ(e.out.heat.is_in_contact, i % 3 != 0) << data.name;
      const auto& j = s.in.journal;
      const double work = -e.out.force_on_rotor.y * j.velocity_y - e.out.force_on_rotor.z * j.velocity_z -
                          e.out.force_on_rotor.torque * s.in.rotor_spin.speed;
      const double taken = e.out.heat.rub + e.out.heat.inner + e.out.heat.outer + e.out.other_dissipation;
      const double given = e.out.prescribed_work + e.out.energy_gradient.dot(s.growth_rate);
      const double dU = energy_rate(bearing, s, e.rates, step);
      const double scale = std::max({std::fabs(work), std::fabs(dU), std::fabs(taken), 1e3});
      worst = std::max(worst, std::fabs(dU - work + taken - given) / scale);
      largest_loss = std::max(largest_loss, e.ledger[TB::first_optional_ledger]);
      EXPECT_GE(e.ledger[TB::first_optional_ledger], 0.);
    }
    EXPECT_GT(largest_loss, 1.) << "W: the shapes move";
    // The energy's roundoff, 1e-13 J of some hundred joules, over the step; 4e-7 in 2000 instants.
    EXPECT_LT(worst, 2e-6) << data.name;
  }
}

TEST(BentTouchdownBearing, KeepsMomentum) {
  std::mt19937 random(6);
  for (const auto& data : bent_bearings()) {
    const TB bearing(data);
    for (int i = 0; i < 20; ++i) {
      const auto s = random_instant(bearing, random, true);
      const auto e = evaluate(bearing, s);
      const auto& y = s.y;
      const double ring_y = data.ring_mass * (e.rates[TB::ring_vy] - data.gravity_y);
      const double support_y = data.support_mass * e.rates[TB::support_vy] +
                               data.support_stiffness_y * y[TB::support_y] + data.support_damping_y * y[TB::support_vy];
      const double scale = std::fabs(e.out.force_on_rotor.y) + std::fabs(ring_y) + 1.;
      EXPECT_NEAR(ring_y + support_y + e.out.force_on_rotor.y, 0., 1e-9 * scale) << data.name << ", N";
      const double ring_z = data.ring_mass * (e.rates[TB::ring_vz] - data.gravity_z);
      const double support_z = data.support_mass * e.rates[TB::support_vz] +
                               data.support_stiffness_z * y[TB::support_z] + data.support_damping_z * y[TB::support_vz];
      EXPECT_NEAR(ring_z + support_z + e.out.force_on_rotor.z, 0., 1e-9 * (scale + std::fabs(ring_z))) << data.name;
    }
  }
}

TEST(BentTouchdownBearing, TurnsWithEverythingElse) {
  std::mt19937 random(7);
  for (auto data : bent_bearings()) {
    if (data.free_ring || data.sticking) continue;
    data.bore_waves.clear();
    data.race_waves.clear();
    const TB bearing(data);
    for (int i = 0; i < 10; ++i) {
      auto s = random_instant(bearing, random, true);
      const auto before = evaluate(bearing, s);
      const double phi = 2. * pi * 37. / n_arc_points;
      const auto turn = [&](double& y, double& z, double by) {
        const auto turned = std::complex<double>(y, z) * std::polar(1., by);
        y = turned.real();
        z = turned.imag();
      };
      auto& y = s.y;
      turn(s.in.journal.y, s.in.journal.z, phi);
      turn(s.in.journal.velocity_y, s.in.journal.velocity_z, phi);
      for (const auto& [a, b] : {std::pair{TB::ring_y, TB::ring_z}, std::pair{TB::ring_vy, TB::ring_vz},
                                 std::pair{TB::support_y, TB::support_z}, std::pair{TB::support_vy, TB::support_vz}})
        turn(y[a], y[b], phi);
      y[TB::cage_angle] += phi;
      const std::size_t at = bearing.shapes_at(), n = bearing.n_shapes(), m = data.bending->n_inner();
      const auto order = [&](std::size_t k) { return 2. + static_cast<double>(k % n % m / 2); };
      for (std::size_t k = 0; k < 2 * n; k += 2) turn(y[at + k], y[at + k + 1], order(k) * phi);
      const auto after = evaluate(bearing, s);
      double f_y = before.out.force_on_rotor.y, f_z = before.out.force_on_rotor.z;
      turn(f_y, f_z, phi);
      const double size = std::hypot(f_y, f_z) + 1.;
      EXPECT_NEAR(after.out.force_on_rotor.y, f_y, 1e-8 * size) << data.name << ", N";
      EXPECT_NEAR(after.out.force_on_rotor.z, f_z, 1e-8 * size) << data.name << ", N";
      for (std::size_t k = n; k < 2 * n; k += 2) {
        double a = before.rates[at + k], b = before.rates[at + k + 1];
        turn(a, b, order(k) * phi);
        const double scale = std::hypot(a, b) + 1e3;
        EXPECT_NEAR(after.rates[at + k], a, 1e-7 * scale) << data.name << ", m/s^2";
        EXPECT_NEAR(after.rates[at + k + 1], b, 1e-7 * scale) << data.name << ", m/s^2";
      }
    }
  }
}

TEST(BentTouchdownBearing, IsTheRigidOneUntilItsRingsBend) {
  std::mt19937 random(8);
  for (auto data : bent_bearings()) {
    const TB bearing(data);
    auto rigid_data = data;
    rigid_data.bending.reset();
    const TB rigid(rigid_data);
    for (int i = 0; i < 10; ++i) {
      auto s = random_instant(bearing, random, i % 2 == 0);
      for (std::size_t k = 0; k < 2 * bearing.n_shapes(); ++k) s.y[bearing.shapes_at() + k] = 0.;
      s.in.growth.bore = s.in.growth.shaft = 0.;  // the arc's law belongs to the gap as mounted
      Instant bare = s;
      bare.y.resize(bearing.shapes_at());
      const auto a = evaluate(bearing, s), b = evaluate(rigid, bare);
      // Damping acts along every point's own normal, 5 % of the force at 0.5 m/s, over an arc of 0.3 rad to both sides; bore waves act along it.
      const bool is_arc = data.bending->model == RingBendingModel::arc;
      const double allowed = (is_arc ? (data.bore_waves.empty() ? 1e-2 : 0.1) : 1e-12) *
                             std::hypot(b.out.force_on_rotor.y, b.out.force_on_rotor.z);
      EXPECT_NEAR(a.out.force_on_rotor.y, b.out.force_on_rotor.y, allowed + 1e-9) << data.name;
      EXPECT_NEAR(a.out.force_on_rotor.z, b.out.force_on_rotor.z, allowed + 1e-9) << data.name;
      if (!is_arc) {
        for (const auto k : {TB::ring_vy, TB::ring_vz, TB::ring_spin})
          EXPECT_NEAR(a.rates[k], b.rates[k], 1e-9 * std::fabs(b.rates[k]) + 1e-9) << data.name;
      }
    }
  }
}

}  // namespace
}  // namespace rotordrop
