// Whirl modes and unbalance response against closed forms and against integration in time.
//
// SYMMETRIC RIGID ROTOR on two equal isotropic supports, each of stiffness K and damping C, at +-l from the middle:
//   bounce   m z'' + 2 C z' + 2 K z = f with z = y + i z:
//            omega_b = sqrt(2 K / m), damping ratio C / (m omega_b), twice (planar)
//   conical  Id phi'' - i Ip omega phi' + 2 K l^2 phi = 0 (C = 0), phi = theta_z - i theta_y:
//            lambda = i (g +- sqrt(g^2 + 2 K l^2 / Id)), g = Ip omega / (2 Id);
//            the upper sign turns from +y towards +z with the spin (forward), the lower one against it (backward)
//   unbalance m e in the middle:
//            V = m e omega^2 exp(i a) / (2 K - m omega^2 + 2 i C omega),  W = -i V (a forward circle)
#include "rotor/modal_analysis.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bearing/support/linear_support.h"
#include "rotor/linear_system.h"
#include "rotor/modal_basis.h"
#include "test_rotors.h"

namespace rotordrop {
namespace {

using testing::HeldRotor;
using testing::reference_rotor;
using testing::rpm;
using testing::two_pi;
using testing::uniform_beam;
using Complex = std::complex<double>;
using Matrix = LinearSupport::Matrix;

Matrix isotropic(double value) { return {{{value, 0}, {0, value}}}; }

TEST(WhirlModes, OfAFreeRotorAtRestAreItsBendingModesInBothPlanes) {
  const auto result = ModalAnalysis(reference_rotor()).whirl_modes(0);
  EXPECT_EQ(result.n_rigid_body_modes, 4);
  EXPECT_EQ(result.n_overdamped, 0);
  ASSERT_EQ(result.modes.size(), 120U);
  const double expected[] = {673.4957, 673.4957, 1220.8703, 1220.8703};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(result.modes[k].frequency, expected[k], 1e-3) << "Hz";
    EXPECT_EQ(to_string(result.modes[k].whirl), "planar");
    // roundoff of the highest eigenvalue, over these
    EXPECT_NEAR(result.modes[k].damping_ratio, 0, 1e-8);
  }
  // One of the pair bends along y alone, the other along z.
  for (const Complex& w : result.modes[0].w) EXPECT_NEAR(std::abs(w), 0, 1e-5);
  for (const Complex& v : result.modes[1].v) EXPECT_NEAR(std::abs(v), 0, 1e-5);
}

TEST(WhirlModes, OfTheReferenceRotorSplitGyroscopicallyAt15200Rpm) {
  const auto geometry = reference_rotor();
  const auto result = ModalAnalysis(geometry).whirl_modes(15200 * rpm);
  EXPECT_EQ(result.n_rigid_body_modes, 3) << "the fourth has become the nutation";
  const auto& modes = result.modes;
  EXPECT_EQ(modes[0].whirl, Whirl::forward);
  const RigidBody body = rigid_body(geometry);
  EXPECT_NEAR(modes[0].frequency, body.Ip / body.Id * 15200 / 60, 0.05) << "Hz; nutation of a nearly rigid rotor";
  EXPECT_NEAR(modes[1].frequency, 658.5, 0.05) << "Hz";
  EXPECT_EQ(modes[1].whirl, Whirl::backward);
  EXPECT_NEAR(modes[2].frequency, 688.4, 0.05) << "Hz";
  EXPECT_EQ(modes[2].whirl, Whirl::forward);
  // Turning the other way mirrors the rotor: the same frequencies and, as whirl is named after the spin, the same names.
  const auto reversed = ModalAnalysis(geometry).whirl_modes(-15200 * rpm).modes;
  ASSERT_EQ(reversed.size(), modes.size());
  for (std::size_t k = 0; k < modes.size(); ++k) {
    // roundoff of the highest frequency
    EXPECT_NEAR(reversed[k].frequency, modes[k].frequency, 1e-6);
    EXPECT_EQ(reversed[k].whirl, modes[k].whirl) << modes[k].frequency << " Hz";
  }
}

TEST(WhirlModes, OfARigidRotorOnTwoSupportsFollowTheClosedForm) {
  const auto geometry = uniform_beam(8, 0.1);
  const RigidBody body = rigid_body(geometry);
  const double K = 3e6, C = 500, l = 0.25, omega = 8000 * rpm;
  const ModalAnalysis rigid(geometry, {.cut_off_frequency = 0});

  const auto undamped = rigid.whirl_modes(omega, {{3, isotropic(K), {}}, {7, isotropic(K), {}}});
  ASSERT_EQ(undamped.modes.size(), 4U);
  EXPECT_EQ(undamped.n_rigid_body_modes, 0);
  const double bounce = std::sqrt(2 * K / body.mass) / two_pi;
  const double g = body.Ip * omega / (2 * body.Id), root = std::sqrt(g * g + 2 * K * l * l / body.Id);
  std::vector<std::pair<double, Whirl>> expected{{bounce, Whirl::planar},
                                                 {bounce, Whirl::planar},
                                                 {(root + g) / two_pi, Whirl::forward},
                                                 {(root - g) / two_pi, Whirl::backward}};
  std::sort(expected.begin(), expected.end());
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(undamped.modes[k].frequency / expected[k].first, 1, 1e-9);
    EXPECT_EQ(to_string(undamped.modes[k].whirl), to_string(expected[k].second))
        << undamped.modes[k].frequency << " Hz";
  }

  const auto damped = rigid.whirl_modes(0, {{3, isotropic(K), isotropic(C)}, {7, isotropic(K), isotropic(C)}});
  bool found = false;
  for (const auto& mode : damped.modes) {
    if (std::abs(mode.natural_frequency / bounce - 1) > 1e-9) continue;
    found = true;
    const double ratio = C / (body.mass * two_pi * bounce);
    EXPECT_NEAR(mode.damping_ratio, ratio, 1e-9);
    EXPECT_NEAR(mode.frequency, bounce * std::sqrt(1 - ratio * ratio), 1e-9);
  }
  EXPECT_TRUE(found);
}

TEST(WhirlModes, KnowModalDampingOverdampedMotionAndAlpha) {
  const auto geometry = reference_rotor();
  const auto free = ModalAnalysis(geometry, {.modal_damping = 0.005, .mass_proportional_alpha = 30}).whirl_modes(0);
  EXPECT_EQ(free.n_rigid_body_modes, 4) << "alpha lets rigid motion die, but does not hold it";
  const double omega_1 = two_pi * 673.4957;
  // 0.0035 by alpha, with the seven digits of the frequency
  EXPECT_NEAR(free.modes[0].damping_ratio, 0.005 + 30 / (2 * omega_1), 1e-9);
  EXPECT_NEAR(free.modes[0].natural_frequency, 673.4957, 1e-3) << "Hz";

  const double K = 1e5, C = 1e5;  // creeps back
  const auto held = ModalAnalysis(geometry, {.cut_off_frequency = 0})
                        .whirl_modes(0, {{2, isotropic(K), isotropic(C)}, {28, isotropic(K), isotropic(C)}});
  EXPECT_EQ(held.n_overdamped, 8);
  EXPECT_EQ(held.n_diverging, 0);
  EXPECT_EQ(held.divergence_rate, 0);
  EXPECT_TRUE(held.modes.empty());
}

TEST(WhirlModes, TellMotionsThatDivergeFromThoseThatCreepBack) {
  // Springs [[K, 2 K], [2 K, K]] have 3 K along (1, 1) and -K along (1, -1). At rest, in the direction (1, -1):
  //   m x'' + 2 C x' - 2 K x = 0   and   Id phi'' + 2 C l^2 phi' - 2 K l^2 phi = 0,
  // each with one root above and one below 0; those along (1, 1) oscillate.
  const auto geometry = uniform_beam(8, 0.1);
  const RigidBody body = rigid_body(geometry);
  const double K = 3e6, C = 500, l = 0.25;
  const Matrix springs = {{{K, 2 * K}, {2 * K, K}}};
  const auto found = ModalAnalysis(geometry, {.cut_off_frequency = 0})
                         .whirl_modes(0, {{3, springs, isotropic(C)}, {7, springs, isotropic(C)}});
  const auto rate = [&](double mass) { return (-C + std::sqrt(C * C + 2 * K * mass)) / mass; };
  EXPECT_EQ(found.n_diverging, 2);
  EXPECT_EQ(found.n_overdamped, 2);
  EXPECT_EQ(found.modes.size(), 2U);
  EXPECT_NEAR(found.divergence_rate / std::max(rate(body.mass), rate(body.Id / (l * l))), 1, 1e-9);
}

TEST(WhirlModes, AreUnstableAboveTheThresholdOfACrossCoupledStiffness) {
  // Rigid rotor, K isotropic, cross-coupling k: m z'' + 2 C z' + (2 K - 2 i k) z = 0 drives the forward mode once k > C
  // omega_b.
  const auto geometry = uniform_beam(8, 0.1);
  const double K = 3e6, C = 500, omega_b = std::sqrt(2 * K / rigid_body(geometry).mass);
  const ModalAnalysis rigid(geometry, {.cut_off_frequency = 0});
  for (const double factor : {0.9, 1.1}) {
    const double k = factor * C * omega_b;
    const Matrix stiffness{{{K, k}, {-k, K}}};  // force on the rotor: -k z along y, +k y along z: pushes forward
    const auto modes = rigid.whirl_modes(0, {{3, stiffness, isotropic(C)}, {7, stiffness, isotropic(C)}}).modes;
    // The bounce pair; the conical one becomes unstable too, at another k.
    double forward_ratio = 0;
    for (const auto& mode : modes)
      if (mode.whirl == Whirl::forward && std::abs(mode.frequency / (omega_b / two_pi) - 1) < 0.05)
        forward_ratio = mode.damping_ratio;
    // Near the threshold lambda = i omega_b - (C - k / omega_b) / m.
    EXPECT_NEAR(forward_ratio, (1 - factor) * C / (rigid_body(geometry).mass * omega_b), 1e-5)
        << "k = " << factor << " C omega_b";
  }
}

TEST(WhirlModes, AreMixedWhereTheSupportsLeanOpposedWays) {
  // Soft along y on the left, along z on the right: the rigid-body modes turn their plane along the rotor, and with
  // spin its middle and its ends turn in opposite senses. The bending modes hardly feel the supports and stay backward
  // and forward.
  const Matrix soft_y{{{1e7, 0}, {0, 3e7}}}, soft_z{{{3e7, 0}, {0, 1e7}}};
  const auto modes = ModalAnalysis(uniform_beam(8, 0.1), {.cut_off_frequency = 5000})
                         .whirl_modes(1500, {{2, soft_y, {}}, {8, soft_z, {}}})
                         .modes;
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(to_string(modes[k].whirl), "mixed") << modes[k].frequency << " Hz";
  const auto sense = [&](std::size_t node) { return std::imag(modes[0].v[node] * std::conj(modes[0].w[node])); };
  EXPECT_LT(sense(0) * sense(4), 0);
  EXPECT_LT(sense(8) * sense(4), 0);
  EXPECT_EQ(to_string(modes[4].whirl), "backward");
  EXPECT_EQ(to_string(modes[5].whirl), "forward");
}

/// Steady response to unbalance: displacement = Re(v exp(i omega t)), spin angle = omega t.
struct SynchronousResponse {
  Eigen::VectorXcd v, w;  // [n_nodes] along y and z [m]
  Eigen::VectorXcd q_y,
      q_z;  // [n_modes] in the coordinates of ModalRotor with the same cut-off [m]; at t = 0 they are Re(q), rates Re(i omega q)
};
SynchronousResponse unbalance_response(const RotorGeometry& geometry, const ModalAnalysisOptions& options, double omega,
                                       const std::vector<Unbalance>& unbalance,
                                       const std::vector<LinearSupportAtNode>& supports) {
  const ModalBasis basis = free_free_modes(geometry, options.cut_off_frequency);
  const LinearSystem system = linear_system(basis, options, omega, supports);
  const Eigen::Index n = basis.n_modes();
  const Complex i(0, 1);
  // f_y = me omega^2 cos(omega t + a), f_z = me omega^2 sin(omega t + a): the z force lags by a quarter turn, factor -i.
  Eigen::VectorXcd f = Eigen::VectorXcd::Zero(2 * n);
  for (const auto& spot : unbalance) {
    const Complex force = spot.me * omega * omega * std::polar(1.0, spot.angle) / basis.body.mass;
    const Eigen::VectorXd deflection = basis.shape.row(2 * spot.node - 2).transpose();
    f.head(n) += force * deflection;
    f.tail(n) += -i * force * deflection;
  }
  Eigen::MatrixXcd dynamic_stiffness = system.stiffness.cast<Complex>() + i * omega * system.damping.cast<Complex>();
  dynamic_stiffness.diagonal().array() -= omega * omega;
  const Eigen::VectorXcd q = dynamic_stiffness.partialPivLu().solve(f);
  const Eigen::MatrixXd deflection = basis.shape(Eigen::seqN(0, basis.shape.rows() / 2, 2), Eigen::all);
  return {deflection * q.head(n), deflection * q.tail(n), q.head(n), q.tail(n)};
}

TEST(UnbalanceResponse, OfARigidRotorFollowsTheClosedForm) {
  const auto geometry = uniform_beam(8, 0.1);
  const double m = rigid_body(geometry).mass, K = 3e6, C = 500, omega = 5000 * rpm, me = 1e-4, a = 0.9;
  const auto response = unbalance_response(geometry, {.cut_off_frequency = 0}, omega, {{5, me, a}},
                                           {{3, isotropic(K), isotropic(C)}, {7, isotropic(K), isotropic(C)}});
  const Complex V = me * omega * omega * std::polar(1.0, a) / (2 * K - m * omega * omega + Complex(0, 2 * C * omega));
  for (Eigen::Index k = 0; k < response.v.size(); ++k) {
    EXPECT_LT(std::abs(response.v[k] - V), 1e-12 * std::abs(V));
    EXPECT_LT(std::abs(response.w[k] - Complex(0, -1) * V), 1e-12 * std::abs(V));
  }
}

/// The reference rotor at 15200 rpm with its five flexible modes on anisotropic, cross-coupled supports.
class UnbalanceInTime : public ::testing::Test {
 protected:
  const double omega = 15200 * rpm;
  const Matrix K1{{{2.0e7, 1.5e6}, {-1.0e6, 1.4e7}}}, C1{{{2.5e4, 2e3}, {-1e3, 2.0e4}}};
  const Matrix K2{{{1.2e7, -2e6}, {1.0e6, 1.8e7}}}, C2{{{1.8e4, 0}, {1.5e3, 2.2e4}}};
  const std::vector<Unbalance> unbalance{{5, 1.07e-6, std::numbers::pi}, {16, 2.78e-6, 0.6}};
  const RotorGeometry geometry = reference_rotor();
  RotorSettings settings = [this] {
    RotorSettings s;
    s.modal_damping = 0.02;
    s.mass_proportional_alpha = 5;
    s.unbalance = unbalance;
    return s;
  }();
  const ModalRotor rotor{geometry, settings, {2, 28}};
  const LinearSupport left{"left", K1, C1}, right{"right", K2, C2};
  const HeldRotor held{rotor, {&left, &right}};
  const std::vector<LinearSupportAtNode> supports{{2, K1, C1}, {28, K2, C2}};
  const SynchronousResponse response =
      unbalance_response(geometry, {.modal_damping = 0.02, .mass_proportional_alpha = 5, .cut_off_frequency = 4500},
                         omega, unbalance, supports);

  void compare_with_response(const std::vector<double>& y, double tolerance) const {
    const std::vector<Motion> node = testing::node_motions(rotor, y);
    const Complex turn = std::polar(1.0, rotor.spin(y).angle);
    const double largest = response.v.cwiseAbs().maxCoeff();
    for (Eigen::Index k = 0; k < response.v.size(); ++k) {
      const Motion& at = node[static_cast<std::size_t>(k)];
      EXPECT_NEAR(at.y, std::real(response.v[k] * turn), tolerance * largest) << "m, node " << k + 1;
      EXPECT_NEAR(at.z, std::real(response.w[k] * turn), tolerance * largest) << "m, node " << k + 1;
    }
  }
};

TEST_F(UnbalanceInTime, SettlesFromRestOnTheFrequencyResponse) {
  std::vector<double> y(rotor.n_state());
  rotor.initial_rigid_state({}, {0, omega}, y);
  held.integrate(1e-5, 40000, y);
  compare_with_response(y, 1e-7);  // transients have died by e^-30; RK4 errs by (omega h)^4 / 120 per radian
}

TEST_F(UnbalanceInTime, StaysOnTheFrequencyResponse) {
  std::vector<double> y(rotor.n_state());
  rotor.initial_rigid_state({}, {0, omega}, y);
  const std::size_t n = rotor.n_modes();
  ASSERT_EQ(response.q_y.size(), static_cast<Eigen::Index>(n));
  for (std::size_t k = 0; k < n; ++k) {
    const Complex q_y = response.q_y[static_cast<Eigen::Index>(k)], q_z = response.q_z[static_cast<Eigen::Index>(k)];
    y[k] = std::real(q_y);
    y[n + k] = std::real(q_z);
    y[2 * n + k] = std::real(Complex(0, omega) * q_y);
    y[3 * n + k] = std::real(Complex(0, omega) * q_z);
  }
  compare_with_response(y, 1e-12);
  for (int part = 0; part < 10; ++part) {
    held.integrate(1e-5, 97, y);
    compare_with_response(y, 1e-7);
  }
}

TEST_F(UnbalanceInTime, AsksForAllModesOnlyInTheSecondDigit) {
  const auto all =
      unbalance_response(geometry, {.modal_damping = 0.02, .mass_proportional_alpha = 5}, omega, unbalance, supports);
  const double largest = all.v.cwiseAbs().maxCoeff(), difference = (all.v - response.v).cwiseAbs().maxCoeff();
  EXPECT_LT(difference, 0.05 * largest) << "the support stiffness of 2e7 N/m bends modes that the cut-off leaves out";
  std::printf("cut-off 4500 Hz against all modes: %.2f %% of the largest response\n", 100 * difference / largest);
}

}  // namespace
}  // namespace rotordrop
