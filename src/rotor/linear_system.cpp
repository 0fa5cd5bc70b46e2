#include "rotor/linear_system.h"

#include <algorithm>
#include <cmath>

namespace rotordrop {

LinearSystem linear_system(const ModalBasis& basis, const ModalAnalysisOptions& options, double spin_speed,
                           const std::vector<LinearSupportAtNode>& supports) {
  const Eigen::Index n = basis.n_modes();
  LinearSystem system{Eigen::MatrixXd::Zero(2 * n, 2 * n), Eigen::MatrixXd::Zero(2 * n, 2 * n)};
  for (Eigen::Index plane = 0; plane < 2; ++plane)
    for (Eigen::Index k = 0; k < n; ++k) {
      const Eigen::Index row = plane * n + k;
      system.stiffness(row, row) = basis.omega(k) * basis.omega(k);
      system.damping(row, row) = 2 * options.modal_damping * basis.omega(k) + options.mass_proportional_alpha;
    }
  system.damping.topRightCorner(n, n) += spin_speed * basis.gyroscopic;
  system.damping.bottomLeftCorner(n, n) -= spin_speed * basis.gyroscopic;
  for (const auto& support : supports) {
    const Eigen::VectorXd deflection = basis.shape.row(2 * support.node - 2).transpose();
    const Eigen::MatrixXd at_support = deflection * deflection.transpose() / basis.body.mass;
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) {
        const auto row = static_cast<Eigen::Index>(i) * n, column = static_cast<Eigen::Index>(j) * n;
        system.stiffness.block(row, column, n, n) += support.stiffness[i][j] * at_support;
        system.damping.block(row, column, n, n) += support.damping[i][j] * at_support;
      }
  }
  return system;
}

FirstOrder first_order(const ModalBasis& basis, const LinearSystem& system) {
  const Eigen::Index n = basis.n_modes(), N = 2 * n;
  FirstOrder result;
  std::vector<double> W;
  for (Eigen::Index row = 0; row < N; ++row) {
    if (system.stiffness.row(row).isZero(0) && system.stiffness.col(row).isZero(0)) continue;
    result.held.push_back(row);
    W.push_back(std::sqrt(std::max(std::abs(system.stiffness(row, row)), 1.0)));
  }
  const auto n_held = static_cast<Eigen::Index>(W.size());
  result.A = Eigen::MatrixXd::Zero(n_held + N, n_held + N);
  for (Eigen::Index k = 0; k < n_held; ++k) {
    const Eigen::Index row = result.held[static_cast<std::size_t>(k)];
    const double w = W[static_cast<std::size_t>(k)];
    result.A(k, n_held + row) = w;
    result.A.block(n_held, k, N, 1) = -system.stiffness.col(row) / w;
  }
  result.A.bottomRightCorner(N, N) = -system.damping;
  return result;
}

}  // namespace rotordrop
