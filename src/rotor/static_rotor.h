#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>
#include <vector>

#include "rotor/geometry.h"

namespace rotordrop {

/// A constant force on a node.
struct RotorLoad {
  int node = 0;                   ///< numbered from 1
  std::array<double, 2> force{};  ///< along y, z [N]
};

/// Rotor at rest, condensed to the deflections of its stations and the slopes at those that moments act on: exact for the beam model, since between
/// stations only the given loads act. Both bending planes share the stiffness; slopes are counted as in timoshenko.h.
class StaticRotor {
 public:
  /// @param stations  nodes that supports hold, numbered from 1, at least two different ones
  /// @param tilted    those of them on which moments act
  /// @param gravity   acceleration along y, z [m/s^2]
  /// @throws std::invalid_argument for fewer than two stations: such a rotor has no equilibrium
  StaticRotor(const RotorGeometry& geometry, const std::vector<int>& stations, const std::array<double, 2>& gravity,
              const std::vector<RotorLoad>& loads, const std::vector<int>& tilted = {});

  /// Of one plane: deflections of the stations, then slopes at the tilted ones.
  [[nodiscard]] std::size_t n_held() const { return held_rows_.size(); }
  /// [n_held x n_held] [N/m, N, N m]; without resistance against the two motions of a rigid line.
  [[nodiscard]] const Eigen::MatrixXd& stiffness() const { return stiffness_; }
  /// What weight and loads put on them [n_held] [N, N m], plane 0 for y, 1 for z.
  [[nodiscard]] const Eigen::VectorXd& load(std::size_t plane) const { return load_[plane]; }
  /// Deflections of all nodes [n_nodes] [m] from what is held.
  [[nodiscard]] std::vector<double> deflections(std::size_t plane, const Eigen::VectorXd& held) const;

 private:
  std::vector<Eigen::Index> held_rows_, free_rows_;
  Eigen::LDLT<Eigen::MatrixXd> free_;  // stiffness of all other degrees of freedom
  Eigen::MatrixXd coupling_;           // [free x held]
  Eigen::MatrixXd stiffness_;
  std::array<Eigen::VectorXd, 2> load_, free_load_;
  std::size_t n_nodes_ = 0;
};

}  // namespace rotordrop
