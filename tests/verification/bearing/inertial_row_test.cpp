// Rows of balls with inertia, as the drop has them: every ball against the scalar balance of laws/ball_balance.h (which validation/ball_balance.py
// checks), sums against the row's definition; loads, closure, limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "bearing/statics/ring_statics.h"
#include "laws/skidding.h"
#include "test_bearings.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

struct Sample {
  std::vector<BallRowGeometry> rows;
  BallRowInput in;
};

Sample sample(std::mt19937& random, double reach, double tilt, double speed) {
  std::uniform_real_distribution<double> one(-1, 1);
  Sample s;
  const auto kind = random() % 3;
  s.rows = kind == 0   ? std::vector{deep_groove_row()}
           : kind == 1 ? angular_contact_pair(290. + 200. * one(random))
                       : pair(row(23, 8.731e-3, 85e-3, 15 * deg, steel), 500., Pair::O);
  const double inner_share = random() % 2 == 0 ? 0.5 : 0.;
  for (auto& g : s.rows) {
    g.has_inertia = true;
    g.inner_gyroscopic_share = inner_share;
  }
  auto& in = s.in;
  in.displacement = {reach * one(random), reach * one(random), reach * one(random), tilt * one(random),
                     tilt * one(random)};
  in.cage_angle = 7. * one(random);
  in.cage_cosine = std::cos(in.cage_angle);
  in.cage_sine = std::sin(in.cage_angle);
  in.ring_speed = speed * one(random);
  in.radial_growth = 0.3 * reach * one(random);
  in.ball_growth = 0.05 * reach * one(random);
  in.inner_strain = 10. * reach * one(random);  // per metre: contact points some 5 mm off the middle
  in.outer_strain = 10. * reach * one(random);
  return s;
}

RingSurroundings surroundings(const BallRowInput& in) {
  return {in.radial_growth, in.ball_growth, in.ring_speed, true, in.cage_angle, in.inner_strain, in.outer_strain};
}

TEST(InertialRow, EveryBallIsInTheBalanceOfTheScalarLaw) {
  std::mt19937 random(17);
  double worst = 0., worst_sum = 0.;
  int n_balls = 0, n_free = 0;
  for (const double reach : {2 * um, 10 * um, 50 * um})
    for (const double speed : {30., 400., 1600., 4000.})
      for (int i = 0; i < 200; ++i) {
        auto s = sample(random, reach, reach / 42.5e-3, speed);
        if (i % 2) {  // a ring that only translates: its balls start from the row's table
          auto& e = s.in.displacement;
          e.x = e.psi_y = e.psi_z = 0.;
        }
        const RingStatics ring(s.rows, surroundings(s.in));
        RingVector q;
        q << s.in.displacement.x, s.in.displacement.y, s.in.displacement.z, s.in.displacement.psi_y,
            s.in.displacement.psi_z, 0.;
        const auto balls = ring.balls(q);
        RingVector F = RingVector::Zero();
        double largest = 0.;
        for (std::size_t k = 0; k < s.rows.size(); ++k) {
          const BallRow r(s.rows[k], {});
          std::vector<double> load(static_cast<std::size_t>(s.rows[k].n_balls));
          r.ball_loads(s.in, load);
          for (std::size_t j = 0; j < load.size(); ++j) {
            const auto& b = balls[k][j].balance;
            ++n_balls;
            n_free += b.load_i == 0.;
            worst = std::max(worst, std::fabs(load[j] - b.load_i) / (b.load_o + 1e-6));
            largest = std::max(largest, b.load_o);
          }
          BallRowOutput out;
          r.evaluate(s.in, out);
          F += (RingVector() << out.force_x, out.force_y, out.force_z, out.moment_y, out.moment_z, 0.).finished();
        }
        const RingVector expected = ring.reaction(q).force;
        worst_sum = std::max(worst_sum, (F - expected).head<3>().norm() / (largest + 1e-6));
        EXPECT_NEAR((F - expected).tail<3>().norm() / 42.5e-3, 0., 1e-5 * largest + 1e-6) << "N";
      }
  printf("%d balls, %d out of the inner race's reach; worst load off by %.1e of its ball's, sums by %.1e\n", n_balls,
         n_free, worst, worst_sum);
  EXPECT_LT(worst, 1e-6);
  EXPECT_LT(worst_sum, 1e-5) << "sums of up to 46 balls";
  EXPECT_GT(n_free, 1000);
}

TEST(InertialRow, NewtonStepsArriveInTheStatesOfADrop) {
  // Directly: how many steps, and how often the scalar law has to help; from the row's table, and from the closed guess of rings that tilt.
  std::mt19937 random(23);
  int by_scalar[2] = {0, 0}, n = 0;
  double steps[2] = {0., 0.};
  for (int i = 0; i < 2000; ++i) {
    const auto s = sample(random, 10 * um, 1e-4, 1600.);
    for (const auto& g : s.rows) {
      const double A = 0.04 * g.ball_diameter, F_per_speed2 = 0.5 * g.ball_mass * g.pitch_diameter;
      const double B_x = g.direction * (A * std::sin(g.contact_angle) + g.preload_offset),
                   B_r = A * std::cos(g.contact_angle) - g.radial_clearance;
      const InertialRow row = inertial_row(g.inner.stiffness, g.outer.stiffness, 0.5 * A, 0.5 * A,
                                           g.ball_diameter / g.pitch_diameter, g.inner_gyroscopic_share, B_x, B_r);
      InertialBalls w;
      w.n = 24;
      for (std::size_t j = 0; j < w.n; ++j) {
        const double b = 2. * pi * static_cast<double>(j) / 24.;
        w.added_i[j] = w.added_o[j] = s.in.ball_growth;
        w.B_x[j] = B_x;
        w.B_r[j] = B_r + s.in.displacement.y * std::cos(b) + s.in.displacement.z * std::sin(b);
      }
      const double F_0 = F_per_speed2 * s.in.ring_speed * s.in.ring_speed;
      // A table takes a millisecond: every tenth row.
      if (i % 10 == 0) {
        const InertialStarts starts(row, F_per_speed2);
        balance_balls(row, F_0, w, &starts);
        steps[0] += 10. * w.steps.most;
        by_scalar[0] += 10 * w.steps.by_scalar_law;
      }
      balance_balls(row, F_0, w);
      steps[1] += w.steps.most;
      by_scalar[1] += w.steps.by_scalar_law;
      ++n;
    }
  }
  printf("%d rows: %.2f steps from the table, %d rows by the scalar law; from the guess %.2f, %d\n", n, steps[0] / n,
         by_scalar[0], steps[1] / n, by_scalar[1]);
  EXPECT_EQ(by_scalar[0], 0);
  EXPECT_LT(steps[0] / n, 4.);
  EXPECT_LT(by_scalar[1], 0.01 * n);
  EXPECT_LT(steps[1] / n, 8.);
}

TEST(InertialRow, BallsThatNewtonsMethodDoesNotBringToBalanceTakeTheScalarLaw) {
  // Grooves up to 0.2 mm from where they belong, ten times as far as rings get in a drop.
  std::mt19937 random(29);
  std::uniform_real_distribution<double> one(-1, 1);
  const double A = 0.04 * 12.7e-3, reach = 200 * um;
  int n_by_scalar = 0;
  double worst = 0.;
  for (int i = 0; i < 600; ++i) {
    const double speed = i % 2 ? 30. : 1600., F_0 = 0.5 * 8e-3 * 90e-3 * speed * speed;
    const InertialRow row = inertial_row(2.8e10, 2.4e10, 0.5 * A, 0.5 * A, 0.14, i % 3 ? 0. : 0.5,
                                         A * std::sin(15 * deg), A * std::cos(15 * deg));
    InertialBalls w;
    w.n = 8;
    for (std::size_t j = 0; j < w.n; ++j) {
      w.B_x[j] = A * std::sin(15 * deg) + reach * one(random);
      w.B_r[j] = A * std::cos(15 * deg) + reach * one(random);
      w.added_i[j] = w.added_o[j] = 0.1 * reach * one(random);
    }
    balance_balls(row, F_0, w);
    n_by_scalar += w.steps.by_scalar_law;
    for (std::size_t j = 0; j < w.n; ++j) {
      const BallContacts contacts{row.K_i, row.K_o, row.l_i - w.added_i[j],    row.l_o - w.added_o[j], 2. * F_0,
                                  row.g,   1.,      row.inner_gyroscopic_share};
      const BallBalance b = ball_balance(contacts, w.B_x[j], w.B_r[j], 0., 1.);
      worst = std::max(worst, std::fabs(w.Q_i[j] - b.load_i) / (b.load_o + 1e-6));
    }
  }
  printf("%d of 600 vectors by the scalar law; worst load off by %.1e of its ball's\n", n_by_scalar, worst);
  EXPECT_GT(n_by_scalar, 100);
  EXPECT_LT(n_by_scalar, 300) << "from the closed guess, wherever the grooves lie, most arrive";
  EXPECT_LT(worst, 1e-6) << "the last step squares what is left, 2e-5 at most";
}

TEST(InertialRow, StandingRingsHaveBallsWithoutInertia) {
  std::mt19937 random(18);
  for (int i = 0; i < 100; ++i) {
    auto s = sample(random, 5 * um, 1e-4, 0.);
    s.in.rate = {0.01, -0.02, 0.03, 0.1, -0.2};
    for (auto g : s.rows) {
      g.damping_beta = 2.5e-5;
      BallRowOutput still, slow, plain;
      BallRow(g, {}).evaluate(s.in, still);
      s.in.ring_speed = 2e-4;
      BallRow(g, {}).evaluate(s.in, slow);
      s.in.ring_speed = 0.;
      g.has_inertia = false;
      BallRow(g, {}).evaluate(s.in, plain);
      EXPECT_EQ(still.force_y, plain.force_y);
      EXPECT_EQ(still.damping_power, plain.damping_power);
      const double scale = plain.elastic_normal + 1e-3;
      EXPECT_NEAR(slow.force_x, plain.force_x, 1e-8 * scale) << "N";
      EXPECT_NEAR(slow.force_y, plain.force_y, 1e-8 * scale) << "N";
      EXPECT_NEAR(slow.moment_z, plain.moment_z, 1e-8 * scale) << "N m";
      EXPECT_NEAR(slow.damping_power, plain.damping_power, 1e-8 * scale) << "W";
      EXPECT_NEAR(slow.elastic_radial, plain.elastic_radial, 1e-8 * scale) << "N";
      EXPECT_NEAR(slow.elastic_normal, plain.elastic_normal, 1e-8 * scale) << "N";
      EXPECT_NEAR(slow.elastic_axial, plain.elastic_axial, 1e-8 * scale) << "N";
      EXPECT_NEAR(slow.elastic_outer_surplus, 0., 1e-8 * scale) << "N";
    }
  }
}

TEST(InertialRow, BallsOutOfTheInnerRacesReachAskNoGyroscopicTractionOfIt) {
  // T_g over a contact's load is below 0.2 tan(phi_i / 2) at the outer race; of a moment that both races share, half of 0.4 F_c sin phi_o goes with the
  // inner load: in the balance across the outer normal, Q_i sin(phi_i - phi_o) = F_c sin phi_o (1.4 - 0.2 (1 + cos(phi_i - phi_o))), so T_i <= 0.2 Q_i.
  std::mt19937 random(41);
  int n_free = 0;
  for (int i = 0; i < 200; ++i) {
    auto s = sample(random, 50 * um, 50 * um / 42.5e-3, 1600.);
    s.in.cage_speed = 0.45 * s.in.ring_speed;
    for (auto& g : s.rows) {
      g.inner_gyroscopic_share = 0.5;
      const BallRow r(g, {});
      std::vector<double> load(static_cast<std::size_t>(g.n_balls));
      r.ball_loads(s.in, load);
      n_free += static_cast<int>(std::ranges::count(load, 0.));
      BallRowOutput out;
      RowTractions tractions;
      r.evaluate(s.in, out, &tractions);
      EXPECT_LT(tractions.largest_gyroscopic_over_load, 0.2);
      EXPECT_LE(tractions.inner_gyroscopic, 0.2 * tractions.inner_load * (1. + 1e-3) + 1e-4)
          << "N; roundoff of unloaded balls";
    }
  }
  EXPECT_GT(n_free, 300);
}

TEST(InertialRow, TractionsAndTruncationAreThoseOfEveryBallsBalance) {
  std::mt19937 random(43);
  int n_truncated = 0, n_shared = 0;
  for (int i = 0; i < 300; ++i) {
    auto s = sample(random, 20 * um, 20 * um / 42.5e-3, 1600.);
    s.in.cage_speed = 0.45 * s.in.ring_speed;
    for (auto& g : s.rows)
      for (auto* race : {&g.inner, &g.outer}) {
        race->groove_radius = 0.52 * g.ball_diameter;
        race->edge_sine = std::sin(32. * deg);
        race->edge_cosine = std::cos(32. * deg);
      }
    const RingStatics ring(s.rows, surroundings(s.in));
    const auto& e = s.in.displacement;
    RingVector q;
    q << e.x, e.y, e.z, e.psi_y, e.psi_z, 0.;
    const auto balls = ring.balls(q);
    for (std::size_t k = 0; k < s.rows.size(); ++k) {
      const auto& g = s.rows[k];
      const BallRow r(g, {});
      BallRowOutput out;
      RowTractions found;
      r.evaluate(s.in, out, &found);
      const double F_c = r.numbers().centrifugal_force(s.in), share = g.inner_gyroscopic_share;
      double inner = 0., outer = 0., T = 0., demand = 0., truncation = 0.;
      for (const auto& ball : balls[k]) {
        const BallBalance& b = ball.balance;
        const double T_g = 0.4 * F_c * std::fabs(b.sin_o);
        inner += b.load_i;
        outer += b.load_o;
        T += T_g;
        demand = std::max(demand, (1. - share) * T_g / b.load_o);
        if (b.load_i > least_share_of_load * b.load_o) demand = std::max(demand, share * T_g / b.load_i);
        truncation = std::max({truncation, g.inner.truncation(b.load_i, b.sin_i, b.cos_i),
                               g.outer.truncation(b.load_o, b.sin_o, b.cos_o)});
      }
      // The scalar balance and the row's agree to 1e-6 of a ball's load.
      EXPECT_NEAR(found.inner_load, inner, 1e-5 * outer);
      EXPECT_NEAR(found.outer_load, outer, 1e-5 * outer);
      EXPECT_NEAR(found.gyroscopic, (1. - share) * T, 1e-5 * (T + F_c));
      EXPECT_NEAR(found.inner_gyroscopic, share * T, 1e-5 * (T + F_c));
      EXPECT_NEAR(found.largest_gyroscopic_over_load, demand, 1e-3 * demand + 1e-5) << "a lightly loaded ball decides";
      // The part of an axis beyond the edge, by a load and an angle that differ by as little.
      EXPECT_NEAR(found.truncation, truncation, 1e-5);
      EXPECT_EQ(found.centrifugal, F_c);
      n_truncated += truncation > 0.01;
      n_shared += share > 0.;
    }
  }
  EXPECT_GT(n_truncated, 50);
  EXPECT_GT(n_shared, 50);
}

TEST(InertialRow, AnswersDependOnTheStateAlone) {
  // The same state after another one, and in another place of memory: the same bits.
  std::mt19937 random(19);
  for (int i = 0; i < 20; ++i) {
    const auto s = sample(random, 10 * um, 1e-4, 1600.), other = sample(random, 30 * um, 1e-4, 1000.);
    const BallRow first(s.rows[0], {}), second(s.rows[0], {});
    BallRowOutput a, b, c;
    first.evaluate(s.in, a);
    first.evaluate(other.in, c);
    first.evaluate(s.in, c);
    second.evaluate(s.in, b);
    for (const auto& o : {b, c}) {
      EXPECT_EQ(a.force_y, o.force_y);
      EXPECT_EQ(a.moment_z, o.moment_z);
      EXPECT_EQ(a.inertia_power, o.inertia_power);
    }
  }
}

}  // namespace
}  // namespace rotordrop
