// The rotor's rates, motion and energy.
//
// NUTATION of a free rigid rotor. Its axis points along (1, phi_y, phi_z) with phi_y = theta_z, phi_z = -theta_y. Its
// angular momentum, L = Ip omega (1, phi_y, phi_z) + Id (axis x axis'), has lateral parts Ip omega phi_y - Id phi_z'
// along y and Ip omega phi_z + Id phi_y' along z (x cross y is z). Both stay constant; with phi = phi_y + i phi_z their
// rates are Id phi'' = i Ip omega phi', so
//   phi' = phi'_0 exp(i Omega t),  Omega = (Ip / Id) omega:   forward, from +y towards +z, for omega > 0.
//
// UNBALANCE is the inertia force of an eccentric mass, -m r'' with r = e (cos, sin)(theta(t) + a).
//
// FREE FALL  g t^2 / 2; with mass-proportional damping alpha  g (alpha t - 1 + exp(-alpha t)) / alpha^2.
//
// ENERGY  d(energy)/dt = sum over stations (F.v + M.tilt rate + torque omega) - damping + unbalance_work + drive_work.
#include "rotor/modal_rotor.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "rotor/timoshenko.h"
#include "test_rotors.h"

namespace rotordrop {
namespace {

using testing::node_motions;
using testing::reference_rotor;
using testing::rpm;
using testing::uniform_beam;

RotorSettings lively_settings(RotorRepresentation representation) {
  RotorSettings settings;
  settings.representation = representation;
  settings.modal_damping = 0.02;
  settings.mass_proportional_alpha = 7;
  settings.gravity_y = -9.81;
  settings.gravity_z = 1.3;
  settings.unbalance = {{5, 1.1e-3, 0.4}, {16, 2.8e-3, 3.0}, {16, 1e-3, -1.0}};
  settings.drive_torque = {{0, -20}, {1, 40}};
  return settings;
}

/// A state in which every flexible mode moves at about 0.1 m/s.
std::vector<double> random_state(const ModalRotor& rotor, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto frequency = rotor.mode_frequencies();
  const std::size_t n = rotor.n_modes();
  std::vector<double> y(rotor.n_state());
  for (std::size_t plane = 0; plane < 2; ++plane)
    for (std::size_t k = 0; k < n; ++k) {
      y[plane * n + k] = 0.1 * uniform(random) / (k < 2 ? 1000 : testing::two_pi * frequency[k]);
      y[(2 + plane) * n + k] = 0.1 * uniform(random);
    }
  y[4 * n] = 10 * uniform(random);
  y[4 * n + 1] = 1500 * uniform(random);
  return y;
}

std::vector<Force> random_forces(std::size_t n, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Force> forces(n);
  for (auto& f : forces)
    f = {0,
         5e3 * uniform(random),
         5e3 * uniform(random),
         50 * uniform(random),
         50 * uniform(random),
         30 * uniform(random)};
  return forces;
}

TEST(ModalRotor, BooksEveryJouleThatEntersAndLeaves) {
  std::mt19937 random(1);
  for (const auto representation :
       {RotorRepresentation::rigid, RotorRepresentation::modal, RotorRepresentation::full}) {
    const ModalRotor rotor(reference_rotor(), lively_settings(representation), {2, 28, 16});
    for (int trial = 0; trial < 20; ++trial) {
      const auto y = random_state(rotor, random);
      const auto forces = random_forces(3, random);
      std::vector<double> dydt(rotor.n_state());
      std::vector<Motion> motion(3);
      rotor.motions(y, motion);
      const RotorPower power = rotor.rates(0.3, y, forces, dydt);
      double expected = -power.damping + power.unbalance_work + power.drive_work;
      double size = std::abs(power.damping) + std::abs(power.unbalance_work) + std::abs(power.drive_work);
      for (std::size_t s = 0; s < 3; ++s) {
        const double work = forces[s].y * motion[s].velocity_y + forces[s].z * motion[s].velocity_z +
                            forces[s].moment_y * motion[s].tilt_rate_y + forces[s].moment_z * motion[s].tilt_rate_z +
                            forces[s].torque * rotor.spin(y).speed;
        expected += work;
        size += std::abs(work);
      }
      const double rate = testing::energy_rate([&](const auto& state) { return rotor.energy(state); }, y, dydt, 1e-4);
      EXPECT_NEAR(rate, expected, 1e-10 * size + 1e-10 * rotor.energy(y)) << "W; roundoff";
      EXPECT_DOUBLE_EQ(power.drive_work, -2 * rotor.spin(y).speed) << "W; the torque table gives -2 N m at 0.3 s";
      EXPECT_GT(power.damping, 0);
    }
  }
}

TEST(ModalRotor, WithAllModesAcceleratesAsTheFiniteElementMatrices) {
  const auto geometry = reference_rotor();
  auto settings = lively_settings(RotorRepresentation::full);
  settings.modal_damping = 0;  // the only part that has no matrix of its own
  const std::vector<int> stations{2, 28};
  const ModalRotor rotor(geometry, settings, stations);
  ASSERT_EQ(rotor.n_modes(), 62U);
  std::mt19937 random(2);
  const auto y = random_state(rotor, random);
  const auto forces = random_forces(2, random);
  std::vector<double> dydt(rotor.n_state());
  rotor.rates(0.3, y, forces, dydt);

  // Node motions of y hold positions and velocities; those of dydt hold velocities and accelerations.
  const auto n_nodes = static_cast<std::size_t>(geometry.n_nodes());
  const std::vector<Motion> motion = node_motions(rotor, y), change = node_motions(rotor, dydt);
  const auto n = static_cast<Eigen::Index>(2 * n_nodes);
  Eigen::VectorXd q_y(n), q_z(n), v_y(n), v_z(n), a_y(n), a_z(n), f_y = Eigen::VectorXd::Zero(n), f_z = f_y, ones = f_y;
  for (std::size_t k = 0; k < n_nodes; ++k) {
    const auto row = static_cast<Eigen::Index>(2 * k);
    q_y.segment(row, 2) << motion[k].y, motion[k].theta_z;
    q_z.segment(row, 2) << motion[k].z, -motion[k].theta_y;
    v_y.segment(row, 2) << motion[k].velocity_y, motion[k].tilt_rate_z;
    v_z.segment(row, 2) << motion[k].velocity_z, -motion[k].tilt_rate_y;
    a_y.segment(row, 2) << change[k].velocity_y, change[k].tilt_rate_z;
    a_z.segment(row, 2) << change[k].velocity_z, -change[k].tilt_rate_y;
    ones(row) = 1;
  }
  double torque = -2;  // drive at t = 0.3 s
  for (std::size_t s = 0; s < 2; ++s) {
    const Eigen::Index row = 2 * stations[s] - 2;
    f_y(row) += forces[s].y;
    f_y(row + 1) += forces[s].moment_z;
    f_z(row) += forces[s].z;
    f_z(row + 1) -= forces[s].moment_y;
    torque += forces[s].torque;
  }
  const double omega = rotor.spin(y).speed, theta = rotor.spin(y).angle, omega_rate = torque / rotor.body().Ip;
  for (const auto& u : settings.unbalance) {
    const double a = theta + u.angle;
    f_y(2 * u.node - 2) += u.me * (omega * omega * std::cos(a) + omega_rate * std::sin(a));
    f_z(2 * u.node - 2) += u.me * (omega * omega * std::sin(a) - omega_rate * std::cos(a));
  }
  const auto fe = assemble(geometry);
  f_y += fe.mass * (-9.81 * ones - 7 * v_y) - omega * fe.gyroscopic * v_z - fe.stiffness * q_y;
  f_z += fe.mass * (1.3 * ones - 7 * v_z) + omega * fe.gyroscopic * v_y - fe.stiffness * q_z;
  const Eigen::LLT<Eigen::MatrixXd> mass(fe.mass);
  const Eigen::VectorXd expected_y = mass.solve(f_y), expected_z = mass.solve(f_z);
  EXPECT_LT((a_y - expected_y).norm(), 1e-9 * expected_y.norm());
  EXPECT_LT((a_z - expected_z).norm(), 1e-9 * expected_z.norm());
  EXPECT_NEAR(dydt.back(), omega_rate, 1e-12 * std::abs(omega_rate));
}

TEST(ModalRotor, FallsFreelyAsARigidBodyThatDoesNotBend) {
  RotorSettings settings;
  settings.gravity_y = -9.81;
  const ModalRotor rotor(reference_rotor(), settings, {2, 28});
  std::vector<double> y(rotor.n_state());
  rotor.initial_rigid_state({}, {0, 15200 * rpm}, y);
  const double t = std::sqrt(2 * 250e-6 / 9.81);
  EXPECT_NEAR(t, 7.14e-3, 5e-6) << "s, through the air gap";
  std::vector<double> k(rotor.n_state());
  const std::vector<Force> none(2);
  const int n_steps = 1000;
  for (int step = 0; step < n_steps; ++step) {  // the midpoint rule is exact for a parabola
    rotor.rates(0, y, none, k);
    auto middle = y;
    for (std::size_t i = 0; i < y.size(); ++i) middle[i] += 0.5 * t / n_steps * k[i];
    rotor.rates(0, middle, none, k);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += t / n_steps * k[i];
  }
  for (const auto& m : node_motions(rotor, y)) {
    EXPECT_NEAR(m.y, -250e-6, 1e-15) << "m";
    EXPECT_NEAR(m.velocity_y, -0.0700, 5e-5) << "m/s";
    EXPECT_EQ(m.z, 0);
    EXPECT_EQ(m.theta_z, 0);
  }
  EXPECT_NEAR(rotor.spin(y).angle, 15200 * rpm * t, 1e-10) << "rad";
  EXPECT_NEAR(rotor.energy(y), 0.5 * rotor.body().Ip * std::pow(15200 * rpm, 2), 1e-8)
      << "J; kinetic + gravitational stays 0";
}

TEST(ModalRotor, FallsMoreSlowlyWithMassProportionalDamping) {
  RotorSettings settings;
  settings.gravity_y = -9.81;
  settings.mass_proportional_alpha = 30;
  settings.representation = RotorRepresentation::rigid;
  const ModalRotor rotor(reference_rotor(), settings, {2});
  std::vector<double> y(rotor.n_state()), k1(y.size()), k2(y.size());
  const std::vector<Force> none(1);
  const double t = 7.40e-3, h = t / 2000;
  for (int step = 0; step < 2000; ++step) {
    rotor.rates(0, y, none, k1);
    auto middle = y;
    for (std::size_t i = 0; i < y.size(); ++i) middle[i] += 0.5 * h * k1[i];
    rotor.rates(0, middle, none, k2);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += h * k2[i];
  }
  std::vector<Motion> motion(1);
  rotor.motions(y, motion);
  const double fallen = 9.81 * (30 * t - 1 + std::exp(-30 * t)) / 900;
  EXPECT_NEAR(fallen, 250e-6, 0.5e-6) << "m; closed form: 7.40 ms";
  EXPECT_NEAR(-motion[0].y, fallen, 1e-10) << "m; order 2";
}

TEST(ModalRotor, NutatesForwardAtIpOverIdTimesItsSpin) {
  RotorSettings settings;
  settings.representation = RotorRepresentation::rigid;
  const ModalRotor rotor(reference_rotor(), settings, {2});
  const double omega = 15200 * rpm, Omega = rotor.body().Ip / rotor.body().Id * omega, rate = 1e-3;
  std::vector<double> y(rotor.n_state());
  Motion start;
  start.tilt_rate_z = rate;  // phi_y' = rate, phi_z' = 0
  rotor.initial_rigid_state(start, {0, omega}, y);
  const double t = 0.3 * testing::two_pi / Omega;
  const std::vector<Force> none(1);
  std::vector<double> k1(y.size()), k2(y.size()), k3(y.size()), k4(y.size());
  const int n_steps = 2000;
  const double h = t / n_steps;
  const auto moved = [&](double step, const std::vector<double>& k) {
    auto trial = y;
    for (std::size_t i = 0; i < y.size(); ++i) trial[i] += step * k[i];
    return trial;
  };
  for (int step = 0; step < n_steps; ++step) {
    rotor.rates(0, y, none, k1);
    rotor.rates(0, moved(h / 2, k1), none, k2);
    rotor.rates(0, moved(h / 2, k2), none, k3);
    rotor.rates(0, moved(h, k3), none, k4);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
  std::vector<Motion> motion(1);
  rotor.motions(y, motion);
  // phi = phi'_0 (exp(i Omega t) - 1) / (i Omega)
  EXPECT_NEAR(motion[0].tilt_rate_z, rate * std::cos(Omega * t), 1e-10 * rate) << "rad/s";
  EXPECT_NEAR(-motion[0].tilt_rate_y, rate * std::sin(Omega * t), 1e-10 * rate) << "rad/s";
  EXPECT_NEAR(motion[0].theta_z, rate * std::sin(Omega * t) / Omega, 1e-10 * rate / Omega) << "rad";
  EXPECT_NEAR(-motion[0].theta_y, rate * (1 - std::cos(Omega * t)) / Omega, 1e-10 * rate / Omega) << "rad";
}

TEST(ModalRotor, FeelsItsUnbalanceAsTheInertiaOfAnEccentricMass) {
  RotorSettings settings;
  settings.unbalance = {{16, 3e-3, 0.7}};
  settings.drive_torque = {{0, 11}};
  const ModalRotor rotor(reference_rotor(), settings, {2});
  std::vector<double> y(rotor.n_state()), dydt(rotor.n_state());
  const double theta = 2.2, omega = 90, h = 1e-4;
  rotor.initial_rigid_state({}, {theta, omega}, y);
  rotor.rates(0, y, std::vector<Force>(1), dydt);
  const double omega_rate = 11 / rotor.body().Ip;
  const auto r_y = [&](double t) { return std::cos(theta + omega * t + 0.5 * omega_rate * t * t + 0.7); };
  const auto r_z = [&](double t) { return std::sin(theta + omega * t + 0.5 * omega_rate * t * t + 0.7); };
  const double force_y = -3e-3 * (r_y(h) - 2 * r_y(0) + r_y(-h)) / (h * h);
  const double force_z = -3e-3 * (r_z(h) - 2 * r_z(0) + r_z(-h)) / (h * h);
  const double size = 3e-3 * omega * omega;
  const std::size_t n = rotor.n_modes();
  // The translation's acceleration times the mass is the whole force; difference quotients err by (omega h)^2 / 12.
  EXPECT_NEAR(rotor.body().mass * dydt[2 * n], force_y, 1e-4 * size) << "N";
  EXPECT_NEAR(rotor.body().mass * dydt[3 * n], force_z, 1e-4 * size) << "N";
}

TEST(ModalRotor, StartsAsAStraightLineThroughTwoPointsAndMovesAsARigidBody) {
  const auto geometry = reference_rotor();
  const ModalRotor rotor(geometry, {}, {2, 28});
  std::vector<double> y(rotor.n_state());
  const double x1 = geometry.position(2), x2 = geometry.position(28), x_cg = rotor.body().centre_of_gravity;
  Motion start = straight_line(x1, -19e-6, 3e-6, x2, 1e-6, -2e-6, x_cg);
  start.velocity_y = 0.01;
  start.tilt_rate_y = 0.2;
  start.tilt_rate_z = -0.3;
  rotor.initial_rigid_state(start, {0.5, 1000}, y);
  std::vector<Motion> station(2);
  rotor.motions(y, station);
  const std::vector<Motion> node = node_motions(rotor, y);
  EXPECT_NEAR(station[0].y, -19e-6, 1e-18);
  EXPECT_NEAR(station[0].z, 3e-6, 1e-18);
  EXPECT_NEAR(station[1].y, 1e-6, 1e-18);
  EXPECT_NEAR(station[1].z, -2e-6, 1e-18);
  for (int k = 1; k <= 31; ++k) {
    const double arm = geometry.position(k) - x_cg;
    const Motion& m = node[static_cast<std::size_t>(k - 1)];
    EXPECT_NEAR(m.theta_y, 5e-6 / (x2 - x1), 1e-18) << "z falls along x: a positive rotation about y";
    EXPECT_NEAR(m.theta_z, 20e-6 / (x2 - x1), 1e-18);
    EXPECT_NEAR(m.velocity_y, 0.01 - 0.3 * arm, 1e-15) << "u = theta x r";
    EXPECT_NEAR(m.velocity_z, -0.2 * arm, 1e-15) << "u = theta x r";
    EXPECT_NEAR(m.tilt_rate_y, 0.2, 1e-15);
    EXPECT_NEAR(m.tilt_rate_z, -0.3, 1e-15);
  }
  EXPECT_EQ(rotor.spin(y).angle, 0.5);
  EXPECT_EQ(rotor.spin(y).speed, 1000);
}

TEST(ModalRotor, StartsOnAnOrbitWithVelocityAcrossTheOffset) {
  const Motion start = orbit(100e-6, std::numbers::pi / 2, 50);
  EXPECT_NEAR(start.y, 0, 1e-19);
  EXPECT_NEAR(start.z, 100e-6, 1e-19) << "a quarter turn from +y is +z";
  EXPECT_NEAR(start.velocity_y, -5e-3, 1e-17) << "and then it moves down";
  EXPECT_NEAR(start.velocity_z, 0, 1e-17);
  const Motion sum = start + start;
  EXPECT_EQ(sum.z, 2 * start.z);
  EXPECT_EQ(sum.velocity_y, 2 * start.velocity_y);
}

TEST(ModalRotor, GivesTheSameAnswerWithAnyNumberOfModes) {
  // Modes are looked at in vectors of eight, up to four at a time, the last of them not full. With the modes that a rotor leaves out at rest, one with
  // all modes, whose accelerations are those of the finite-element matrices, agrees in the others.
  RotorSettings settings;
  settings.representation = RotorRepresentation::full;
  settings.gravity_y = -9.81;
  settings.gravity_z = 1.2;
  settings.mass_proportional_alpha = 7.;
  settings.unbalance = {{10, 2e-3, 0.4}};
  const std::vector<int> stations = {2, 28, 17};
  const ModalRotor all(reference_rotor(), settings, stations);
  settings.representation = RotorRepresentation::modal;
  const std::vector<Force> force = {{.y = 300., .z = -20., .moment_y = 0.4, .moment_z = 1.5, .torque = 0.3},
                                    {.y = -80., .z = 500., .moment_y = -2., .moment_z = 0.1},
                                    {.y = 10., .z = 3., .moment_y = 0.7, .moment_z = -0.2, .torque = -0.1}};
  const auto frequency = all.mode_frequencies();
  std::mt19937 random(3);
  std::vector<double> y_all(all.n_state()), rates_all(all.n_state());
  for (const std::size_t n : {3U, 8U, 9U, 16U, 20U, 25U, 33U, 40U, 47U, 56U}) {
    settings.cut_off_frequency = 0.5 * (frequency[n - 1] + frequency[n]);
    const ModalRotor few(reference_rotor(), settings, stations);
    ASSERT_EQ(few.n_modes(), n);
    const auto y = random_state(few, random);
    std::fill(y_all.begin(), y_all.end(), 0.);
    for (std::size_t part = 0; part < 4; ++part)
      for (std::size_t k = 0; k < n; ++k) y_all[part * all.n_modes() + k] = y[part * n + k];
    y_all[4 * all.n_modes()] = y[4 * n];
    y_all[4 * all.n_modes() + 1] = y[4 * n + 1];
    std::vector<double> rates(few.n_state());
    std::vector<Motion> motion(stations.size()), motion_all(stations.size());
    few.motions(y, motion);
    all.motions(y_all, motion_all);
    for (std::size_t s = 0; s < stations.size(); ++s) {
      EXPECT_NEAR(motion[s].y, motion_all[s].y, 1e-18) << n << " modes, station " << s;
      EXPECT_NEAR(motion[s].z, motion_all[s].z, 1e-18) << n << " modes, station " << s;
      EXPECT_NEAR(motion[s].theta_y, motion_all[s].theta_y, 1e-17) << n << " modes, station " << s;
      EXPECT_NEAR(motion[s].tilt_rate_y, motion_all[s].tilt_rate_y, 1e-14) << n << " modes, station " << s;
      EXPECT_NEAR(motion[s].tilt_rate_z, motion_all[s].tilt_rate_z, 1e-14) << n << " modes, station " << s;
    }
    const auto power = few.rates(0, y, force, rates), power_all = all.rates(0, y_all, force, rates_all);
    EXPECT_NEAR(power.damping / power_all.damping, 1, 1e-13) << n << " modes";
    EXPECT_NEAR(power.unbalance_work / power_all.unbalance_work, 1, 1e-11) << n << " modes";
    EXPECT_NEAR(few.energy(y) / all.energy(y_all), 1, 1e-13) << n << " modes";
    double largest = 0.;
    for (std::size_t i = 2 * n; i < 4 * n; ++i) largest = std::max(largest, std::abs(rates[i]));
    for (std::size_t part = 0; part < 4; ++part)
      for (std::size_t k = 0; k < n; ++k)
        EXPECT_NEAR(rates_all[part * all.n_modes() + k], rates[part * n + k], 1e-13 * largest)
            << n << " modes, part " << part << ", mode " << k;
  }
}

TEST(ModalRotor, NamesItsStatesWithUnitsAndScales) {
  const ModalRotor rotor(reference_rotor(), {}, {2, 28});
  const auto entries = rotor.state_entries();
  ASSERT_EQ(entries.size(), 4U * 7 + 2);
  EXPECT_EQ(entries[0].name, "y mode 1 (translation)");
  EXPECT_EQ(entries[1].name, "y mode 2 (tilt)");
  EXPECT_EQ(entries[2].name, "y mode 3 (673.5 Hz)");
  EXPECT_EQ(entries[2].unit, "m");
  EXPECT_EQ(entries[9].name, "z mode 3 (673.5 Hz)");
  EXPECT_EQ(entries[16].name, "y mode 3 (673.5 Hz) velocity");
  EXPECT_EQ(entries[16].unit, "m/s");
  EXPECT_EQ(entries[28].name, "spin angle");
  EXPECT_EQ(entries[29].unit, "rad/s");
  for (const auto& entry : entries) EXPECT_GT(entry.scale, 0) << entry.name;
}

TEST(DriveTorque, IsLinearBetweenItsPointsAndConstantOutside) {
  RotorSettings settings;
  settings.drive_torque = {{1, 10}, {2, -10}, {4, 0}};
  const ModalRotor rotor(uniform_beam(4, 0.05), settings, {1});
  EXPECT_DOUBLE_EQ(rotor.drive_torque(0), 10);
  EXPECT_DOUBLE_EQ(rotor.drive_torque(1.5), 0);
  EXPECT_DOUBLE_EQ(rotor.drive_torque(2), -10);
  EXPECT_DOUBLE_EQ(rotor.drive_torque(3), -5);
  EXPECT_DOUBLE_EQ(rotor.drive_torque(9), 0);
}

}  // namespace
}  // namespace rotordrop
