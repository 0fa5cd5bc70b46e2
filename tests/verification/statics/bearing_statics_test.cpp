// Equilibrium of one bearing under load.
//
// WHAT CAN BE CHECKED WITHOUT A PEER. In equilibrium the balls' forces cancel the load: summed here by BallRow, which statics do not use.
// The stiffness is the numerical derivative of those forces. NSK's catalogue gives the stiffness of the 15-degree pair (docs/theory/verification.md).
//
// ONE ROW UNDER AN AXIAL LOAD F moves along x only: Z K delta^1.5 sin phi = F with B_r = A cos phi_0, delta = sqrt(B_r^2 + B_x^2) - A,
// sin phi = B_x / sqrt(B_r^2 + B_x^2).
//
// PRELOAD BY A SPRING. The sprung row carries the spring's force F_0 - k w, whatever grows; so does the other row without load from outside.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <map>
#include <random>

#include "../bearing/numerical_derivative.h"
#include "../bearing/test_bearings.h"
#include "bearing/statics/bearing_statics.h"
#include "bearing/statics/ring_equilibrium.h"
#include "integrate/equilibrium.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

struct Solved {
  EquilibriumResult result;
  RingReport report;
  RingVector place = RingVector::Zero();
};

Solved solve(const std::vector<BallRowGeometry>& rows, const RingSurroundings& around, const Force& load,
             std::optional<PreloadSpring> spring = {}, RingVector start = RingVector::Zero()) {
  BearingEquilibrium system(RingStatics(rows, around, spring), load);
  std::vector<double> x(start.data(), start.data() + system.size());
  Solved s;
  s.result = find_equilibrium(system, x);
  s.place = system.place(x);
  s.report = report_ring(system.ring(), s.place, 1e-6 * system.force_scale());
  return s;
}

/// Forces of balls without inertia by the dynamics' own row.
RingVector row_forces(const std::vector<BallRowGeometry>& rows, const RingSurroundings& around, const RingVector& q) {
  RingVector sum = RingVector::Zero();
  for (const auto& g : rows) {
    BallRowInput in;
    in.displacement = {q[0], q[1], q[2], q[3], q[4]};
    in.radial_growth = around.radial_growth;
    in.ball_growth = around.ball_growth;
    in.cage_angle = around.cage_angle;
    in.cage_cosine = std::cos(in.cage_angle);
    in.cage_sine = std::sin(in.cage_angle);
    BallRowOutput out;
    BallRow(g, {}).evaluate(in, out);
    sum += (RingVector() << out.force_x, out.force_y, out.force_z, out.moment_y, out.moment_z, 0.).finished();
  }
  return sum;
}

RingVector vector_of(const Force& f) { return (RingVector() << f.x, f.y, f.z, f.moment_y, f.moment_z, 0.).finished(); }

struct RandomCase {
  std::string name;
  std::vector<BallRowGeometry> rows;
  RingSurroundings around;
  Force load;
  std::optional<PreloadSpring> spring;
  RingVector start = RingVector::Zero();
  double preload = 0;
};

/// Loads up to C0/2, preload 0 to 2000 N, ring temperatures that differ by up to 50 K, starts off by up to 100 um and 1 mrad. One in ten
/// has no load at all, so that rings float where nothing presses them.
RandomCase random_case(std::mt19937& random) {
  std::uniform_real_distribution<double> one(-1, 1), part(0, 1);
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  RandomCase c;
  const double preload = pick(5) == 0 ? 0. : 2000. * part(random);
  c.preload = preload;
  const int kind = pick(6);
  double C0 = 62e3;
  const auto one_row = [&](double angle) {
    return row(23, angle > 20 * deg ? 9.525e-3 : 8.731e-3, 85e-3, angle, steel);
  };
  const double angle = pick(2) ? 25 * deg : 15 * deg;
  if (kind == 0) {
    c.name = "deep groove";
    c.rows = {deep_groove_row()};
    c.rows[0].radial_clearance = 30 * um * one(random) + 10 * um;
    C0 = 31e3;
  } else if (kind == 1) {
    c.name = "single";
    c.rows = {one_row(angle)};
    C0 = 31e3;
  } else {
    const Pair arrangement = kind == 2 ? Pair::tandem : kind % 2 ? Pair::X : Pair::O;
    c.name = kind == 2 ? "tandem" : kind % 2 ? "X" : "O";
    const bool sprung = kind != 2 && pick(3) == 0;
    c.rows = pair(one_row(angle), sprung || kind == 2 ? 0. : preload, arrangement);
    if (sprung) c.spring = PreloadSpring{preload, pick(2) ? 0. : 1e7 * part(random)};
    if (sprung) c.name += ", spring";
  }
  const double temperature = 50. * one(random);
  c.around.radial_growth = 11.8e-6 * 39e-3 * temperature;
  c.around.ball_growth = 11.8e-6 * 4.76e-3 * 50. * one(random);
  c.around.cage_angle = pi * one(random);
  c.around.has_inertia = pick(2) == 0;
  c.around.speed = c.around.has_inertia ? 1600. * part(random) : 0.;
  if (pick(10) != 0) {
    const Eigen::Vector3d direction = Eigen::Vector3d(one(random), one(random), one(random)).normalized();
    const Eigen::Vector3d F = std::pow(10., -3. * part(random)) * 0.5 * C0 * direction;
    const double arm = 5e-3 * part(random);
    c.load = {F[0], F[1], F[2], F[1] * arm * one(random), F[2] * arm * one(random), 0.};
  }
  if (kind == 1 || kind == 2) c.load.x += preload;  // rows that lean one way are pressed on from outside
  c.start << 100 * um * one(random), 100 * um * one(random), 100 * um * one(random), 1e-3 * one(random),
      1e-3 * one(random), 0.;
  return c;
}

TEST(BearingStatics, FindsTheEquilibriumOfAThousandRandomCases) {
  constexpr unsigned seed = 20190611;
  std::mt19937 random(seed);
  std::map<std::string, std::array<int, 4>> count;
  double worst = 0., worst_peer = 0.;
  long newton = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto c = random_case(random);
    const auto s = solve(c.rows, c.around, c.load, c.spring, c.start);
    auto& n = count[c.name];
    ++n[0];
    n[1] += s.result.descent_steps > 0;
    n[2] += s.result.continuation_steps > 0;
    n[3] += s.report.is_floating;
    newton += s.result.newton_steps;
    EXPECT_TRUE(s.result.found) << "case " << i << ", " << c.name << ": residual " << s.result.residual
                                << " of its forces";
    worst = std::max(worst, s.result.residual);
    for (const auto& r : s.report.rows)
      for (const auto& ball : r.balls) EXPECT_LE(ball.residual, 1e-6 * ball.outer.load + 1e-12) << "N, case " << i;
    if (c.around.speed == 0. && !c.spring) {
      const RingVector left = row_forces(c.rows, c.around, s.place) + vector_of(c.load);
      double largest = std::max(1., c.preload);
      for (const auto& r : s.report.rows) largest = std::max(largest, r.largest_load);
      const double scale = std::max(largest, vector_of(c.load).head<3>().norm());
      worst_peer = std::max(worst_peer, left.head<3>().norm() / scale);
    }
  }
  printf("seed %u: worst residual %.1e of the forces (by the dynamics' rows %.1e), %.1f Newton steps in the mean\n",
         seed, worst, worst_peer, static_cast<double>(newton) / 1000.);
  for (const auto& [name, n] : count)
    printf("  %-12s %4d cases, %3d by way of descent, %3d of continuation, %3d floating\n", name.c_str(), n[0], n[1],
           n[2], n[3]);
  EXPECT_LT(worst_peer, 1e-7);
  int floating = 0;
  for (const auto& [name, n] : count) floating += n[3];
  EXPECT_GT(floating, 10) << "unloaded rings are among the cases";
}

TEST(BearingStatics, StiffnessIsTheDerivativeOfTheForces) {
  std::mt19937 random(5);
  int checked = 0;
  double worst = 0.;
  while (checked < 60) {
    auto c = random_case(random);
    c.around.radial_growth *= 0.1;
    const auto s = solve(c.rows, c.around, c.load, c.spring);
    // Where a ball just touches, forces are not smooth enough for differences.
    bool smooth = s.result.found;
    for (const auto& r : s.report.rows)
      for (const auto& ball : r.balls)
        smooth =
            smooth && (ball.inner.load == 0. || ball.inner.load > 2.) && r.n_loaded == static_cast<int>(r.balls.size());
    if (!smooth) continue;
    ++checked;
    const RingStatics ring(c.rows, c.around, c.spring);
    const RingMatrix K = ring.reaction(s.place).stiffness;
    const RingVector scale = ring.scales();
    RingMatrix numerical;
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 6; ++i)
        numerical(i, j) = -derivative(
                              [&](double h) {
                                RingVector q = s.place;
                                q[j] += h * scale[j];
                                return ring.reaction(q).force[i];
                              },
                              0.01) /
                          scale[j];
    const RingMatrix units = scale.asDiagonal();
    const RingMatrix error = units * (numerical - K) * units, size = units * K * units;
    worst = std::max(worst, error.cwiseAbs().maxCoeff() / size.cwiseAbs().maxCoeff());
    if (!c.around.has_inertia) {
      EXPECT_LT((size - size.transpose()).cwiseAbs().maxCoeff(), 1e-12 * size.cwiseAbs().maxCoeff());
    }
  }
  printf("worst of 60: %.1e of the largest entry\n", worst);
  EXPECT_LT(worst, 1e-6);
}

TEST(BearingStatics, StiffnessOfA15DegreePairIsTheCatalogues) {
  const auto one = row(23, 8.731e-3, 85e-3, 15 * deg, steel);
  struct Line {
    double preload, axial, factor;
  };
  printf("preload [N]  axial: catalogue, model [N/um]  radial/axial: catalogue, model\n");
  for (const auto& l : {Line{100., 59., 6.5}, {200., 79., 6.0}, {490., 119., 5.0}, {980., 168., 4.5}}) {
    const auto s = solve(pair(one, l.preload, Pair::O), {}, {});
    ASSERT_TRUE(s.result.found);
    const double axial = s.report.stiffness[0][0] * 1e-6, radial = s.report.stiffness[1][1] * 1e-6;
    printf("%11.0f  %16.0f %8.2f (%+.1f %%)   %16.1f %8.3f (%+.1f %%)\n", l.preload, l.axial, axial,
           100. * (axial / l.axial - 1.), l.factor, radial / axial, 100. * (radial / axial / l.factor - 1.));
    EXPECT_NEAR(axial, l.axial, 0.04 * l.axial) << "N/um";
    // The factors have two digits, and how the catalogue finds them is not known here; the model lies 3 to 8 % below.
    EXPECT_NEAR(radial / axial, l.factor, 0.1 * l.factor);
    EXPECT_NEAR(s.report.preload, l.preload, 1e-6 * l.preload) << "N";
  }
}

TEST(BearingStatics, OneRowYieldsToAnAxialLoadAsInClosedForm) {
  const auto g = row(23, 9.525e-3, 85e-3, 25 * deg, steel);
  const double F = 3000.;
  const auto s = solve({g}, {}, {.x = F});
  ASSERT_TRUE(s.result.found);
  const double A = 0.04 * g.ball_diameter, Br = A * std::cos(25 * deg), Bx = A * std::sin(25 * deg) + s.report.place[0];
  const double B = std::hypot(Br, Bx), delta = B - A;
  EXPECT_NEAR(23 * g.stiffness * std::pow(delta, 1.5) * Bx / B, F, 1e-7 * F) << "N";
  EXPECT_NEAR(s.report.place[1], 0., 1e-12) << "m";
  // Hertz: a b and the pressure of the inner contact from its own formulas.
  const double Q = F / 23 / (Bx / B);
  const auto c = inner_race_contact(g.ball_diameter, 42.5e-3 - 0.5 * g.ball_diameter * std::cos(25 * deg), 0.52);
  const double a =
      semi_major_axis_factor(c, effective_modulus(steel, steel), EllipticIntegrals::brewe_hamrock) * std::cbrt(Q);
  const double b = a / contact_ellipse(c, EllipticIntegrals::brewe_hamrock).k;
  EXPECT_NEAR(s.report.rows[0].balls[0].inner.pressure, 1.5 * Q / (pi * a * b), 1e-6 * 1e9) << "Pa";
  EXPECT_NEAR(s.report.rows[0].balls[0].inner.angle, std::asin(Bx / B), 1e-9) << "rad";
}

TEST(BearingStatics, ASpringKeepsThePreloadThatGrowthWouldRaise) {
  const auto one = row(23, 9.525e-3, 85e-3, 25 * deg, steel);
  RingSurroundings warm;
  warm.radial_growth = 5 * um;
  const double rigid = solve(pair(one, 290.), warm, {}).report.preload;
  const auto soft = solve(pair(one, 0.), warm, {}, PreloadSpring{290., 0.});
  const auto stiff = solve(pair(one, 0.), warm, {}, PreloadSpring{290., 1e7});
  printf("preload after 5 um of growth: rigid %.1f N, spring of 10 N/um %.1f N, constant force %.1f N\n", rigid,
         stiff.report.preload, soft.report.preload);
  EXPECT_NEAR(soft.report.preload, 290., 1e-6 * 290.) << "N";
  EXPECT_NEAR(stiff.report.preload, 290. - 1e7 * stiff.report.spring_travel, 1e-6 * 290.) << "N";
  EXPECT_GT(stiff.report.preload, 300.) << "N";
  EXPECT_LT(stiff.report.preload, rigid) << "N";
  EXPECT_NEAR(rigid, 1630., 0.03 * 1630.) << "N, docs/theory/model.md";
}

TEST(BearingStatics, ARingWithoutLoadInItsClearanceFloats) {
  auto g = deep_groove_row();
  const auto s = solve({g}, {}, {});
  EXPECT_TRUE(s.result.found);
  EXPECT_TRUE(s.report.is_floating);
  EXPECT_EQ(s.report.n_free, 5);
  EXPECT_EQ(s.report.rows[0].largest_load, 0.);
  const auto pressed = solve({g}, {}, {.y = -100.});
  EXPECT_TRUE(pressed.result.found);
  EXPECT_FALSE(pressed.report.is_floating);
  EXPECT_LT(pressed.report.place[1], -19 * um) << "m";
}

TEST(BearingStatics, TheDynamicsStartFromTheSameRest) {
  // ring_equilibrium() has its own rows and its own search.
  for (const auto& rows : {std::vector{deep_groove_row()}, angular_contact_pair(290.)})
    for (const Force& load : {Force{300., -500., 100., 0., 0.}, Force{-2000., -20., 0., 3., -2.}}) {
      std::vector<BallRow> balls;
      for (const auto& row : rows) balls.emplace_back(row, std::vector<RaceWave>{});
      const auto rest = ring_equilibrium(balls, load, true);
      const auto solved = solve(rows, {}, load);
      EXPECT_NEAR(rest.x, solved.place[0], 1e-10) << "m: both leave 1e-9 of the load, over at least 10 N/um";
      EXPECT_NEAR(rest.y, solved.place[1], 1e-10);
      EXPECT_NEAR(rest.z, solved.place[2], 1e-10);
      // 1e-10 m over a lever of some 10 mm
      EXPECT_NEAR(rest.psi_y, solved.place[3], 1e-8) << "rad";
      EXPECT_NEAR(rest.psi_z, solved.place[4], 1e-8);
    }
}

TEST(BearingStatics, InertiaVanishesWithTheSpeed) {
  std::mt19937 random(8);
  for (int i = 0; i < 30; ++i) {
    auto c = random_case(random);
    c.around.has_inertia = false;
    c.around.speed = 0.;
    const RingStatics plain(c.rows, c.around, c.spring);
    auto slow = c.around;
    slow.has_inertia = true;
    const RingStatics still(c.rows, slow, c.spring);
    slow.speed = 1e-4;
    const RingStatics creeping(c.rows, slow, c.spring);
    const RingVector q = 0.3 * c.start;
    const RingVector F = plain.reaction(q).force;
    EXPECT_EQ((still.reaction(q).force - F).norm(), 0.) << "N";
    EXPECT_LT((creeping.reaction(q).force - F).norm(), 1e-8 * F.norm() + 1e-9) << "N";
  }
}

}  // namespace
}  // namespace rotordrop
