// The rotor at rest on its supports.
//
// UNIFORM BEAM under its weight w per length on two springs at its ends: half the weight each; from the line through the ends the middle sags by
//   5 w L^4 / (384 E I) + w L^2 / (8 kappa G A).
// ON TWO SUPPORTS the reactions follow from moments, whatever the bearings do. Rotor on bore without friction: K delta^n = reaction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "../rotor/test_rotors.h"
#include "analysis/statics/statics.h"
#include "case/case.h"
#include "integrate/equilibrium.h"
#include "machine/bearing_data.h"
#include "rotor/static_rotor.h"
#include "rotor/timoshenko.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

Case reference(const std::vector<std::string>& overrides = {}) {
  return read_case(std::string(ROTORDROP_SOURCE_DIR) + "/params/neisi2019.toml", overrides);
}

struct Rest {
  EquilibriumResult result;
  ShaftReport report;
};
Rest rest_of(const Case& c) {
  ShaftEquilibrium system(c.parameters, c.tree);
  std::vector<double> x(system.size());
  const auto result = find_equilibrium(system, x);
  return {result, system.report(x)};
}

TEST(StaticRotor, UniformBeamSagsAsInClosedForm) {
  const double od = 0.1, L = 1., E = 2e11, nu = 0.3, rho = 7850., g = 9.81;
  const auto beam = uniform_beam(8, od);
  const StaticRotor rotor(beam, {1, 9}, {-g, 0.}, {});
  const double A = std::numbers::pi / 4 * od * od, I = std::numbers::pi / 64 * std::pow(od, 4), w = rho * A * g;
  EXPECT_NEAR(rotor.load(0)[0], -0.5 * w * L, 1e-9 * w) << "N";
  EXPECT_NEAR(rotor.load(0)[1], -0.5 * w * L, 1e-9 * w) << "N";
  // Held on two nodes only, the condensed rotor resists nothing: a rigid line can take any place. 1e10 N/m is what cancels.
  EXPECT_LT(rotor.stiffness().cwiseAbs().maxCoeff(), 1.) << "N/m";
  const double sag = 5. * w * std::pow(L, 4) / (384. * E * I) +
                     w * L * L / (8. * cowper_shear_coefficient(nu, 0.) * E / (2. * (1. + nu)) * A);
  const auto v = rotor.deflections(0, Eigen::Vector2d(-1e-3, 1e-3));
  EXPECT_NEAR(v[4], -sag, 1e-7 * sag) << "m, the line's own middle is at 0";
  EXPECT_NEAR(v[0], -1e-3, 0.) << "m";
  EXPECT_NEAR(rotor.deflections(1, Eigen::Vector2d::Zero())[4], 0., 1e-15) << "m";
}

TEST(StaticRotor, ThreeStationsShareTheLoadAsAContinuousBeam) {
  // Equal spans, rigid supports, slender: 3/16, 10/16, 3/16 of the weight; the shear of this beam changes that by (r/L)^2, here 1e-4.
  const auto beam = uniform_beam(8, 0.01);
  const StaticRotor rotor(beam, {1, 5, 9}, {-9.81, 0.}, {});
  const double weight = rigid_body(beam).mass * 9.81;
  const Eigen::VectorXd& on_supports = rotor.load(0);
  EXPECT_NEAR(-on_supports[0] / weight, 3. / 16., 1e-4);
  EXPECT_NEAR(-on_supports[1] / weight, 10. / 16., 1e-4);
  EXPECT_NEAR(-on_supports.sum() / weight, 1., 1e-9);
}

TEST(ShaftStatics, TheReferenceRotorRestsInBothBores) {
  const auto c = reference();
  const auto r = rest_of(c);
  ASSERT_TRUE(r.result.found) << r.result.residual;
  const auto body = rigid_body(c.parameters.rotor.geometry);
  const auto& x = c.parameters.rotor.geometry.node_x;
  const double a = x[1], b = x[27], W = body.mass * 9.81;
  ASSERT_EQ(r.report.supports.size(), 2u);
  const double expected[] = {W * (b - body.centre_of_gravity) / (b - a), W * (body.centre_of_gravity - a) / (b - a)};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& s = r.report.supports[i];
    const auto& bearing = *c.parameters.bearings[i].touchdown();
    EXPECT_NEAR(s.force_on_rotor[0], expected[i], 1e-6 * W) << "N, " << s.name;
    EXPECT_NEAR(s.force_on_rotor[1], 0., 1e-6 * W) << "N, " << s.name;
    EXPECT_NEAR(-s.clearance, std::pow(expected[i] / *bearing.contact_stiffness, 0.9), 1e-12) << "m, " << s.name;
    // Springs of the support carry rotor, inner ring and nothing else... and the balls carry rotor and inner ring.
    const double ring_weight = bearing.ring_mass * 9.81;
    EXPECT_NEAR(s.outer_ring[0], -(expected[i] + ring_weight) / *bearing.support.K_y, 1e-6 * 1e-6) << "m, " << s.name;
    double carried = 0.;
    for (const auto& row : s.ring.rows)
      for (const auto& ball : row.balls)
        carried -= ball.inner.load * std::cos(ball.inner.angle) * std::cos(ball.azimuth);
    EXPECT_NEAR(carried, expected[i] + ring_weight, 1e-5 * W) << "N, " << s.name;
  }
  EXPECT_GT(r.report.sag, 1e-6) << "m";
}

TEST(ShaftStatics, LoadsAndLinearSupportsEnterByTheLeverRule) {
  const std::string file = ::testing::TempDir() + "statics-linear.toml";
  std::ofstream(file) << "base = \"" << ROTORDROP_SOURCE_DIR << R"(/params/neisi2019.toml"
[statics]
loads = [{ node = 10, force = ["-500 N", "200 N"] }]
[bearings.spring]
type = "linear"
node = 15
stiffness = [["2e6 N/m", "5e5 N/m"], ["-5e5 N/m", "1e6 N/m"]]
)";
  const auto c = read_case(file);
  const auto r = rest_of(c);
  ASSERT_TRUE(r.result.found) << r.result.residual;
  double sum_y = 0., sum_z = 0., moment_y = 0., moment_z = 0.;
  const auto& x = c.parameters.rotor.geometry.node_x;
  for (const auto& s : r.report.supports) {
    const double at = x[static_cast<std::size_t>(s.node - 1)];
    sum_y += s.force_on_rotor[0];
    sum_z += s.force_on_rotor[1];
    moment_y += at * s.force_on_rotor[0];
    moment_z += at * s.force_on_rotor[1];
  }
  const auto body = rigid_body(c.parameters.rotor.geometry);
  const double W = body.mass * 9.81;
  EXPECT_NEAR(sum_y, W + 500., 1e-6 * W) << "N";
  EXPECT_NEAR(sum_z, -200., 1e-6 * W) << "N";
  EXPECT_NEAR(moment_y, W * body.centre_of_gravity + 500. * x[9], 1e-6 * W) << "N m";
  EXPECT_NEAR(moment_z, -200. * x[9], 1e-6 * W) << "N m";
  const auto& spring = *std::find_if(r.report.supports.begin(), r.report.supports.end(),
                                     [](const auto& s) { return s.name == "spring"; });
  EXPECT_NEAR(spring.force_on_rotor[0], -2e6 * spring.journal[0] - 5e5 * spring.journal[1], 1e-6) << "N";
  EXPECT_NEAR(spring.force_on_rotor[1], 5e5 * spring.journal[0] - 1e6 * spring.journal[1], 1e-6) << "N";
}

TEST(ShaftStatics, JournalsAndFreeRingsTiltInBalance) {
  const auto c = reference({"bearings.ring_motion=free"});
  const auto r = rest_of(c);
  ASSERT_TRUE(r.result.found) << r.result.residual;
  double force = 0., moment = 0.;
  const auto& x = c.parameters.rotor.geometry.node_x;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& s = r.report.supports[i];
    ASSERT_TRUE(s.moment_on_rotor.has_value());
    const double M = (*s.moment_on_rotor)[1];
    force += s.force_on_rotor[0];
    moment += x[static_cast<std::size_t>(s.node - 1)] * s.force_on_rotor[0] + M;
    EXPECT_LT(s.clearance, 0.) << s.name;
    if (s.ring.rows.size() < 2) continue;  // a deep groove's angles have both signs
    // What the rotor does to the ring the balls do to it in return: about z, x_c F_y - R F_x cos b of each
    // ball, x_c and R to the centre of the inner groove.
    const auto& bearing = *c.parameters.bearings[i].touchdown();
    const double R = 0.5 * bearing.pitch_diameter +
                     (bearing.conformity[0] - 0.5) * bearing.ball_diameter * std::cos(bearing.contact_angle);
    const double beside = (bearing.conformity[0] - 0.5) * bearing.ball_diameter * std::sin(bearing.contact_angle);
    const auto data = touchdown_data_of(c.parameters, c.parameters.bearings[i].name, bearing);
    double of_balls = 0.;
    for (std::size_t k = 0; k < s.ring.rows.size(); ++k) {
      double thrust = 0.;
      for (const auto& ball : s.ring.rows[k].balls) thrust += ball.inner.load * std::sin(ball.inner.angle);
      const double sense = s.ring.rows[k].axial_force / thrust;  // of the row's thrust along x
      EXPECT_NEAR(std::abs(sense), 1., 1e-6) << s.name;
      const double groove = data.rows[k].position + data.rows[k].direction * beside;
      for (const auto& ball : s.ring.rows[k].balls) {
        const double N = ball.inner.load, F_x = sense * N * std::sin(ball.inner.angle);
        of_balls -= std::cos(ball.azimuth) * (groove * N * std::cos(ball.inner.angle) + R * F_x);
      }
    }
    EXPECT_NEAR(of_balls, M, 1e-3 * std::abs(M)) << "N m, " << s.name;
  }
  const auto body = rigid_body(c.parameters.rotor.geometry);
  const double W = body.mass * 9.81;
  EXPECT_NEAR(force, W, 1e-6 * W) << "N";
  EXPECT_NEAR(moment, W * body.centre_of_gravity, 1e-6 * W) << "N m";
  EXPECT_GT(std::abs((*r.report.supports[1].moment_on_rotor)[1]), 1.)
      << "N m: a pair of rows resists the journal's tilt";
}

void expect_stiffness_is_the_derivative(const Case& c) {
  ShaftEquilibrium system(c.parameters, c.tree);
  std::vector<double> x(system.size());
  ASSERT_TRUE(find_equilibrium(system, x).found);
  const std::size_t n = system.size();
  std::vector<double> K(n * n), up(n), down(n);
  system.stiffness(x, K);
  double worst = 0., largest = 0.;
  for (std::size_t j = 0; j < n; ++j) {
    const double h = 1e-3 * system.scales()[j];
    auto moved = x;
    moved[j] = x[j] + h;
    system.forces(moved, up);
    moved[j] = x[j] - h;
    system.forces(moved, down);
    for (std::size_t i = 0; i < n; ++i) {
      const double unit = system.scales()[i] * system.scales()[j];
      worst = std::max(worst, std::fabs(-(up[i] - down[i]) / (2. * h) - K[j * n + i]) * unit);
      largest = std::max(largest, std::fabs(K[j * n + i]) * unit);
    }
  }
  EXPECT_LT(worst, 1e-6 * largest);
}

TEST(ShaftStatics, StiffnessIsTheDerivativeOfTheForces) {
  const std::vector<std::string> more = {"bearings.TB2.preload=900 N", "bearings.TB1.radial_clearance=-12 um",
                                         "bearings.TB2.ball_model=inertial", "statics.speed=12000 rpm"};
  expect_stiffness_is_the_derivative(reference(more));
  auto free = more;
  free.emplace_back("bearings.ring_motion=free");
  free.emplace_back("statics.loads=[{node=20, force=[\"-300 N\", \"400 N\"]}]");
  expect_stiffness_is_the_derivative(reference(free));
}

}  // namespace
}  // namespace rotordrop
