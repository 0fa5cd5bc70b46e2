// The ball row's forces come from one energy.
//
// ORACLE. The inner groove's centre above ball j lies at p = (x_c, R_c cos b, R_c sin b) in the ring's frame, (f_in - 1/2) d from the ball's along the normal:
// R_c = d_m/2 + (f_in - 1/2) d cos phi_0, x_c = x_row + s (f_in - 1/2) d sin phi_0.
// The ring moves by e and tilts by psi = (0, psi_y, psi_z): the centre moves by u = e + psi x p. In the ball's plane (axis x, radial direction
// (0, cos b, sin b)) the groove centres are then apart by
//   B_r = A cos phi_0 - clearance + growth + u . radial,   B_x = s (A sin phi_0 + offset) + u_x,
// and delta_j = |B| - A + 2 eps_b + waves. The energy is U = sum 2/5 K max(delta, 0)^2.5, and
//   force = -dU/de, moment = -dU/dpsi,
//   elastic_radial = dU/d(growth), 2 elastic_normal = dU/d(eps_b),
//   cage_torque = dU/d(cage angle of the balls, waves kept), waviness_power = dU/dt by the waves' travel over the balls.
// All derivatives are numerical, of the energy computed here from cross products.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <limits>
#include <random>

#include "numerical_derivative.h"
#include "test_bearings.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

/// Energy by vectors. Waves' arguments may have a cage angle of their own.
double oracle_energy(const BallRowGeometry& g, const std::vector<RaceWave>& waves, const BallRowInput& in,
                     double wave_cage_angle) {
  const double A = (g.inner_conformity + g.outer_conformity - 1.) * g.ball_diameter;
  const double R_c = 0.5 * g.pitch_diameter + (g.inner_conformity - 0.5) * g.ball_diameter * std::cos(g.contact_angle);
  const double x_c =
      g.position + g.direction * (g.inner_conformity - 0.5) * g.ball_diameter * std::sin(g.contact_angle);
  const auto& q = in.displacement;
  const Eigen::Vector3d e(q.x, q.y, q.z), psi(0, q.psi_y, q.psi_z);
  double U = 0.;
  for (int j = 0; j < g.n_balls; ++j) {
    const double own = g.phase + 2. * pi * j / g.n_balls, b = own + in.cage_angle, b_wave = own + wave_cage_angle;
    const Eigen::Vector3d radial(0, std::cos(b), std::sin(b)), p = Eigen::Vector3d(x_c, 0, 0) + R_c * radial;
    const Eigen::Vector3d u = e + psi.cross(p);
    // Strains move the contact points along the axis, and the grooves' centres away from them.
    const Eigen::Vector2d n(g.direction * std::sin(g.contact_angle), std::cos(g.contact_angle)), along(1, 0);
    const double inner_x = g.position - 0.5 * g.ball_diameter * n[0],
                 outer_x = g.position + 0.5 * g.ball_diameter * n[0];
    const double wider_inner = in.inner_strain * g.inner_conformity * g.ball_diameter,
                 wider_outer = in.outer_strain * g.outer_conformity * g.ball_diameter;
    const Eigen::Vector2d inner_centre = in.inner_strain * inner_x * along + wider_inner * n,
                          outer_centre = in.outer_strain * outer_x * along - wider_outer * n,
                          apart = inner_centre - outer_centre;
    const double B_r = A * std::cos(g.contact_angle) - g.radial_clearance + in.radial_growth + u.dot(radial) + apart[1];
    const double B_x = g.direction * (A * std::sin(g.contact_angle) + g.preload_offset) + u[0] + apart[0];
    double delta = std::hypot(B_r, B_x) - A - wider_inner - wider_outer + 2. * in.ball_growth;
    for (const auto& w : waves)
      delta += w.amplitude * std::sin(w.order * (b_wave - (w.on_inner_race ? in.ring_angle : 0.)) + w.phase);
    U += 0.4 * g.stiffness * std::pow(std::max(delta, 0.), 2.5);
  }
  return U;
}

struct Sample {
  const char* name;
  BallRowGeometry geometry;
  std::vector<RaceWave> waves;
  BallRowInput input;
};

const std::vector<RaceWave> some_waves = {{true, 2, 0.4e-6, 0.3}, {true, 7, 0.2e-6, -1.}, {false, 3, 0.3e-6, 2.}};

void set_cage(BallRowInput& in, double angle) {
  in.cage_angle = angle;
  in.cage_cosine = std::cos(angle);
  in.cage_sine = std::sin(angle);
}

/// Fully loaded rows (smooth in every direction), elastic or with rates; and the deep-groove row with most balls free.
std::vector<Sample> samples(bool with_free_balls) {
  std::vector<Sample> all;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> one(-1, 1);
  auto tight = deep_groove_row();
  tight.radial_clearance = -15 * um;
  auto pair_rows = angular_contact_pair(600.);
  std::vector<std::pair<const char*, BallRowGeometry>> geometries = {
      {"deep groove, tight", tight}, {"X row 1", pair_rows[0]}, {"X row 2", pair_rows[1]}};
  if (with_free_balls) geometries = {{"deep groove with clearance", deep_groove_row()}};
  for (const auto& [name, g] : geometries)
    for (int i = 0; i < 10; ++i) {
      Sample s{name, g, i % 2 ? some_waves : std::vector<RaceWave>{}, {}};
      auto& in = s.input;
      const double tilt = 2.0 * um / 42.5e-3;
      if (with_free_balls)
        in.displacement = {2 * um * one(random), -22 * um, 8 * um * one(random), tilt * one(random),
                           tilt * one(random)};
      else
        in.displacement = {1 * um * one(random), 1.5 * um * one(random), 1.5 * um * one(random),
                           0.5 * tilt * one(random), 0.5 * tilt * one(random)};
      set_cage(in, 10. * one(random));
      in.cage_speed = 700. * one(random);
      in.ring_angle = 10. * one(random);
      in.ring_speed = 1500. * one(random);
      in.radial_growth = 0.7 * um * one(random);
      in.ball_growth = 0.2 * um * one(random);
      in.inner_strain = 2e-5 * one(random);
      in.outer_strain = 2e-5 * one(random);
      all.push_back(s);
    }
  return all;
}

/// The displacement's components, tilts times the pitch radius so that all have one unit.
using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;
constexpr double arm = 42.5e-3;
void displace(BallRowInput& in, int axis, double s) {
  auto& q = in.displacement;
  const std::array<double*, 5> component = {&q.x, &q.y, &q.z, &q.psi_y, &q.psi_z};
  *component[static_cast<std::size_t>(axis)] += axis < 3 ? s : s / arm;
}
Vector5 forces(const BallRow& row, const BallRowInput& in) {
  BallRowOutput out;
  row.evaluate(in, out);
  return Vector5(out.force_x, out.force_y, out.force_z, out.moment_y / arm, out.moment_z / arm);
}
bool all_balls_carry(const BallRow& row, const BallRowInput& in) {
  std::vector<double> load(static_cast<std::size_t>(row.geometry().n_balls));
  row.ball_loads(in, load);
  return *std::min_element(load.begin(), load.end()) > 1.;
}

TEST(BallRow, EnergyIsThatOfGrooveCentresMovedAsARigidBody) {
  for (const bool free : {false, true})
    for (const auto& s : samples(free)) {
      const BallRow row(s.geometry, s.waves);
      const double U = oracle_energy(s.geometry, s.waves, s.input, s.input.cage_angle);
      EXPECT_GT(U, 0.);
      // delta is a difference of lengths of 0.5 mm: roundoff 1e-16 * 500 um / 1 um.
      EXPECT_NEAR(row.energy(s.input), U, 1e-11 * U) << s.name;
    }
}

TEST(BallRow, ForcesAndMomentsAreTheGradientOfTheEnergy) {
  for (const auto& s : samples(false)) {
    const BallRow row(s.geometry, s.waves);
    ASSERT_TRUE(all_balls_carry(row, s.input)) << s.name;
    const Vector5 F = forces(row, s.input);
    for (int axis = 0; axis < 5; ++axis) {
      const double slope = derivative(
          [&](double h) {
            BallRowInput moved = s.input;
            displace(moved, axis, h);
            return oracle_energy(s.geometry, s.waves, moved, moved.cage_angle);
          },
          1e-7);
      EXPECT_NEAR(F[axis], -slope, 1e-8 * F.norm()) << s.name << ", component " << axis;
    }
  }
}

TEST(BallRow, ForcesAreTheGradientOfTheEnergyWhenSomeBallsAreFree) {
  for (const auto& s : samples(true)) {
    const BallRow row(s.geometry, s.waves);
    ASSERT_FALSE(all_balls_carry(row, s.input));
    const Vector5 F = forces(row, s.input);
    ASSERT_GT(F.norm(), 10.) << "N";
    for (int axis = 0; axis < 5; ++axis) {
      const double slope = derivative(
          [&](double h) {
            BallRowInput moved = s.input;
            displace(moved, axis, h);
            return oracle_energy(s.geometry, s.waves, moved, moved.cage_angle);
          },
          3e-9);
      // A ball that just touches is not smooth: 2/5 K (3e-9 m)^2.5 / 3e-9 m = 1e-3 N.
      EXPECT_NEAR(F[axis], -slope, 2e-3) << s.name << ", component " << axis;
    }
  }
}

TEST(BallRow, TangentStiffnessIsSymmetric) {
  for (const auto& s : samples(false)) {
    const BallRow row(s.geometry, s.waves);
    ASSERT_TRUE(all_balls_carry(row, s.input)) << s.name;
    Matrix5 K;
    for (int column = 0; column < 5; ++column)
      for (int i = 0; i < 5; ++i)
        K(i, column) = derivative(
            [&](double h) {
              BallRowInput moved = s.input;
              displace(moved, column, h);
              return -forces(row, moved)[i];
            },
            2e-8);
    const double largest = K.cwiseAbs().maxCoeff();
    EXPECT_LT((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-9 * largest) << s.name << "\n" << K;
    Eigen::SelfAdjointEigenSolver<Matrix5> eigen(K);
    EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-3 * largest)
        << s.name << ": a loaded row resists, but for a small geometric part";
  }
}

TEST(BallRow, GrowthForcesAreTheEnergysDerivativesByGrowth) {
  for (const auto& s : samples(false)) {
    const BallRow row(s.geometry, s.waves);
    BallRowOutput out;
    row.evaluate(s.input, out);
    const double radial = derivative(
        [&](double h) {
          BallRowInput moved = s.input;
          moved.radial_growth += h;
          return oracle_energy(s.geometry, s.waves, moved, moved.cage_angle);
        },
        1e-7);
    const double normal = derivative(
        [&](double h) {
          BallRowInput moved = s.input;
          moved.ball_growth += h;
          return oracle_energy(s.geometry, s.waves, moved, moved.cage_angle);
        },
        5e-8);
    const auto by_strain = row.numbers().strain_gradient(out);
    for (const auto& [strain, gradient] :
         {std::pair{&BallRowInput::inner_strain, by_strain.first}, {&BallRowInput::outer_strain, by_strain.second}}) {
      const double expected = derivative(
          [&](double h) {
            BallRowInput moved = s.input;
            moved.*strain += h;
            return oracle_energy(s.geometry, s.waves, moved, moved.cage_angle);
          },
          1e-5);
      EXPECT_NEAR(gradient, expected, 1e-8 * 10e-3 * normal) << s.name << ": J, arms of 10 mm";
    }
    EXPECT_NEAR(out.elastic_radial, radial, 1e-8 * radial) << s.name;
    EXPECT_NEAR(2. * out.elastic_normal, normal, 1e-8 * normal) << s.name;
  }
}

TEST(BallRow, CageAndWavesWorkIsTheEnergysChangeWithTime) {
  for (const auto& s : samples(false)) {
    const BallRow row(s.geometry, s.waves);
    BallRowOutput out;
    row.evaluate(s.input, out);
    const auto energy_at = [&](double t, bool balls_move, bool waves_move) {
      BallRowInput in = s.input;
      if (balls_move) in.cage_angle += in.cage_speed * t;
      if (waves_move) in.ring_angle += in.ring_speed * t;
      return oracle_energy(s.geometry, s.waves, in, s.input.cage_angle + (waves_move ? in.cage_speed * t : 0.));
    };
    const double cage = derivative([&](double t) { return energy_at(t, true, false); }, 3e-6);
    const double waves = derivative([&](double t) { return energy_at(t, false, true); }, 3e-6);
    const double both = derivative([&](double t) { return energy_at(t, true, true); }, 3e-6);
    const double scale = std::fabs(cage) + std::fabs(waves) + 0.01;
    const double cage_power = s.input.cage_speed * out.cage_torque;
    EXPECT_NEAR(cage_power, cage, 1e-8 * scale) << s.name << " W";
    EXPECT_NEAR(out.waviness_power, waves, 1e-8 * scale) << s.name << " W";
    EXPECT_NEAR(cage_power + out.waviness_power, both, 1e-8 * scale) << s.name << " W";
    if (!s.waves.empty()) {
      EXPECT_GT(std::fabs(out.waviness_power), 0.);
    }
  }
}

TEST(BallRow, DampingIsBetaTimesTheTangentStiffness) {
  // Small rates: extra force = -beta * (tangent stiffness along the normals) * velocity. Against the elastic energy's second derivative without its
  // geometric part, sum 1.5 K sqrt(delta) n n^T; taken here for pure axial motion of an undisplaced row, where all balls are alike.
  auto g = angular_contact_pair(290.)[1];
  g.damping_beta = 2.5e-5;
  const BallRow damped(g, {});
  BallRowInput in;
  BallRowOutput rest, moving;
  damped.evaluate(in, rest);
  in.rate.x = 1e-4;
  damped.evaluate(in, moving);
  const double A = 0.04 * 9.525e-3, Br = A * std::cos(25 * deg), Bx = A * std::sin(25 * deg) + g.preload_offset,
               distance = std::hypot(Br, Bx);
  const double sin_phi = Bx / distance,
               stiffness = 23 * 1.5 * g.stiffness * std::sqrt(distance - A) * sin_phi * sin_phi;
  const double damper = -(moving.force_x - rest.force_x);
  EXPECT_NEAR(damper / (2.5e-5 * stiffness * 1e-4), 1., 1e-9);
  EXPECT_NEAR(moving.damping_power / (damper * 1e-4), 1., 1e-9) << "what the damper takes is dissipated";
}

TEST(BallRow, DampingPowerIsWhatTheRatesTakeFromTheRing) {
  // Power on the ring = force . rate = -(dU/dt by the ring's motion) - damping power, at any rates.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> one(-1, 1);
  for (auto s : samples(false)) {
    s.geometry.damping_beta = 2.5e-5;
    const BallRow row(s.geometry, s.waves);
    s.input.rate = {0.05 * one(random), 0.2 * one(random), 0.2 * one(random), 1. * one(random), 1. * one(random)};
    const auto& v = s.input.rate;
    BallRowOutput out;
    row.evaluate(s.input, out);
    const double on_ring =
        out.force_x * v.x + out.force_y * v.y + out.force_z * v.z + out.moment_y * v.psi_y + out.moment_z * v.psi_z;
    const double stored = derivative(
        [&](double t) {
          BallRowInput in = s.input;
          auto& q = in.displacement;
          q = {q.x + v.x * t, q.y + v.y * t, q.z + v.z * t, q.psi_y + v.psi_y * t, q.psi_z + v.psi_z * t};
          return oracle_energy(s.geometry, s.waves, in, in.cage_angle);
        },
        3e-7);
    EXPECT_GE(out.damping_power, 0.);
    EXPECT_NEAR(on_ring + stored + out.damping_power, 0., 1e-8 * (std::fabs(stored) + out.damping_power))
        << s.name << " W";
  }
}

}  // namespace
}  // namespace rotordrop
