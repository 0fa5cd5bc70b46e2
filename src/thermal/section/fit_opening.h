#pragma once
#include <Eigen/Dense>
#include <span>
#include <vector>

#include "model/thermo_elasticity.h"

namespace rotordrop {

/// A fit that opens where it would have to pull: gaps g >= 0 and forces f = f_closed + S g >= 0 of its nodes, one of them zero at each. S, the forces
/// per gap, is symmetric and positive definite, so there is one such state, and it does not depend on what was before.
class FitOpening {
 public:
  /// @param openings  of ElasticSolver::openings(), not empty
  explicit FitOpening(const FitOpenings& openings);
  /// @param pressures  of the nodes if the fit stays closed: their forces over their shares [n] [Pa]
  /// @param sizes      of what adds up to each of them: its roundoff neither opens nor closes [n] [Pa]
  /// @throws SolverError if no state is found
  void solve(std::span<const double> pressures, std::span<const double> sizes);
  /// What the gaps add to an output.
  [[nodiscard]] double added(std::size_t output) const { return per_gap_.row(index(output)).dot(gap_); }
  /// As ElasticSolver::fit(), without its points.
  [[nodiscard]] FitState state() const;

 private:
  static Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }
  [[nodiscard]] std::vector<Eigen::Index> nodes_that(bool are_open) const;
  void find_forces(const Eigen::VectorXd& closed);
  /// Opens what pulls and closes what overlaps: all of them, or only the first. @returns whether there was any
  bool put_right(bool only_first);

  Eigen::MatrixXd stiffness_, per_gap_, mass_;
  Eigen::VectorXd share_, gap_, force_;
  double force_size_ = 0;
  std::vector<bool> is_open_;
};

}  // namespace rotordrop
