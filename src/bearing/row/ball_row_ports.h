#pragma once
// What goes into a row of balls and what comes out of it.
#include <span>

namespace rotordrop {

inline constexpr int most_balls = 256;  ///< of a row

/// Displacement (or its rate) of the inner ring relative to the outer one. Tilts about y and z.
template <class Real>
struct RingDisplacementOf {
  Real x = 0, y = 0, z = 0;   ///< [m] ([m/s])
  Real psi_y = 0, psi_z = 0;  ///< [rad] ([rad/s])
};
using RingDisplacement = RingDisplacementOf<double>;

/// Instantaneous input of a row.
template <class Real>
struct BallRowInputOf {
  RingDisplacementOf<Real> displacement;
  RingDisplacementOf<Real> rate;
  Real cage_angle = 0, cage_cosine = 1, cage_sine = 0;  ///< theta_c [rad], its cosine and sine
  Real cage_speed = 0;                                  ///< [rad/s], for the work of the prescribed cage
  Real ring_angle = 0;                                  ///< theta_i [rad]
  Real ring_speed = 0;                                  ///< omega_i [rad/s]
  Real radial_growth = 0;   ///< eps_in - eps_out, radial displacements of the contact points [m]
  Real row_difference = 0;  ///< of it, last row less first [m]
  Real ball_growth = 0;     ///< eps_b, growth of a ball's radius [m]
  Real inner_strain = 0;    ///< axial strain of the inner ring
  Real outer_strain = 0;    ///< of the outer ring
  /// Bent rings: coefficients a_2, b_2, a_3, b_3, ... of u_r of the inner raceway less the outer one [m], and their rates [m/s]; empty: rigid rings.
  std::span<const Real> shape, shape_rate;
  std::span<Real> shape_force;  ///< the balls' forces on the inner ring's shapes are added here [N]
};
using BallRowInput = BallRowInputOf<double>;

/// What a row does to the inner ring, and the sums that energy and heat need. Evaluation writes every member.
template <class Real>
struct BallRowOutputOf {
  Real force_x, force_y, force_z;  ///< on the inner ring [N]
  Real moment_y, moment_z;         ///< on the inner ring [N m]
  Real damping_power;              ///< dissipated in the contacts [W]
  Real elastic_radial;             ///< sum of K delta^1.5 cos phi: dU/d(eps_in - eps_out) [N]
  Real elastic_axial;              ///< sum of K delta^1.5 sin phi: dU/d(B_x) [N]
  Real elastic_normal;             ///< sum of K delta^1.5: half of dU/d(eps_b) [N]
  Real
      elastic_outer_surplus;  ///< by how much that of the outer contacts exceeds it; the inner ones fall short by as much [N]
  Real cage_torque;  ///< dU/d(cage angle) with the waves kept: times the cage's speed the work rate of its motion [N m]
  Real waviness_power;      ///< work rate of the prescribed travel of the waves [W]
  Real largest_load;        ///< of the row's balls on the inner race [N]
  Real largest_outer_load;  ///< on the outer race [N]; the same without inertia
  /// Sums of the loads and of their cube roots on either race, without damping [N], [N^(1/3)]: what conducts heat. Loads of balls without inertia are
  /// the same on both.
  Real inner_load_roots, outer_load_roots, inner_loads, outer_loads;
  Real inertia_power;      ///< work rate of the balls' forces of inertia on the balls, at constant speed [W]
  Real inertia_per_speed;  ///< and more per acceleration of the ring [W s^2/rad]
};
using BallRowOutput = BallRowOutputOf<double>;

}  // namespace rotordrop
