// Modes cut off, with the static flexibility of the stations kept.
//
// INERTIA RELIEF. A free body under a force f is accelerated; what bends it is P f, P = I - M R R^T / m with the rigid modes R (R^T M R = m).
// u = K^+ P f, freed of rigid motion by P^T, is its static deflection: flexibility S^T P^T K^+ P S at the rows S, found here by a
// decomposition of the stiffness matrix, without any mode.
// FORCED RESPONSE. All modes give H(w) = sum phi phi^T / (m (w_k^2 - w^2)). Modes beyond the cut-off w_c, taken as static, lack a part of at most
// (w/w_c)^2 / (1 - (w/w_c)^2) of what they would give at w.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "rotor/modal_basis.h"
#include "rotor/timoshenko.h"
#include "test_rotors.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

const std::vector<int> stations = {2, 28};
constexpr double two_pi = 2 * std::numbers::pi;

Eigen::Matrix2d at_stations(const Eigen::MatrixXd& flexibility) {
  Eigen::Matrix2d result;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) result(i, j) = flexibility(2 * stations[i] - 2, 2 * stations[j] - 2);
  return result;
}

/// Of the flexible modes, at the stations, under forces of a frequency [Hz].
Eigen::Matrix2d response(const ModalBasis& basis, double frequency) {
  const double w2 = std::pow(two_pi * frequency, 2);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(basis.shape.rows(), basis.shape.rows());
  for (Eigen::Index k = 2; k < basis.n_modes(); ++k)
    sum += basis.shape.col(k) * basis.shape.col(k).transpose() / (basis.body.mass * (std::pow(basis.omega(k), 2) - w2));
  return at_stations(sum);
}

/// Of a free rotor, without any mode.
Eigen::Matrix2d exact_flexibility(const RotorGeometry& geometry) {
  const RotorMatrices fe = assemble(geometry);
  const auto bare = free_free_modes(geometry, 0.);
  const Eigen::MatrixXd R = bare.shape.leftCols(2);
  const Eigen::MatrixXd P =
      Eigen::MatrixXd::Identity(fe.mass.rows(), fe.mass.rows()) - fe.mass * R * R.transpose() / bare.body.mass;
  // Held at two places the shaft stands; what is held there carries nothing, since P f is in balance.
  Eigen::MatrixXd K = fe.stiffness;
  const double spring = K.diagonal().mean();
  K(0, 0) += spring;
  K(K.rows() - 2, K.rows() - 2) += spring;
  return at_stations(P.transpose() * K.ldlt().solve(P));
}

TEST(ResidualFlexibility, KeepsTheStaticFlexibilityOfTheStations) {
  const auto geometry = reference_rotor();
  const auto bare = free_free_modes(geometry, 4500.), with = free_free_modes(geometry, 4500., stations);
  const Eigen::Matrix2d exact = exact_flexibility(geometry);
  const double lost = (response(bare, 0.) - exact).norm() / exact.norm();
  const double left = (response(with, 0.) - exact).norm() / exact.norm();
  printf("static flexibility of the stations: five modes lack %.3g, with residual %.1e\n", lost, left);
  EXPECT_GT(lost, 1e-3);
  EXPECT_LT(left, 1e-8) << "roundoff of a stiffness matrix whose eigenvalues span 1e8";
}

TEST(ResidualFlexibility, IsKeptWithoutAnyOtherMode) {
  const auto geometry = reference_rotor();
  const auto alone = free_free_modes(geometry, 0., stations);
  ASSERT_EQ(alone.n_modes(), 4);
  const Eigen::Matrix2d exact = exact_flexibility(geometry);
  EXPECT_LT((response(alone, 0.) - exact).norm(), 1e-8 * exact.norm());
  EXPECT_EQ(free_free_modes(geometry, 0.).n_modes(), 2) << "a rigid rotor has none";
}

TEST(ResidualFlexibility, IsMadeOfModesWithTheirTrueMass) {
  const auto geometry = reference_rotor();
  const RotorMatrices fe = assemble(geometry);
  for (const double cut_off : {1000., 2000., 4500., 10000.}) {
    const auto bare = free_free_modes(geometry, cut_off), with = free_free_modes(geometry, cut_off, stations);
    ASSERT_EQ(with.n_modes(), bare.n_modes() + 2);
    EXPECT_LT((with.shape.leftCols(bare.n_modes()) - bare.shape).norm(), 1e-12 * bare.shape.norm())
        << "those that were kept before, but for roundoff";
    const double m = bare.body.mass;
    const Eigen::MatrixXd M = with.shape.transpose() * fe.mass * with.shape / m;
    const Eigen::MatrixXd K = with.shape.transpose() * fe.stiffness * with.shape / m;
    const auto n = with.n_modes();
    EXPECT_LT((M - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff(), 1e-10);
    const Eigen::VectorXd w2 = with.omega.cwiseAbs2();
    EXPECT_LT((K - Eigen::MatrixXd(w2.asDiagonal())).cwiseAbs().maxCoeff(), 1e-7 * w2.maxCoeff());
    EXPECT_GT(with.omega(bare.n_modes()), two_pi * cut_off);
    printf("cut-off %6.0f Hz: residual modes at %.0f and %.0f Hz\n", cut_off, with.omega(n - 2) / two_pi,
           with.omega(n - 1) / two_pi);
  }
}

TEST(ResidualFlexibility, BringsForcedResponseCloserByTheSquareOfTheFrequency) {
  const auto geometry = reference_rotor();
  const auto all = free_free_modes(geometry, std::numeric_limits<double>::infinity());
  printf("forced response at both stations, 300 Hz: error over cut-off [Hz], without and with residual\n");
  const double frequency = 300.;
  const Eigen::Matrix2d exact = response(all, frequency);
  for (const double cut_off : {800., 2000., 4500., 10000.}) {
    const double bare = (response(free_free_modes(geometry, cut_off), frequency) - exact).norm() / exact.norm();
    const double with =
        (response(free_free_modes(geometry, cut_off, stations), frequency) - exact).norm() / exact.norm();
    printf("  %6.0f  %.2e  %.2e\n", cut_off, bare, with);
    const double ratio2 = std::pow(frequency / cut_off, 2);
    // Both parts are sums of modes with one sign on the diagonal; the norm takes the others along.
    EXPECT_LT(with, 1.5 * ratio2 * bare) << cut_off << " Hz";
  }
}

TEST(ResidualFlexibility, OfAllModesIsNone) {
  const auto geometry = reference_rotor();
  const double all = std::numeric_limits<double>::infinity();
  EXPECT_EQ(free_free_modes(geometry, all, stations).n_modes(), free_free_modes(geometry, all).n_modes());
  // A station twice adds one shape.
  EXPECT_EQ(free_free_modes(geometry, 4500., {2, 2}).n_modes(), free_free_modes(geometry, 4500.).n_modes() + 1);
}

}  // namespace
}  // namespace rotordrop
