#pragma once
// How the rotor touches an inner ring and how its balls press it: what the sources touchdown_*.cpp share.
#include <array>

#include "bearing/touchdown_bearing.h"
#include "laws/skidding.h"

namespace rotordrop {

/// A part of the bore's width, whose contact is looked at in its middle.
struct BoreSlice {
  double x = 0;            // from the ring's middle [m]
  double share = 1;        // of the width
  std::size_t number = 0;  // along the bore
};
/// Along the bore of a free ring: Gauss' three points, which integrate a pressure that changes linearly along it, and its moment, exactly.
inline constexpr std::size_t n_bore_slices = 3;
[[nodiscard]] std::array<BoreSlice, n_bore_slices> bore_slices(double width);
/// Of a ring that only translates: no axial force, no moments.
inline constexpr BoreSlice bore_middle;

/// The rotor past the ring at one place along the bore.
template <class Real>
struct TouchdownBearing::BodiesOf {
  Real y = 0, z = 0;                  // centres [m]
  Real vy = 0, vz = 0;                // [m/s]
  Real vx = 0;                        // [m/s]
  Real rolling_y = 0, rolling_z = 0;  // surface radius times tilt rate [m/s]
};

template <class Real>
struct TouchdownBearing::ContactOf {
  Real n_y = 0, n_z = 0;         // from ring centre to rotor centre
  Real penetration = 0;          // [m]
  Real rate = 0;                 // of the centres' distance [m/s]
  Real tangential_speed = 0;     // of the rotor's centre past the ring's [m/s]
  Real slip_speed = 0;           // rotor's surface past the bore, around it [m/s]
  Real slip_x = 0;               // along the axis [m/s]
  Real elastic = 0, normal = 0;  // [N]
  Real friction = 0;             // on the ring, along +t [N]
  Real friction_x = 0;           // on the ring, along +x [N]
  Real wave_rate = 0;            // of the bore's waves at the contact [m/s]
  Real distance = 0;             // of the centres [m]
  Real bore_slope = 0;           // of a bent bore: du_r/d(theta) over the centres' distance
  Real centres_turning = 0;      // angular speed of the line of centres [rad/s]
  Real lateral = 0;      // on the ring, along +t, of a normal force that leans as the bent bore does; no torque [N]
  Real damping = 0;      // dissipated by the normal force [W]
  Real wave_power = 0;   // of the bore's waves [W]
  Real stored_rate = 0;  // of the bristle's energy, all slip's work but heat [W]
};

template <class Real>
struct TouchdownBearing::TouchOf {
  ContactOf<Real> middle = {};                     // at the middle of the bore; the penetration is the largest along it
  ForceOf<Real> on_ring, on_rotor;                 // moments about each one's centre
  Real elastic = 0, normal = 0, friction = 0;      // of the bore [N]
  Real shoulder = 0;                               // normal force of shoulders on the ring, along +x [N]
  Real shoulder_torque = 0;                        // of their friction, on the ring [N m]
  Real rub_heat = 0, damping = 0, wave_power = 0;  // [W]
  Real centres_power = 0;                          // friction force times the slip that is not spin [W]
  MaskOf<Real> is_touching = false;

  /// Of another slice; the middle stays.
  TouchOf& operator+=(const TouchOf& other) {
    on_ring += other.on_ring;
    on_rotor += other.on_rotor;
    for (const auto number : {&TouchOf::elastic, &TouchOf::normal, &TouchOf::friction, &TouchOf::rub_heat,
                              &TouchOf::damping, &TouchOf::wave_power, &TouchOf::centres_power})
      this->*number += other.*number;
    is_touching |= other.is_touching;
    return *this;
  }
};

/// What results tell of it.
template <class Real>
struct TouchdownBearing::ObservedTouchOf {
  Real penetration;         // [m]
  Real normal, friction;    // [N]
  Real slip_speed;          // [m/s]
  Real axial, shoulder;     // on the ring [N]
  Real moment_y, moment_z;  // on the ring [N m]
};

/// Balls on the inner ring, summed over its rows.
template <class Real>
struct TouchdownBearing::BallSumsOf {
  Real force_x = 0, force_y = 0, force_z = 0;                  // [N]
  Real moment_y = 0, moment_z = 0;                             // [N m]
  Real damping_power = 0, cage_power = 0, waviness_power = 0;  // [W]
  Real elastic_radial = 0, elastic_normal = 0;                 // as in BallRowOutputOf [N]
  Real by_inner_strain = 0, by_outer_strain = 0;               // dU/d(strain) [J]
  Real by_row_difference = 0;                                  // dU/d(Expansion::row_difference) [N]
  Real inertia_power = 0;                                      // [W]
  Real inertia_per_speed = 0;                                  // [W s^2/rad]
};
template <class Real>
struct TouchdownBearing::BallForcesOf : BallSumsOf<Real> {
  BallForcesOf() {}  // leaves the rows unwritten: only those that exist are
  std::array<BallRowOutputOf<Real>, max_rows> row;
  std::array<RowTractionsOf<Real>, max_rows> tractions;  // when asked for
};

/// Bent rings while they are evaluated.
struct TouchdownBearing::ShapeForces {
  static constexpr std::size_t capacity = max_shapes;  // of one ring: harmonics up to 41
  ShapeForces() {}                                     // leaves everything unwritten: only bent rings use it
  std::array<double, capacity> shape, shape_rate;      // of the inner raceway less the outer one [m], [m/s]
  std::array<double, capacity> by_rotor,
      by_balls;  // on the inner ring [N]; the balls press the outer one by the opposite
};

}  // namespace rotordrop
