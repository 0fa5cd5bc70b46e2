// Rows of balls with inertia whose grooves' centres stay in one plane (contact angle zero, the ring only translates): the one equation that is left of
// each ball's balance, against bisection and against the general form.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "bearing/row/ball_row.h"
#include "test_bearings.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

BallRowGeometry radial_row(double inner_share) {
  auto g = deep_groove_row();
  g.has_inertia = g.conducts = true;
  g.inner_gyroscopic_share = inner_share;
  g.damping_beta = 2.5e-5;
  for (auto* race : {&g.inner, &g.outer}) {
    race->groove_radius = 0.52 * g.ball_diameter;
    race->edge_sine = std::sin(3. * deg);  // so near that loaded ellipses pass it
    race->edge_cosine = std::cos(3. * deg);
  }
  return g;
}

BallRowInput random_input(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> one(-1, 1);
  BallRowInput in;
  in.displacement = {0., reach * one(random), reach * one(random), 0., 0.};
  in.rate = {0., 0.5 * one(random), 0.5 * one(random), 0., 0.};
  in.cage_angle = 7. * one(random);
  in.cage_cosine = std::cos(in.cage_angle);
  in.cage_sine = std::sin(in.cage_angle);
  in.ring_speed = 900. + 700. * one(random);
  in.cage_speed = 0.43 * in.ring_speed;
  in.ring_angle = 7. * one(random);
  in.radial_growth = 3 * um * one(random);
  in.ball_growth = 1 * um * one(random);
  in.inner_strain = 1e-3 * one(random);
  in.outer_strain = 1e-3 * one(random);
  return in;
}

std::vector<double> numbers(const BallRowOutput& o) {
  return {o.force_x,
          o.force_y,
          o.force_z,
          o.moment_y,
          o.moment_z,
          o.damping_power,
          o.elastic_radial,
          o.elastic_axial,
          o.elastic_normal,
          o.cage_torque,
          o.waviness_power,
          o.largest_load,
          o.inner_loads,
          o.outer_loads,
          o.inertia_power,
          o.elastic_outer_surplus,
          o.inner_load_roots,
          o.outer_load_roots,
          o.largest_outer_load,
          o.inertia_per_speed};
}
std::vector<double> numbers(const RowTractions& t) {
  return {t.inner_load,       t.outer_load,  t.gyroscopic, t.largest_gyroscopic_over_load,
          t.inner_gyroscopic, t.centrifugal, t.truncation};
}

TEST(InertialRowInPlane, AgreesWithTheGeneralForm) {
  const std::vector<RaceWave> waves = {{true, 2, 4e-6, 0.3}, {false, 5, 2e-6, 1.}};
  std::mt19937 random(61);
  int n_free = 0, n_truncated = 0, n_bent = 0;
  for (int i = 0; i < 400; ++i) {
    auto g = radial_row(i % 3 ? 0. : 0.5);
    const bool is_bent = i % 5 == 0;
    if (is_bent) g.highest_harmonic = 3;
    const BallRow row(g, i % 2 ? waves : std::vector<RaceWave>{});
    ASSERT_TRUE(row.is_radial());
    auto in = random_input(random, i % 4 ? 25 * um : 70 * um);
    const std::vector shape = {3 * um, -2 * um, 1 * um, 2 * um}, shape_rate = {0.02, 0.01, -0.03, 0.01};
    std::vector<double> on_shapes(shape.size()), in_plane_on_shapes(shape.size());
    if (is_bent) {
      in.shape = shape;
      in.shape_rate = shape_rate;
    }
    BallRowOutput all, in_plane;
    RowTractions all_tractions, tractions;
    if (is_bent) in.shape_force = on_shapes;
    row.evaluate(in, all, &all_tractions);
    if (is_bent) in.shape_force = in_plane_on_shapes;
    row.evaluate_translations(in, in_plane, &tractions);
    auto a = numbers(all), b = numbers(in_plane);
    a[3] = a[4] = 0.;  // the short one leaves the moments at zero
    // Each form leaves at most the square of 2e-5 of a ball's load, and work that is a power of it by the fastest thing that moves.
    const double load = all.outer_loads + 1e-3, speed = std::fabs(in.cage_speed) * 1e-4 + 1.;
    for (std::size_t k = 0; k < a.size(); ++k)
      EXPECT_NEAR(a[k], b[k], 1e-8 * load * speed + 1e-7 * std::fabs(a[k])) << "member " << k;
    a = numbers(all_tractions), b = numbers(tractions);
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-7 * load) << "traction " << k;
    for (std::size_t k = 0; k < shape.size(); ++k) EXPECT_NEAR(on_shapes[k], in_plane_on_shapes[k], 1e-8 * load);
    n_bent += on_shapes[0] != 0.;
    std::vector<double> loads(row.n_balls());
    row.ball_loads(in, loads);
    n_free += static_cast<int>(std::ranges::count(loads, 0.));
    n_truncated += tractions.truncation > 0.01;
  }
  EXPECT_GT(n_free, 1000) << "of 5600 balls";
  EXPECT_GT(n_truncated, 100) << "of 400 rows";
  EXPECT_GT(n_bent, 40) << "of 80 between bent rings";
}

TEST(InertialRowInPlane, LoadsSolveTheOneEquationAlsoPastTheInnerGroovesCentre) {
  std::mt19937 random(67);
  int n_past = 0;
  for (int i = 0; i < 200; ++i) {
    const auto g = radial_row(0.);
    const BallRow row(g, {});
    auto in = random_input(random, 20 * um);
    in.rate = {};
    in.inner_strain = in.outer_strain = 0.;
    if (i % 2) in.displacement.y = 0.4e-3;  // inner grooves' centres of some balls on the far side of them
    BallRowOutput out;
    row.evaluate_translations(in, out);
    const double K_i = g.inner.stiffness, K_o = g.outer.stiffness, l = 0.02 * g.ball_diameter,
                 ratio = 0.5 * (1. - g.ball_diameter / g.pitch_diameter);
    const double F = 0.5 * g.ball_mass * g.pitch_diameter * std::pow(in.ring_speed * ratio, 2);
    double inner = 0., outer = 0., fy = 0., fz = 0.;
    for (int j = 0; j < g.n_balls; ++j) {
      const double b = g.phase + 2. * pi * j / g.n_balls + in.cage_angle;
      const double B_r = 2. * l - g.radial_clearance + in.radial_growth + in.displacement.y * std::cos(b) +
                         in.displacement.z * std::sin(b);
      const auto load = [](double K, double delta) { return delta > 0. ? K * std::pow(delta, 1.5) : 0.; };
      // The centre is at r = l + delta_o - growth; while it grows, the outer load does and the inner one falls.
      const auto inner_load = [&](double delta_o) {
        return load(K_i, B_r - (l + delta_o - in.ball_growth) - l + in.ball_growth);
      };
      double low = 0., high = 3e-3;
      for (int step = 0; step < 200; ++step) {
        const double middle = 0.5 * (low + high);
        (inner_load(middle) + F > load(K_o, middle) ? low : high) = middle;
      }
      const double Q_i = inner_load(low);
      n_past += B_r - (l + low) < 0.;
      inner += Q_i;
      outer += load(K_o, low);
      fy -= Q_i * std::cos(b);
      fz -= Q_i * std::sin(b);
    }
    EXPECT_NEAR(out.inner_loads, inner, 1e-8 * outer) << "N";
    EXPECT_NEAR(out.outer_loads, outer, 1e-8 * outer) << "N";
    EXPECT_NEAR(out.force_y, fy, 1e-8 * outer) << "N";
    EXPECT_NEAR(out.force_z, fz, 1e-8 * outer) << "N";
  }
  EXPECT_GT(n_past, 300);
}

}  // namespace
}  // namespace rotordrop
