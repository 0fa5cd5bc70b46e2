#pragma once
// Equations of the linear rotor on linear supports, in modal coordinates of both planes. Private to the room.
#include <Eigen/Core>
#include <vector>

#include "rotor/modal_analysis.h"
#include "rotor/modal_basis.h"

namespace rotordrop {

/// q'' + damping q' + stiffness q = f / m for q = (q_y, q_z), gyroscopic terms in the damping.
struct LinearSystem {
  Eigen::MatrixXd damping, stiffness;
};

LinearSystem linear_system(const ModalBasis& basis, const ModalAnalysisOptions& options, double spin_speed,
                           const std::vector<LinearSupportAtNode>& supports);

/// First-order form x' = A x in x = (W q_held, q'). Coordinates are scaled with W = their natural frequency, which
/// makes A nearly skew and its eigenvalues insensitive to roundoff. Coordinates that nothing holds are left out: their
/// zero eigenvalues are defective, and roundoff would turn them into small spurious ones.
struct FirstOrder {
  Eigen::MatrixXd A;
  std::vector<Eigen::Index> held;
};

FirstOrder first_order(const ModalBasis& basis, const LinearSystem& system);

}  // namespace rotordrop
