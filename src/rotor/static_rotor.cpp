#include "rotor/static_rotor.h"

#include <algorithm>
#include <stdexcept>

#include "rotor/timoshenko.h"

namespace rotordrop {

StaticRotor::StaticRotor(const RotorGeometry& geometry, const std::vector<int>& stations,
                         const std::array<double, 2>& gravity, const std::vector<RotorLoad>& loads,
                         const std::vector<int>& tilted)
    : n_nodes_(static_cast<std::size_t>(geometry.n_nodes())) {
  if (stations.size() < 2) throw std::invalid_argument("a rotor at rest needs two supports");
  const RotorMatrices m = assemble(geometry);
  for (const int node : stations) held_rows_.push_back(2 * (node - 1));
  for (const int node : tilted) held_rows_.push_back(2 * (node - 1) + 1);
  for (Eigen::Index row = 0; row < m.stiffness.rows(); ++row)
    if (std::find(held_rows_.begin(), held_rows_.end(), row) == held_rows_.end()) free_rows_.push_back(row);
  const Eigen::MatrixXd K_ff = m.stiffness(free_rows_, free_rows_);
  coupling_ = m.stiffness(free_rows_, held_rows_);
  free_.compute(K_ff);
  stiffness_ = m.stiffness(held_rows_, held_rows_) - coupling_.transpose() * free_.solve(coupling_);
  stiffness_ = 0.5 * (stiffness_ + stiffness_.transpose()).eval();

  Eigen::VectorXd uniform = Eigen::VectorXd::Zero(m.mass.rows());
  for (Eigen::Index row = 0; row < uniform.size(); row += 2) uniform[row] = 1.;
  for (std::size_t plane = 0; plane < 2; ++plane) {
    Eigen::VectorXd f = gravity[plane] * (m.mass * uniform);
    for (const auto& load : loads) f[2 * (load.node - 1)] += load.force[plane];
    free_load_[plane] = f(free_rows_);
    load_[plane] = f(held_rows_) - coupling_.transpose() * free_.solve(free_load_[plane]);
  }
}

std::vector<double> StaticRotor::deflections(std::size_t plane, const Eigen::VectorXd& held) const {
  const Eigen::VectorXd rest = free_.solve(free_load_[plane] - coupling_ * held);
  std::vector<double> v(n_nodes_);
  for (std::size_t i = 0; i < held_rows_.size(); ++i)
    if (held_rows_[i] % 2 == 0) v[static_cast<std::size_t>(held_rows_[i] / 2)] = held[static_cast<Eigen::Index>(i)];
  for (std::size_t i = 0; i < free_rows_.size(); ++i)
    if (free_rows_[i] % 2 == 0) v[static_cast<std::size_t>(free_rows_[i] / 2)] = rest[static_cast<Eigen::Index>(i)];
  return v;
}

}  // namespace rotordrop
