#pragma once
#include <Eigen/Core>
#include <vector>

#include "rotor/geometry.h"

namespace rotordrop {

/// Free-free modes of a rotor at rest, the coordinates of all our rotor models.
///
/// Modes 0 and 1 are the analytic rigid ones (translation, tilt about the centre of gravity), then come flexible modes
/// by frequency. Every mode is scaled to the rotor's own mass m, shape^T M shape = m: so a coordinate is a length [m],
/// the translation's is the displacement of the centre of gravity and the tilt's is tilt times radius of gyration
/// sqrt(Id / m). With all 2 n_nodes modes this is an exact change of basis of the finite-element model, nothing is left
/// out.
struct ModalBasis {
  RigidBody body;
  Eigen::VectorXd omega;  ///< [n_modes] natural circular frequency [rad/s]; 0, 0 for the rigid modes
  Eigen::MatrixXd shape;  ///< [2 n_nodes x n_modes] deflections [-] and slopes [1/m], rows as in RotorMatrices
  /// [n_modes x n_modes] shape^T G shape / m [-]; symmetric; the translation's row is zero
  Eigen::MatrixXd gyroscopic;

  [[nodiscard]] Eigen::Index n_modes() const { return omega.size(); }
};

/// @param cut_off_frequency  highest flexible mode kept [Hz]; 0 keeps the rigid modes alone, infinity keeps all
/// @param attachment_nodes   nodes (from 1) whose static flexibility under transverse forces the basis keeps: what the modes beyond the cut-off
///   give there, R f = sum phi_k phi_k^T f / (m omega_k^2), one shape a node, orthogonal to the kept modes by mass and stiffness, and
///   combined among themselves into modes with their true mass (Rubin 1975; Craig & Kurdila, Fundamentals of Structural Dynamics, 17.4). Their frequencies
///   lie above the cut-off. They follow the kept modes by frequency and have mass, so displacements depend on the state alone.
/// The last few bases of the process are kept: rotors that differ in nothing that shapes their modes share them. Threads may call it at once.
[[nodiscard]] ModalBasis free_free_modes(const RotorGeometry& geometry, double cut_off_frequency,
                                         const std::vector<int>& attachment_nodes = {});

}  // namespace rotordrop
