#pragma once
// Timoshenko beam elements of a rotor and their assembly.
//
// Degrees of freedom of one bending plane: deflection and section rotation of each node, both counted so that a
// rotation is the slope of the rigidly tilted line:
//   y plane (v, theta_z),   z plane (w, -theta_y)          [theta about +y turns +x towards -z, hence the sign]
// In these the two planes share mass, stiffness and gyroscopic matrix, all symmetric:
//   M q_y'' + omega G q_z' + K q_y = f_y        f: force along y, moment about z
//   M q_z'' - omega G q_y' + K q_z = f_z        f: force along z, minus the moment about y
// The sign of G follows from the angular momentum of a spinning disk,
// Ip omega (1, theta_z, -theta_y) + Id (0, theta_y', theta_z'), whose rate is the moment:
//   Id theta_y'' + Ip omega theta_z' = M_y,     Id theta_z'' - Ip omega theta_y' = M_z
// An accelerating spin adds no term here: torques that change the spin act along the shaft's own axis, and their
// lateral part Ip omega' (theta_z, -theta_y) is just the one that the rate of the angular momentum has more.
#include <Eigen/Core>

#include "rotor/geometry.h"

namespace rotordrop {

/// Cowper's shear coefficient of a circular section.
///
///   solid   kappa = 6 (1 + nu) / (7 + 6 nu)
///   hollow  kappa = 6 (1 + nu) (1 + m^2)^2 / ((7 + 6 nu) (1 + m^2)^2 + (20 + 12 nu) m^2)
///
/// Source: G.R. Cowper (1966), The shear coefficient in Timoshenko's beam theory. Valid: static shear, any wall
/// thickness.
/// @param nu          Poisson's ratio
/// @param bore_ratio  m = id / od, in [0, 1)
[[nodiscard]] double cowper_shear_coefficient(double nu, double bore_ratio);

/// Matrices of one element and one plane in (v1, phi1, v2, phi2).
struct ElementMatrices {
  Eigen::Matrix4d mass;        ///< consistent, with rotary inertia [kg, kg m, kg m^2]
  Eigen::Matrix4d gyroscopic;  ///< per unit spin speed [same units as the mass]
  Eigen::Matrix4d stiffness;   ///< [N/m, N, N m]
};

/// Circular Timoshenko element whose shape functions are the exact static deflection of a beam with shear.
///
/// Source: H.D. Nelson (1980), A finite rotating shaft element using Timoshenko beam theory (without axial load and
/// torque).
/// @param length  [m], > 0
/// @param od, id  outer and bore diameter [m], od > id >= 0
[[nodiscard]] ElementMatrices timoshenko_element(double length, double od, double id, const RotorMaterial& material);

/// Matrices of the whole rotor and one plane [2 n_nodes x 2 n_nodes].
/// Row 2 (k - 1) is the deflection of node k, row 2 (k - 1) + 1 its slope.
struct RotorMatrices {
  Eigen::MatrixXd mass, gyroscopic, stiffness;
};

[[nodiscard]] RotorMatrices assemble(const RotorGeometry& geometry);

}  // namespace rotordrop
