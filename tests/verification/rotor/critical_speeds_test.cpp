// Critical speeds against closed forms.
//
// Rigid rotor on two equal isotropic springs k at +-l/2 of its centre of gravity, spin Omega, whirl exp(i Omega t):
//   translation  Omega^2 = 2 k / m                  forward and backward alike
//   tilt         Omega^2 = (k l^2 / 2) / (Id + Ip)  backward
//                Omega^2 = (k l^2 / 2) / (Id - Ip)  forward, and none for a disk with Ip > Id
//
// Massless shaft of flexibility S with a disk at one place, (deflection, slope) = S (force, moment):
//   1 / Omega^2 is an eigenvalue of S diag(m, Id + Ip) backward, of S diag(m, Id - Ip) forward.
// Pinned at x = 0 and x = L, the disk overhanging by a (statics of the beam; c = 1 / (kappa G A)):
//   S_11 = a^2 (L + a) / (3 E I) + c a (1 + a / L)
//   S_12 = a (2 L + 3 a) / (6 E I) + c a / L
//   S_22 = (L + 3 a) / (3 E I) + c / L
// Rigid rotor on such supports with damping c and cross coupling K_yz = -K_zy = kappa; with z = y + i z the translation obeys
//   m z'' + 2 c z' + 2 (k - i kappa) z = 0.
// Put z = exp((sigma +- i Omega) t); imaginary and real part give
//   sigma = +- kappa / (m Omega) - c / m,   m^2 Omega^4 - (2 k m - c^2) Omega^2 - kappa^2 = 0.
// The upper sign turns from +y towards +z. Both whirl at the same Omega, the damping differs.
// For the tilt m is Id, 2 c is c l^2 / 2 - i Omega Ip (spin from +y towards +z), and 2 k, 2 kappa are k l^2 / 2, kappa l^2 / 2.
//
// With the slope of the section (not of the line) as second coordinate the shear terms are those of the constant shear
// forces M / L and F a / L in the span, and F in the overhang, by Castigliano.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "rotor/modal_analysis.h"
#include "rotor/timoshenko.h"
#include "test_rotors.h"

namespace rotordrop {
namespace {

using testing::two_pi;

LinearSupportAtNode spring(int node, double k, double c = 0) { return {node, {{{k, 0}, {0, k}}}, {{{c, 0}, {0, c}}}}; }

/// A shaft without bending and, but for roundoff, without mass of its own, with a disk in its middle.
struct RigidRotor {
  double m = 12, Ip = 0, Id = 0, l = 0.6, k = 3e6;

  [[nodiscard]] std::vector<CriticalSpeed> critical_speeds(double up_to, double c = 0) const {
    RotorGeometry geometry;
    geometry.node_x = {0, l / 2, l};
    for (int e = 1; e <= 2; ++e) geometry.elements.push_back({e, e + 1, 0.02, 0, {2e11, 0.3, 1e-6}});
    geometry.mass_points = {{2, m, Ip, Id}};
    const ModalAnalysis analysis(geometry, {.cut_off_frequency = 0});
    return analysis.critical_speeds(up_to, {spring(1, k, c), spring(3, k, c)});
  }
};

TEST(CriticalSpeeds, OfARigidRotorAreThoseOfTranslationAndOfTiltInBothDirections) {
  const RigidRotor rotor{.Ip = 0.3, .Id = 0.5};
  const auto found = rotor.critical_speeds(5000);
  const double tilt = rotor.k * rotor.l * rotor.l / 2;
  ASSERT_EQ(found.size(), 3u);
  // The shaft's own mass is 1.6e-11 of the disk's, its moment of inertia 3e-11: up to 2e-8 rad/s.
  EXPECT_NEAR(found[0].speed, std::sqrt(2 * rotor.k / rotor.m), 1e-7);
  EXPECT_EQ(found[0].whirl, Whirl::planar);
  EXPECT_NEAR(found[1].speed, std::sqrt(tilt / (rotor.Id + rotor.Ip)), 1e-7);
  EXPECT_EQ(found[1].whirl, Whirl::backward);
  EXPECT_NEAR(found[2].speed, std::sqrt(tilt / (rotor.Id - rotor.Ip)), 1e-7);
  EXPECT_EQ(found[2].whirl, Whirl::forward);
}

TEST(CriticalSpeeds, OfADiskHaveNoForwardTilt) {
  const RigidRotor rotor{.Ip = 0.5, .Id = 0.26};
  const auto found = rotor.critical_speeds(20000);
  ASSERT_EQ(found.size(), 2u);
  // the shaft's own mass, as above
  EXPECT_NEAR(found[1].speed, std::sqrt(rotor.k * rotor.l * rotor.l / 2 / (rotor.Id + rotor.Ip)), 1e-7);
  EXPECT_EQ(found[1].whirl, Whirl::backward);
}

// Damped translation: m x'' + 2 c x' + 2 k x = 0, damped frequency sqrt(omega_0^2 - (c / m)^2); overdamped from c / m = omega_0 on.
TEST(CriticalSpeeds, MoveWithDampingAndVanishWhenNothingOscillates) {
  const RigidRotor rotor{.Ip = 1e-9, .Id = 1e-4};
  const double omega_0 = std::sqrt(2 * rotor.k / rotor.m);
  const double c = 0.4 * rotor.m * omega_0;
  const auto damped = rotor.critical_speeds(1.5 * omega_0, c);
  ASSERT_EQ(damped.size(), 1u);
  // the shaft's own mass, 1.6e-11 of the disk's
  EXPECT_NEAR(damped[0].speed, omega_0 * std::sqrt(1 - 0.4 * 0.4), 1e-9 * omega_0);
  EXPECT_NEAR(damped[0].damping_ratio, 0.4, 1e-9);
  EXPECT_TRUE(rotor.critical_speeds(1.5 * omega_0, 1.1 * rotor.m * omega_0).empty());
}

/// Two equal supports with cross-coupled stiffness under a rigid rotor with a disk that has Ip > Id: dampers make its tilt
/// creep, and gyroscopic moments turn the creeping motion faster than the spin.
struct RotorInOilFilms {
  double m = 12, Ip = 0.5, Id = 0.26, l = 0.6, k = 3e6, c = 3e4, kappa = 2.08e7;

  [[nodiscard]] std::vector<CriticalSpeed> critical_speeds(double up_to, double sense) const {
    RotorGeometry geometry;
    geometry.node_x = {0, l / 2, l};
    for (int e = 1; e <= 2; ++e) geometry.elements.push_back({e, e + 1, 0.02, 0, {2e11, 0.3, 1e-6}});
    geometry.mass_points = {{2, m, Ip, Id}};
    std::vector<LinearSupportAtNode> films;
    for (const int node : {1, 3}) films.push_back({node, {{{k, kappa}, {-kappa, k}}}, {{{c, 0}, {0, c}}}});
    return ModalAnalysis(geometry, {.cut_off_frequency = 0}).critical_speeds(up_to, films, sense);
  }
};

TEST(CriticalSpeeds, AreFoundAmongOverdampedMotionsInBothSensesOfSpin) {
  const RotorInOilFilms rotor;
  const double m = rotor.m, p = 2 * rotor.k * m - rotor.c * rotor.c, kappa = rotor.kappa;
  const double speed = std::sqrt((p + std::sqrt(p * p + 4 * m * m * kappa * kappa)) / (2 * m * m));
  const auto damping = [&](double towards_z) {
    const double sigma = towards_z * kappa / (m * speed) - rotor.c / m;
    return -sigma / std::hypot(sigma, speed);
  };
  ASSERT_NEAR(damping(1), 0.05, 0.05) << "one of both is lightly damped";
  ASSERT_LT(damping(-1), 0.995);
  for (const double sense : {1., -1.}) {
    int n = 0;
    for (const auto& one : rotor.critical_speeds(1000, sense)) {
      if (std::abs(one.speed / speed - 1) > 1e-8) continue;
      ++n;
      const bool is_towards_z = (one.whirl == Whirl::forward) == (sense > 0);
      EXPECT_NEAR(one.damping_ratio, damping(is_towards_z ? 1 : -1), 1e-7) << "sense " << sense;
    }
    EXPECT_EQ(n, 2) << "sense " << sense << ", at " << speed << " rad/s";
  }
}

TEST(CriticalSpeeds, AreNoneOfARotorThatWhirlsWithItsSpinAtEverySpeed) {
  // Free, with Ip = Id: the nutation has the frequency of the spin.
  RotorGeometry geometry;
  geometry.node_x = {0, 0.3, 0.6};
  for (int e = 1; e <= 2; ++e) geometry.elements.push_back({e, e + 1, 0.02, 0, {2e11, 0.3, 1e-6}});
  geometry.mass_points = {{2, 12, 0.3, 0.3}};
  EXPECT_TRUE(ModalAnalysis(geometry, {.cut_off_frequency = 0}).critical_speeds(1000, {}).empty());
}

/// Steel shaft whose mass is a millionth of a disk's, on stiff pins.
struct Shaft {
  double E = 2e11, nu = 0.3, od = 0.02, pin = 1e12;
  [[nodiscard]] double EI() const { return E * std::numbers::pi * std::pow(od, 4) / 64; }
  [[nodiscard]] double shear_compliance() const {
    const double G = E / (2 * (1 + nu)), A = std::numbers::pi * od * od / 4;
    return 1 / (cowper_shear_coefficient(nu, 0) * G * A);
  }
};

TEST(CriticalSpeeds, OfAJeffcottRotorIsTheRootOfStiffnessOverMass) {
  const Shaft shaft;
  const double L = 0.8, m = 5;
  RotorGeometry geometry;
  for (int k = 0; k <= 8; ++k) geometry.node_x.push_back(L * k / 8);
  for (int e = 1; e <= 8; ++e) geometry.elements.push_back({e, e + 1, shaft.od, 0, {shaft.E, shaft.nu, 0.01}});
  geometry.mass_points = {{5, m, 0, 0}};
  const double flexibility = L * L * L / (48 * shaft.EI()) + shaft.shear_compliance() * L / 4 + 0.5 / shaft.pin;
  const auto found = ModalAnalysis(geometry).critical_speeds(400, {spring(1, shaft.pin), spring(9, shaft.pin)});
  ASSERT_GE(found.size(), 1u);
  // The shaft's own mass, 17/35 of 2.5 mg, is 2.4e-7 of the disk's; stiff pins cost digits.
  EXPECT_NEAR(found[0].speed * std::sqrt(m * flexibility), 1, 1e-6);
  EXPECT_EQ(found[0].whirl, Whirl::planar);
}

TEST(CriticalSpeeds, OfAnOverhungDiskFollowItsGyroscopicEffect) {
  const Shaft shaft;
  const double L = 0.5, a = 0.2, m = 8, Ip = 0.10, Id = 0.06;
  RotorGeometry geometry;
  for (int k = 0; k <= 7; ++k) geometry.node_x.push_back(0.1 * k);
  for (int e = 1; e <= 7; ++e) geometry.elements.push_back({e, e + 1, shaft.od, 0, {shaft.E, shaft.nu, 0.01}});
  geometry.mass_points = {{8, m, Ip, Id}};
  const double EI = shaft.EI(), c = shaft.shear_compliance();
  Eigen::Matrix2d S;
  S << a * a * (L + a) / (3 * EI) + c * a * (1 + a / L), a * (2 * L + 3 * a) / (6 * EI) + c * a / L,
      a * (2 * L + 3 * a) / (6 * EI) + c * a / L, (L + 3 * a) / (3 * EI) + c / L;
  std::vector<std::pair<double, Whirl>> expected;
  for (const double sign : {1., -1.}) {
    Eigen::Matrix2d inertia = Eigen::Matrix2d::Zero();
    inertia.diagonal() << m, Id + sign * Ip;
    for (const auto& value : Eigen::EigenSolver<Eigen::Matrix2d>(S * inertia).eigenvalues())
      if (value.real() > 0)
        expected.emplace_back(1 / std::sqrt(value.real()), sign > 0 ? Whirl::backward : Whirl::forward);
  }
  std::sort(expected.begin(), expected.end());
  ASSERT_EQ(expected.size(), 3u) << "two backward, and of a disk one forward";
  const auto found = ModalAnalysis(geometry).critical_speeds(1.1 * expected.back().first,
                                                             {spring(1, shaft.pin), spring(6, shaft.pin)});
  ASSERT_EQ(found.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(found[k].speed / expected[k].first, 1, 1e-5) << k;  // the shaft's mass is 2e-7 of the disk's
    EXPECT_EQ(found[k].whirl, expected[k].second) << k;
  }
  // Without damping one eigenvalue problem has the same answer.
  const auto direct = ModalAnalysis(geometry).undamped_critical_speeds({spring(1, shaft.pin), spring(6, shaft.pin)});
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(direct[k] / expected[k].first, 1, 1e-5) << k;
}

TEST(CriticalSpeeds, AreWhereTheCampbellDiagramCrossesTheSpin) {
  const ModalAnalysis analysis(testing::reference_rotor(), {.modal_damping = 0.005, .cut_off_frequency = 3000});
  const std::vector<LinearSupportAtNode> supports = {spring(9, 5e7, 5e3), spring(27, 8e7, 5e3)};
  const auto found = analysis.critical_speeds(2500, supports);
  ASSERT_GE(found.size(), 4u);
  for (const auto& one : found) {
    double nearest = 1e9;
    for (const auto& mode : analysis.whirl_modes(one.speed, supports).modes)
      nearest = std::min(nearest, std::abs(mode.frequency * two_pi - one.speed));
    EXPECT_LT(nearest, 1e-8 * one.speed);
  }
}

}  // namespace
}  // namespace rotordrop
