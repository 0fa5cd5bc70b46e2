#include "rotor/modal_basis.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <deque>
#include <mutex>
#include <numbers>

#include "rotor/timoshenko.h"

namespace rotordrop {

namespace {

/// Combinations of modes that reproduce their joint static flexibility at some nodes.
struct Residual {
  Eigen::VectorXd omega;     // [rad/s]
  Eigen::MatrixXd in_modes;  // [n_modes x n_residual], orthonormal
};

/// @param omega  of the modes beyond the cut-off; @param at_nodes  [n_modes x n_nodes] their deflections there
Residual residual_modes(const Eigen::VectorXd& omega, const Eigen::MatrixXd& at_nodes) {
  // Amplitudes under unit forces; nodes that are next to each other may add nothing new.
  const Eigen::VectorXd stiffness = omega.cwiseAbs2();
  const Eigen::MatrixXd amplitudes = stiffness.cwiseInverse().asDiagonal() * at_nodes;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(amplitudes);
  qr.setThreshold(1e-8);
  const Eigen::MatrixXd all = qr.householderQ() * Eigen::MatrixXd::Identity(omega.size(), qr.rank());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(all.transpose() * stiffness.asDiagonal() * all);
  return {solver.eigenvalues().cwiseSqrt(), all * solver.eigenvectors()};
}

ModalBasis computed_modes(const RotorGeometry& geometry, double cut_off_frequency,
                          const std::vector<int>& attachment_nodes) {
  const RotorMatrices fe = assemble(geometry);
  const Eigen::Index n_dofs = fe.mass.rows();
  ModalBasis basis;
  basis.body = rigid_body(geometry);
  const double m = basis.body.mass;
  const double radius_of_gyration = std::sqrt(basis.body.Id / m);

  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(n_dofs, 2);
  for (int node = 1; node <= geometry.n_nodes(); ++node) {
    rigid(2 * node - 2, 0) = 1;
    rigid(2 * node - 2, 1) = (geometry.position(node) - basis.body.centre_of_gravity) / radius_of_gyration;
    rigid(2 * node - 1, 1) = 1 / radius_of_gyration;
  }

  Eigen::Index n_flexible = 0;
  Eigen::MatrixXd flexible(n_dofs, 0);
  Eigen::VectorXd omega(0);
  if (cut_off_frequency > 0 || !attachment_nodes.empty()) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(fe.stiffness, fe.mass);
    assert(solver.info() == Eigen::Success);
    // Ascending; the first two are the rigid modes, of which the solver knows only some mixture with roundoff
    // frequencies.
    omega = solver.eigenvalues().tail(n_dofs - 2).cwiseMax(0).cwiseSqrt();
    const double omega_max = 2 * std::numbers::pi * cut_off_frequency;
    n_flexible = std::count_if(omega.begin(), omega.end(), [&](double w) { return w <= omega_max; });
    flexible = solver.eigenvectors().middleCols(2, n_flexible);
    if (const Eigen::Index n_beyond = omega.size() - n_flexible; n_beyond > 0 && !attachment_nodes.empty()) {
      const Eigen::MatrixXd beyond = solver.eigenvectors().rightCols(n_beyond);
      Eigen::MatrixXd at_nodes(n_beyond, static_cast<Eigen::Index>(attachment_nodes.size()));
      for (Eigen::Index k = 0; k < at_nodes.cols(); ++k)
        at_nodes.col(k) = beyond.row(2 * attachment_nodes[static_cast<std::size_t>(k)] - 2).transpose();
      const Residual residual = residual_modes(omega.tail(n_beyond), at_nodes);
      const Eigen::Index n_residual = residual.omega.size();
      flexible.conservativeResize(Eigen::NoChange, n_flexible + n_residual);
      flexible.rightCols(n_residual) = beyond * residual.in_modes;
      omega.segment(n_flexible, n_residual) = residual.omega;
      n_flexible += n_residual;
    }
    // Orthogonal to the analytic rigid modes to the last digit: no roundoff stiffness or gravity leaks between them.
    for (int pass = 0; pass < 2; ++pass) flexible -= rigid * (rigid.transpose() * fe.mass * flexible) / m;
    for (Eigen::Index k = 0; k < n_flexible; ++k) {
      auto mode = flexible.col(k);
      mode *= std::sqrt(m / mode.dot(fe.mass * mode));
      if (mode(0) < 0) mode *= -1;  // sign by convention: node 1 moves up
    }
  }

  const Eigen::Index n = 2 + n_flexible;
  basis.omega = Eigen::VectorXd::Zero(n);
  basis.omega.tail(n_flexible) = omega.head(n_flexible);
  basis.shape.resize(n_dofs, n);
  basis.shape << rigid, flexible;
  const Eigen::MatrixXd G = basis.shape.transpose() * fe.gyroscopic * basis.shape / m;
  basis.gyroscopic = 0.5 * (G + G.transpose());
  basis.gyroscopic.row(0).setZero();
  basis.gyroscopic.col(0).setZero();
  return basis;
}

/// The bases that were asked for last.
class KeptBases {
 public:
  ModalBasis get(const RotorGeometry& geometry, double cut_off_frequency, const std::vector<int>& attachment_nodes) {
    const auto is_it = [&](const Kept& kept) {
      return kept.cut_off_frequency == cut_off_frequency && kept.attachment_nodes == attachment_nodes &&
             kept.geometry == geometry;
    };
    {
      const std::scoped_lock guard(lock_);
      if (const auto found = std::find_if(kept_.begin(), kept_.end(), is_it); found != kept_.end()) return found->basis;
    }
    ModalBasis basis = computed_modes(geometry, cut_off_frequency, attachment_nodes);
    const std::scoped_lock guard(lock_);
    kept_.push_front({geometry, cut_off_frequency, attachment_nodes, basis});
    if (kept_.size() > most_kept) kept_.pop_back();
    return basis;
  }

 private:
  struct Kept {
    RotorGeometry geometry;
    double cut_off_frequency;
    std::vector<int> attachment_nodes;
    ModalBasis basis;
  };
  static constexpr std::size_t most_kept = 4;
  std::mutex lock_;
  std::deque<Kept> kept_;
};

}  // namespace

ModalBasis free_free_modes(const RotorGeometry& geometry, double cut_off_frequency,
                           const std::vector<int>& attachment_nodes) {
  static KeptBases bases;
  return bases.get(geometry, cut_off_frequency, attachment_nodes);
}

}  // namespace rotordrop
