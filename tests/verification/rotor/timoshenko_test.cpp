// Elements and free-free modes against closed forms.
//
// EXACT FREE-FREE TIMOSHENKO BEAM (Huang 1961, here for one class of symmetry; derived so that it can be checked)
// Deflection v, section rotation psi, harmonic with omega, beam of length L centred at x = 0:
//   kappa G A (v'' - psi') + rho A omega^2 v = 0                              balance of forces
//   E I psi'' + kappa G A (v' - psi) + rho I omega^2 psi = 0                  balance of moments
// Let k = rho omega^2 / (kappa G), e = rho omega^2 / E, b = rho A omega^2 / (E I) and v ~ exp(s x). The first gives
// psi = (s^2 + k)/s v, and the second then
//   (s^2 + k)(s^2 + e) = b,   so s^2 = -(k + e)/2 +- sqrt(((k - e)/2)^2 + b):   s = +-p and s = +-i q while k e < b.
// Symmetric modes: v = A cosh px + B cos qx, psi = A (p^2 + k)/p sinh px - B (q^2 - k)/q sin qx.
// Free ends at x = L/2 = l: psi' = A (p^2 + k) cosh pl - B (q^2 - k) cos ql = 0 and
// v' - psi = -A k/p sinh pl - B k/q sin ql = 0. The determinant vanishes for
//   p (p^2 + k) tan ql + q (q^2 - k) tanh pl = 0.
// (A thin beam, k -> 0 and p = q, has tan ql + tanh pl = 0, the Euler beam: ql = 2.36502.)
// The first root is the first bending mode.
//
// LEADING ERROR OF THE ELEMENT. Its shape functions are static deflections: in each element the shear strain gamma is
// constant and the section rotation quadratic with E I psi'' = -kappa G A gamma. The true mode has
//   gamma' = -k v (balance of forces),   E I psi'' = -kappa G A gamma - rho I omega^2 psi (balance of moments),
// so the element misses the slope k v of the shear strain and e psi of psi''. An element of length h thereby overrates
// the elastic energy by
//   h^3/24 (kappa G A (k v)^2 + E I (e psi)^2) = h^3/24 omega^2 (k rho A v^2 + e rho I psi^2).
// Against the kinetic energy (Rayleigh), whose parts of translation and rotation are T_t and T_r,
//   relative error of the frequency = h^2 / 24 (k T_t + e T_r) / (T_t + T_r) + O(h^4):
// order 2 with a coefficient that vanishes for slender beams, which therefore show order 4 on practical meshes.
//
// SOLID CYLINDERS  m = rho pi/4 (D^2 - d^2) L,  Ip = m (D^2 + d^2)/8,  Id = m ((D^2 + d^2)/16 + L^2/12).
#include "rotor/timoshenko.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdio>
#include <limits>

#include "rotor/modal_basis.h"
#include "test_rotors.h"

namespace rotordrop {
namespace {

using testing::reference_rotor;
using testing::two_pi;
using testing::uniform_beam;

constexpr double all = std::numeric_limits<double>::infinity();

/// First free-free bending mode of uniform_beam(., od, id), exact.
struct ExactMode {
  double frequency = 0;      ///< [Hz]
  double leading_error = 0;  ///< of the element's frequency, per h^2 [1/m^2]
};

ExactMode exact_first_mode(double od, double id) {
  const double L = 1, l = L / 2, E = 2.0e11, nu = 0.3, rho = 7850;
  const double A = std::numbers::pi / 4 * (od * od - id * id),
               I = std::numbers::pi / 64 * (std::pow(od, 4) - std::pow(id, 4));
  const double kappa_G = cowper_shear_coefficient(nu, id / od) * E / (2 * (1 + nu));
  double k = 0, p = 0, q = 0;
  const auto frequency_equation = [&](double omega) {
    k = rho * omega * omega / kappa_G;
    const double e = rho * omega * omega / E, b = rho * A * omega * omega / (E * I);
    const double root = std::sqrt((k - e) * (k - e) / 4 + b);
    p = std::sqrt(root - (k + e) / 2);
    q = std::sqrt(root + (k + e) / 2);
    // Multiplied by cos(ql), so that it has no poles.
    return p * (p * p + k) * std::sin(q * l) + q * (q * q - k) * std::tanh(p * l) * std::cos(q * l);
  };
  const double euler =
      4 * 2.3650204 * 2.3650204 * std::sqrt(E * I / (rho * A));  // shear and rotary inertia only lower it
  double low = 0.6 * euler, high = euler;
  EXPECT_LT(frequency_equation(low) * frequency_equation(high), 0) << "the bracket must hold the root";
  for (int step = 0; step < 200; ++step) {
    const double middle = 0.5 * (low + high);
    (frequency_equation(low) * frequency_equation(middle) <= 0 ? high : low) = middle;
  }
  // The mode, from psi' = 0 at the end; its kinetic energies by the trapezoidal rule.
  frequency_equation(low);
  const double a = (q * q - k) * std::cos(q * l), b = (p * p + k) * std::cosh(p * l);
  double translation = 0, rotation = 0;
  const int n = 20000;
  for (int i = 0; i <= n; ++i) {
    const double x = l * i / n, weight = i == 0 || i == n ? 0.5 : 1;
    const double v = a * std::cosh(p * x) + b * std::cos(q * x);
    const double psi = a * (p * p + k) / p * std::sinh(p * x) - b * (q * q - k) / q * std::sin(q * x);
    translation += weight * A * v * v;
    rotation += weight * I * psi * psi;
  }
  const double e = rho * low * low / E;
  return {low / two_pi, (k * translation + e * rotation) / (translation + rotation) / 24};
}

double first_frequency(const RotorGeometry& geometry) { return free_free_modes(geometry, all).omega(2) / two_pi; }

TEST(ReferenceRotor, HasThePublishedMassAndInertias) {
  const RigidBody body = rigid_body(reference_rotor());
  EXPECT_NEAR(body.mass, 109.69969069928678, 1e-9) << "kg";
  EXPECT_NEAR(body.Ip, 0.3899981437441726, 1e-12) << "kg m2";
  EXPECT_NEAR(body.Id, 4.553511077582994, 1e-10) << "kg m2";
  EXPECT_NEAR(body.centre_of_gravity, 0.46020378659756267, 1e-12) << "m";
}

TEST(ReferenceRotor, HasThePublishedFirstBendingFrequencyAndThreeMore) {
  const auto basis = free_free_modes(reference_rotor(), all);
  const double expected[] = {673.4957006979913, 1220.8702983937935, 2030.6419642551928,
                             2765.536416042251};  // rotor.json, "achieved"
  for (int k = 0; k < 4; ++k)
    EXPECT_NEAR(basis.omega(2 + k) / two_pi / expected[k], 1, 1e-8) << "flexible mode " << k + 1;
}

TEST(ReferenceRotor, HasFiveFlexibleModesBelow4500Hz) {
  EXPECT_EQ(free_free_modes(reference_rotor(), 4500).n_modes(), 2 + 5);
  EXPECT_NEAR(free_free_modes(reference_rotor(), 6000).omega(7) / two_pi, 5003.6, 0.1) << "Hz, the sixth";
}

TEST(AssembledMatrices, HaveTheSameRigidBodyAsTheSumOfCylinders) {
  for (const auto& geometry : {reference_rotor(), uniform_beam(7, 0.08, 0.03)}) {
    const auto matrices = assemble(geometry);
    const RigidBody body = rigid_body(geometry);
    const Eigen::Index n = matrices.mass.rows();
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(n), tilt = Eigen::VectorXd::Zero(n);
    for (int node = 1; node <= geometry.n_nodes(); ++node) {
      shift(2 * node - 2) = 1;
      tilt(2 * node - 2) = geometry.position(node) - body.centre_of_gravity;
      tilt(2 * node - 1) = 1;
    }
    EXPECT_NEAR(shift.dot(matrices.mass * shift) / body.mass, 1, 1e-12);
    EXPECT_NEAR(tilt.dot(matrices.mass * tilt) / body.Id, 1, 1e-12);
    EXPECT_NEAR(tilt.dot(matrices.gyroscopic * tilt) / body.Ip, 1, 1e-12);
    EXPECT_NEAR(shift.dot(matrices.mass * tilt) / body.mass, 0, 1e-12) << "m: about the centre of gravity";
    // Roundoff of the stiffness of the shortest element.
    EXPECT_LT((matrices.stiffness * shift).norm(), 1e-12 * matrices.stiffness.norm());
    EXPECT_LT((matrices.stiffness * tilt).norm(), 1e-12 * matrices.stiffness.norm());
  }
}

TEST(TimoshenkoElement, BendsAsTheClosedFormOfACantileverUnderAnEndLoad) {
  // One element is exact: deflection F L^3 / (3 E I) + F L / (kappa G A), slope of the section F L^2 / (2 E I).
  const RotorMaterial material{2.1e11, 0.28, 7800};
  const double L = 0.2, D = 0.1, d = 0.06, F = 1000;
  const auto K = timoshenko_element(L, D, d, material).stiffness;
  const Eigen::Vector2d end = K.bottomRightCorner<2, 2>().inverse() * Eigen::Vector2d(F, 0);
  const double I = std::numbers::pi / 64 * (std::pow(D, 4) - std::pow(d, 4)),
               A = std::numbers::pi / 4 * (D * D - d * d);
  const double kappa_G_A = cowper_shear_coefficient(0.28, 0.6) * 2.1e11 / 2.56 * A;
  EXPECT_NEAR(end(0) / (F * L * L * L / (3 * 2.1e11 * I) + F * L / kappa_G_A), 1, 1e-12);
  EXPECT_NEAR(end(1) / (F * L * L / (2 * 2.1e11 * I)), 1, 1e-12);
}

TEST(TimoshenkoElement, FirstFrequencyOfAUniformBeamIs223Point19Hz) {
  EXPECT_NEAR(first_frequency(uniform_beam(30, 0.05)), 223.19, 0.005) << "Hz";
  EXPECT_NEAR(exact_first_mode(0.05, 0).frequency, 223.185, 0.0005) << "Hz";
}

/// Prints the table h, error, order; returns the errors for 2, 4 ... 32 elements.
std::vector<double> convergence(double od, double id) {
  const double exact = exact_first_mode(od, id).frequency;
  std::printf("uniform beam %.0f x %.0f mm, exact first frequency %.8f Hz\n      h [m]   relative error   order\n",
              1e3 * od, 1e3 * id, exact);
  std::vector<double> errors;
  for (const int n : {2, 4, 8, 16, 32}) {
    const double error = first_frequency(uniform_beam(n, od, id)) / exact - 1;
    std::printf("  %9.5f   %14.3e   %5.2f\n", 1.0 / n, error, errors.empty() ? 0 : std::log2(errors.back() / error));
    EXPECT_GT(error, 0) << "conforming element, consistent mass: frequencies come from above";
    errors.push_back(error);
  }
  return errors;
}

TEST(TimoshenkoElement, ConvergesToTheExactTimoshenkoBeamWithOrderTwoAndTheDerivedCoefficient) {
  for (const auto& [od, id] : {std::pair(0.05, 0.0), std::pair(0.2, 0.12)}) {
    const auto error = convergence(od, id);
    EXPECT_GT(std::log2(error[3] / error[4]), 1.95);
    const double leading = exact_first_mode(od, id).leading_error / (32 * 32);
    const double without_fourth_order = (16 * error[4] - error[3]) / 12;  // of c2 h^2 + c4 h^4 at h and 2 h
    std::printf("  order-2 part at the finest h %.4e, derived %.4e\n", without_fourth_order, leading);
    EXPECT_NEAR(without_fourth_order / leading, 1, 0.002);
  }
}

TEST(TimoshenkoElement, ConvergesWithOrderFourOnASlenderBeam) {
  const auto error = convergence(0.004, 0);
  // The next term, of order 6, and what is left of order 2 take up to 0.26 from four.
  EXPECT_NEAR(std::log2(error[1] / error[2]), 4, 0.3);
  EXPECT_NEAR(std::log2(error[2] / error[3]), 4, 0.3);
  EXPECT_LT(error[4], 1e-6);
}

TEST(ShearCoefficient, OfAHollowSectionTendsToTheSolidOne) {
  for (const double nu : {0.0, 0.26, 0.3, 0.5}) {
    const double solid = 6 * (1 + nu) / (7 + 6 * nu);
    EXPECT_DOUBLE_EQ(cowper_shear_coefficient(nu, 0), solid);
    // (d/D)^2 = 1e-8, times up to 2.5
    EXPECT_NEAR(cowper_shear_coefficient(nu, 1e-4), solid, 1e-7);
  }
  // Cowper's thin tube: 2 (1 + nu) / (4 + 3 nu).
  EXPECT_NEAR(cowper_shear_coefficient(0.3, 1 - 1e-9), 2 * 1.3 / 4.9, 1e-8);
  EXPECT_NEAR(cowper_shear_coefficient(0.3, 0), 0.886364, 1e-6) << "rotor.json states it";
}

TEST(SteppedRotor, OfTwoMaterialsWithASleeveHasTheMassOfItsCylinders) {
  const RotorMaterial steel{2.0e11, 0.3, 7850}, aluminium{7e10, 0.33, 2700};
  RotorGeometry geometry;
  geometry.node_x = {0, 0.1, 0.3};
  geometry.elements = {{1, 2, 0.05, 0, steel}, {2, 3, 0.04, 0.02, aluminium}, {1, 2, 0.09, 0.05, aluminium}};
  geometry.mass_points = {{3, 2.0, 0.01, 0.006}};
  const double quarter_pi = std::numbers::pi / 4;
  const double m1 = 7850 * quarter_pi * 0.0025 * 0.1, m2 = 2700 * quarter_pi * 0.0012 * 0.2,
               m3 = 2700 * quarter_pi * 0.0056 * 0.1;
  const RigidBody body = rigid_body(geometry);
  EXPECT_NEAR(body.mass, m1 + m2 + m3 + 2, 1e-12) << "kg";
  EXPECT_NEAR(body.centre_of_gravity, ((m1 + m3) * 0.05 + m2 * 0.2 + 2 * 0.3) / body.mass, 1e-14) << "m";
  EXPECT_NEAR(body.Ip, (m1 * 0.0025 + m2 * 0.0020 + m3 * 0.0106) / 8 + 0.01, 1e-15) << "kg m2";
}

TEST(FreeFreeModes, DiagonaliseMassAndStiffness) {
  const auto geometry = reference_rotor();
  const auto matrices = assemble(geometry);
  const auto basis = free_free_modes(geometry, all);
  const Eigen::Index n = basis.n_modes();
  ASSERT_EQ(n, 2 * geometry.n_nodes()) << "all modes: a change of basis";
  const double m = basis.body.mass;
  EXPECT_LT((basis.shape.transpose() * matrices.mass * basis.shape / m - Eigen::MatrixXd::Identity(n, n))
                .cwiseAbs()
                .maxCoeff(),
            1e-10);
  const Eigen::MatrixXd K = basis.shape.transpose() * matrices.stiffness * basis.shape / m;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const double expected = i == j ? basis.omega(i) * basis.omega(i) : 0;
      EXPECT_NEAR(K(i, j), expected, 1e-12 * basis.omega(n - 1) * basis.omega(n - 1)) << i << ", " << j;
    }
}

}  // namespace
}  // namespace rotordrop
