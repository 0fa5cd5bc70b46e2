#pragma once
// What parts of a machine hand to each other. Plain data; every number SI.
// Frame: x along the rotor axis, y up, z horizontal, right-handed; angles and spin from +y towards +z.

namespace rotordrop {

/// Motion of one station on the rotor (or of a ring). Tilts are small rotations about y and z.
struct Motion {
  double x = 0, y = 0, z = 0;                             ///< displacement [m]
  double theta_y = 0, theta_z = 0;                        ///< tilt [rad]
  double velocity_x = 0, velocity_y = 0, velocity_z = 0;  ///< [m/s]
  double tilt_rate_y = 0, tilt_rate_z = 0;                ///< [rad/s]
};

/// Rotation about +x.
struct Spin {
  double angle = 0;  ///< [rad]
  double speed = 0;  ///< [rad/s]
};

/// Force and moments on the part named where it is used.
struct Force {
  double x = 0, y = 0, z = 0;         ///< [N]
  double moment_y = 0, moment_z = 0;  ///< [N m]
  double torque = 0;                  ///< about +x [N m]
};

/// Growth of the surfaces that clearances and preload see; positive outwards (every radius grows). [m]
struct Expansion {
  double shaft = 0;       ///< rotor's contact surface
  double bore = 0;        ///< inner ring's bore
  double inner_race = 0;  ///< inner raceway
  double outer_race = 0;  ///< outer raceway
  double ball = 0;        ///< radius of a ball

  /// Sum of products; of a generalised force [N] with a growth rate [m/s] it is a power [W].
  [[nodiscard]] double dot(const Expansion& other) const {
    return shaft * other.shaft + bore * other.bore + inner_race * other.inner_race + outer_race * other.outer_race +
           ball * other.ball;
  }
};
/// f a + g b
inline Expansion combined(double f, const Expansion& a, double g, const Expansion& b) {
  return {f * a.shaft + g * b.shaft, f * a.bore + g * b.bore, f * a.inner_race + g * b.inner_race,
          f * a.outer_race + g * b.outer_race, f * a.ball + g * b.ball};
}

/// Heat that a bearing releases, by port, and what a law for sharing it needs to know.
struct HeatInput {
  double rub = 0;  ///< H_r: rotor surface against bore [W] (eq. 19)
  double rub_into_ring =
      0;             ///< part of H_r that enters the ring, the rest enters the rotor [W]; the machine divides it
  double inner = 0;  ///< H_i: balls against inner race [W] (eq. 24, energy-consistent form)
  double outer = 0;  ///< H_o: balls against outer race [W]
  double rotor_surface_speed = 0;  ///< speed of the rotor's surface relative to the rubbing spot [m/s]
  double ring_surface_speed = 0;   ///< speed of the bore's surface relative to the rubbing spot [m/s]
  bool is_in_contact = false;      ///< rotor and bore touch
};

}  // namespace rotordrop
