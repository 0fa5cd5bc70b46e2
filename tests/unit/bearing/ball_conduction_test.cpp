// What rows of balls conduct: the sums of their loads' roots that the kernels make, and a bearing's conductances, against its single balls.
#include <gtest/gtest.h>

#include <random>

#include "../../verification/bearing/test_bearings.h"
#include "bearing/statics/ring_statics.h"
#include "laws/ball_kinematics.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

BallRowInput input(std::mt19937& random, bool tilting) {
  std::uniform_real_distribution<double> one(-1, 1);
  BallRowInput in;
  in.displacement = {0., 25 * um * one(random), 25 * um * one(random), 0., 0.};
  if (tilting)
    in.displacement = {10 * um * one(random), 25 * um * one(random), 25 * um * one(random), 2e-4 * one(random),
                       2e-4 * one(random)};
  in.cage_angle = 7. * one(random);
  in.cage_cosine = std::cos(in.cage_angle);
  in.cage_sine = std::sin(in.cage_angle);
  in.ring_speed = 1500. * one(random);
  in.radial_growth = 2 * um * one(random);
  return in;
}

TEST(LoadRoots, AreThoseOfTheRowsBalls) {
  std::mt19937 random(5);
  for (auto g : {deep_groove_row(), angular_contact_pair(290.)[0], angular_contact_pair(290.)[1]})
    for (int i = 0; i < 200; ++i) {
      const bool tilting = i % 2;
      const BallRow row(g, {{true, 2, 1e-6, 0.3}});
      const auto in = input(random, tilting);
      BallRowOutput out;
      tilting ? row.evaluate(in, out) : row.evaluate_translations(in, out);
      std::vector<double> loads(static_cast<std::size_t>(g.n_balls));
      row.ball_loads(in, loads);  // the rates are zero, so none of it is damping
      double roots = 0., sum = 0.;
      for (const double Q : loads) {
        roots += std::cbrt(Q);
        sum += Q;
      }
      EXPECT_NEAR(out.inner_load_roots, roots, 1e-10 * (1. + roots));
      EXPECT_NEAR(out.inner_loads, sum, 1e-10 * (1. + sum));
      EXPECT_EQ(out.outer_load_roots, out.inner_load_roots);
      EXPECT_EQ(out.outer_loads, out.inner_loads);
    }
}

TEST(LoadRoots, OfBallsWithInertiaDifferFromRaceToRace) {
  std::mt19937 random(7);
  for (auto g : {deep_groove_row(), angular_contact_pair(290.)[0]}) {
    g.has_inertia = g.conducts = true;
    const BallRow row(g, {});
    for (int i = 0; i < 50; ++i) {
      const auto in = input(random, true);
      BallRowOutput out;
      row.evaluate(in, out);
      const RingStatics ring({g}, {in.radial_growth, in.ball_growth, in.ring_speed, true, in.cage_angle});
      RingVector q;
      q << in.displacement.x, in.displacement.y, in.displacement.z, in.displacement.psi_y, in.displacement.psi_z, 0.;
      double inner_roots = 0., outer_roots = 0., outer = 0.;
      const auto balls = ring.balls(q)[0];
      for (const auto& ball : balls) {
        inner_roots += std::cbrt(ball.balance.load_i);
        outer_roots += std::cbrt(ball.balance.load_o);
        outer += ball.balance.load_o;
      }
      // The drop's balance follows the scalar law to 1e-6 of the loads (inertial_row_test.cpp).
      EXPECT_NEAR(out.inner_load_roots, inner_roots, 1e-3 * (1. + inner_roots));
      EXPECT_NEAR(out.outer_load_roots, outer_roots, 1e-3 * outer_roots);
      EXPECT_NEAR(out.outer_loads, outer, 1e-4 * outer);
      EXPECT_GT(out.outer_loads, out.inner_loads) << "centrifugal forces";
    }
  }
}

TEST(TouchdownBearing, ConductsByTheLoadsAndTheSpeedOfItsBalls) {
  const ConductingBody ring{46., 7800. * 470.};
  auto data = touchdown("TB2", angular_contact_pair(290.));
  const auto& g = data.rows.front();
  data.conduction = RowConduction{contact_conduction(ring, ring, g.inner.axis_factor, g.inner.ellipticity, 0., 0.14),
                                  contact_conduction(ring, ring, g.outer.axis_factor, g.outer.ellipticity, 0., 0.14),
                                  repeating_track_conductance(46., 0.5 * g.ball_diameter, 0.4e-3)};
  const TouchdownBearing bearing(data);
  const std::size_t n = bearing.state_entries().size();
  std::vector<double> y(n), dydt(n), ledger(bearing.ledger_entries().size());
  bearing.initial_state(y);
  const auto evaluate = [&](double omega, double y_shift) {
    auto state = y;
    state[TouchdownBearing::ring_spin] = omega;
    state[TouchdownBearing::ring_y] += y_shift;
    std::vector<double> loads(46);
    SupportInput in;
    in.journal.y = state[TouchdownBearing::ring_y];
    SupportOutput out;
    out.observed_details = loads;
    bearing.evaluate(in, state, dydt, ledger, out);
    BallConductances exact;
    const double gamma = g.ball_diameter * std::cos(g.contact_angle) / g.pitch_diameter;
    // Speed of the contact over the inner race: ring less cage, at the race's radius.
    const double U = std::fabs(omega) * 0.5 * (1. + gamma) * 0.5 * g.pitch_diameter * (1. - gamma);
    for (const double Q : loads) exact.add(data.conduction->of_balls(1., std::cbrt(Q), std::cbrt(Q), U));
    // A row conducts as equal balls do, for loads as cos^1.5 within 3 %; from race to race over two contacts in series, each with as much.
    EXPECT_NEAR(out.heat.balls.inner_to_ball / exact.inner_to_ball, 1., 0.03) << omega << " " << y_shift;
    EXPECT_NEAR(out.heat.balls.outer_to_ball / exact.outer_to_ball, 1., 0.03);
    EXPECT_NEAR(out.heat.balls.inner_to_outer / exact.inner_to_outer, 1., 0.06);
    return out.heat.balls.inner_to_ball;
  };
  const double at_rest = evaluate(0., 0.), slow = evaluate(50., 0.), fast = evaluate(1500., 0.);
  EXPECT_GT(slow, at_rest);
  EXPECT_GT(fast, 2. * slow);
  EXPECT_NEAR(evaluate(-1500., 0.), fast, 1e-12) << "whichever way it turns";
  evaluate(700., -8 * um);
  evaluate(700., -20 * um);
  data.conduction.reset();
  const TouchdownBearing fixed(data);
  SupportInput in;
  SupportOutput out;
  fixed.evaluate(in, y, dydt, ledger, out);
  EXPECT_EQ(out.heat.balls.inner_to_ball + out.heat.balls.outer_to_ball + out.heat.balls.inner_to_outer, 0.);
}

}  // namespace
}  // namespace rotordrop
