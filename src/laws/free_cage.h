#pragma once
// A cage that turns with its balls at a speed of its own, driven by the races' traction on balls that slip.
//
// As in skidding.h, of all balls together: balls' centres on the pitch radius r_m, carried round with omega_c, W the part of their spin about the axis of
// rolling, the same for all. The inner race's surface moves with v = (1 - gamma) r_m omega_i, the outer ring stands. With slips of the races over the balls
//   u_i = v - r_m omega_c - W d/2,   u_o = W d/2 - r_m omega_c
// and tractions T = mu_t sum(Q) tanh(u / u_0) of each race on the balls, along their way,
//   (Z m r_m^2 + I_c) omega_c' = r_m (T_i + T_o) + M_Q        orbit; M_Q: normal forces of the races, which roll squeezed balls to one side
//   Z J_b W' = (T_i - T_o) d/2 - M_p                          spin, J_b = m d^2/10; M_p: friction in the pockets
//   torque on the inner ring: -(1 - gamma) r_m T_i
// The power balance closes: the ring's loss is what balls and cage gain plus T_i u_i + T_o u_o + M_p W. Without slip it is rolling: omega_c = v / (2 r_m).
//
// Pockets: the loaded balls' traction reaches the others through the cage. With z = sum(Q) / (Z Q_max), the loaded part of the balls (1: all alike), the pockets
// carry (1 - z) |T_i| twice, once from a ball and once to one, and rub at the balls' equators: M_p = 2 mu_p (1 - z) |T_i| d/2 tanh(W d/2 / u_0).
//
// Source: traction by sliding, Gupta, Advanced Dynamics of Rolling Elements (1984), ch. 3 and 7, here of all balls together, which share one spin and
// one speed. Left out: balls' differences from each other, cage whirl, lubricant churned by balls (the bearing's speed-dependent torque acts on the ring).
#include <algorithm>
#include <cmath>

namespace rotordrop {

/// Balls and cage of a bearing, with one orbital speed and one spin of the balls.
struct FreeCage {
  double n_balls = 0;          ///< Z, of all rows
  double ball_mass = 0;        ///< m [kg]
  double ball_diameter = 0;    ///< d [m]
  double pitch_radius = 0;     ///< r_m [m]
  double gamma = 0;            ///< d cos phi / d_m
  double inertia = 0;          ///< I_c, of the cages about the axis [kg m^2]
  double traction = 0;         ///< mu_t, largest traction over load
  double slip = 1;             ///< u_0 [m/s], > 0
  double pocket_friction = 0;  ///< mu_p

  /// Of balls and cage about the bearing's axis, and of the balls about the axis of rolling [kg m^2].
  [[nodiscard]] double orbit_inertia() const { return n_balls * ball_mass * pitch_radius * pitch_radius + inertia; }
  [[nodiscard]] double spin_inertia() const { return n_balls * 0.1 * ball_mass * ball_diameter * ball_diameter; }
  /// What balls and cage add to the inner ring's spin inertia while they roll [kg m^2].
  [[nodiscard]] double rolling_inertia() const {
    const double orbit = 0.5 * (1. - gamma), spin = 2. * pitch_radius * orbit / ball_diameter;
    return orbit_inertia() * orbit * orbit + spin_inertia() * spin * spin;
  }
  /// Kinetic energy [J] at omega_c and W [rad/s].
  [[nodiscard]] double energy(double cage_speed, double ball_spin) const {
    return 0.5 * (orbit_inertia() * cage_speed * cage_speed + spin_inertia() * ball_spin * ball_spin);
  }
};

/// What moves balls and cage.
struct CageDrive {
  double ring_speed = 0, cage_speed = 0;  ///< omega_i, omega_c [rad/s]
  double ball_spin = 0;                   ///< W [rad/s]
  double loads = 0;                       ///< sum of the balls' loads, without centrifugal forces [N]
  double largest_load = 0;                ///< Q_max [N]
  double contact_torque = 0;              ///< M_Q [N m]
};

/// What they then do.
struct CageMotion {
  double cage_acceleration = 0, ball_acceleration = 0;     ///< omega_c', W' [rad/s^2]
  double ring_torque = 0;                                  ///< on the inner ring [N m]
  double inner_slip = 0, outer_slip = 0;                   ///< u_i, u_o [m/s]
  double inner_heat = 0, outer_heat = 0, pocket_heat = 0;  ///< [W]
};

inline CageMotion cage_motion(const FreeCage& c, const CageDrive& in) {
  const double r = c.pitch_radius, half = 0.5 * c.ball_diameter;
  CageMotion out;
  out.inner_slip = (1. - c.gamma) * r * in.ring_speed - r * in.cage_speed - half * in.ball_spin;
  out.outer_slip = half * in.ball_spin - r * in.cage_speed;
  const double centrifugal = c.n_balls * c.ball_mass * r * in.cage_speed * in.cage_speed;
  const double T_i = c.traction * in.loads * std::tanh(out.inner_slip / c.slip);
  const double T_o = c.traction * (in.loads + centrifugal) * std::tanh(out.outer_slip / c.slip);
  const double loaded = in.largest_load > 0. ? std::min(in.loads / (c.n_balls * in.largest_load), 1.) : 1.;
  const double M_p =
      2. * c.pocket_friction * (1. - loaded) * std::fabs(T_i) * half * std::tanh(half * in.ball_spin / c.slip);
  out.cage_acceleration = (r * (T_i + T_o) + in.contact_torque) / c.orbit_inertia();
  out.ball_acceleration = ((T_i - T_o) * half - M_p) / c.spin_inertia();
  out.ring_torque = -(1. - c.gamma) * r * T_i;
  out.inner_heat = T_i * out.inner_slip;
  out.outer_heat = T_o * out.outer_slip;
  out.pocket_heat = M_p * in.ball_spin;
  return out;
}

}  // namespace rotordrop
