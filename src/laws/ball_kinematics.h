#pragma once
// Kinematics of cage and balls, outer ring at rest.

namespace rotordrop {

/// Cage speed over inner-ring speed, (1 - gamma)/2 with gamma = d cos phi / d_m.
double cage_speed_ratio(double ball_diameter, double pitch_diameter, double contact_angle);

/// Ball spin relative to the cage over inner-ring speed (magnitude), (d_m/d)(1 - gamma^2)/2: rolling on both races.
double ball_spin_ratio(double ball_diameter, double pitch_diameter, double contact_angle);

/// Spin of a ball against the races, about the contact normals [rad/s].
struct SpinSpeeds {
  double inner;  ///< omega_si = omega_ci sin phi_i + omega_b sin(phi_i - theta)
  double outer;  ///< omega_so = omega_co sin phi_o - omega_b sin(phi_o - theta)
};

/// Pitch angle theta of the ball's axis under outer-race control: tan theta = sin phi_o / (cos phi_o + d/d_m). Eq. (14).
double pitch_angle_outer_race_control(double phi_o, double ball_diameter, double pitch_diameter);

/// Eqs. (13), (15) of Neisi 2019 with signs and the missing cosine corrected:
///   omega_b = omega_co (d_m + d cos phi_o) / (d cos(phi_o - theta)).
/// omega_ci, omega_co: speeds of inner and outer ring relative to the cage. For phi_i = phi_o = phi
/// omega_si + omega_so = omega_i sin phi, whatever theta; under outer-race control omega_so = 0.
/// @param ring_speed omega_i [rad/s]; @param phi_i, phi_o, theta [rad]
SpinSpeeds spin_speeds(double ring_speed, double phi_i, double phi_o, double theta, double ball_diameter,
                       double pitch_diameter);

}  // namespace rotordrop
