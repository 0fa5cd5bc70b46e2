#pragma once
// Where one ball sits between two grooves, and what it does to the inner one.
//
// In the plane of the ball (x along the axis, r away from it) the centre of the outer groove is the origin, that of the inner groove lies
// at B = (B_x, B_r), the ball's centre at P:
//   L_o = |P|,      n_o = P / L_o        = (sin, cos) of the outer contact angle,   delta_o = L_o - l_o + eps_o,   Q_o = K_o delta_o^1.5 >= 0
//   L_i = |B - P|,  n_i = (B - P) / L_i  = (sin, cos) of the inner contact angle,   delta_i = L_i - l_i + eps_i,   Q_i = K_i delta_i^1.5 >= 0
// with l = groove radius - d/2. The ball is in balance if
//   Q_i n_i - Q_o n_o + F_c e_r + T_o + T_i = 0.
//
// Outer-race control (the ball does not spin on the outer race), inner ring turning with omega, outer ring at rest, g = d/d_m:
//   omega_m = omega (1 - g |cos phi_i|) / (1 + |cos(phi_i - phi_o)|)  of the ball round the axis
//   F_c     = m d_m omega_m^2 / 2
//   M_g     = J omega_m^2 sin phi_o / g,  J = m d^2 / 10              needed along the tangent to keep the ball's spin axis turning
//   T       = 2 M_g / d = 0.4 F_c sin phi_o                           friction on the ball, at both races together
// of which a share sigma acts at the inner race and the rest at the outer one, each with the arm d/2 and both turning the ball the same way:
//   T_o     = (1 - sigma) T along (-cos phi_o, sin phi_o),   T_i = sigma T along (cos phi_i, -sin phi_i).
// sigma = 0 goes with outer-race control (Jones); sigma = 1/2 is Harris' other case, lambda_i = lambda_o = 1. Statics leaves sigma open:
// friction is below its limit at both contacts. The kinematics stays that of outer-race control.
// The cosines' sizes: both are positive but for a ball past the inner groove's centre, where that race cannot drive it and the ball keeps its speed.
// From Jones (1960) and Harris, Rolling Bearing Analysis, with the pitch angle tan beta = sin phi_o / (cos phi_o + g) put in: then the ball's speed is
// omega_m sqrt(1 + 2 g cos phi_o + g^2) / g, and the root cancels. Direction of T: the rate of the angular momentum of a ball that rolls on the
// outer race without spin, H = -J omega_m / g (cos phi_o, -sin phi_o), carried round by omega_m.

namespace rotordrop {

/// F_c = m d_m omega_m^2 / 2 [N] of a ball that goes round the axis.
/// @param mass m [kg]; @param pitch_diameter d_m [m]; @param orbit_speed omega_m [rad/s]
template <class Real>
[[nodiscard]] Real centrifugal_force(const Real& mass, const Real& pitch_diameter, const Real& orbit_speed) {
  return 0.5 * mass * pitch_diameter * orbit_speed * orbit_speed;
}

/// Contacts and inertia of one ball.
struct BallContacts {
  double K_i = 0, K_o = 0;            ///< load-deflection constants [N/m^1.5]
  double l_i = 0, l_o = 0;            ///< groove radius less ball radius [m]
  double mass = 0;                    ///< m [kg]
  double diameter_ratio = 0;          ///< g = d / d_m
  double pitch_diameter = 0;          ///< d_m [m]
  double inner_gyroscopic_share = 0;  ///< sigma, part of the gyroscopic traction at the inner race
};

/// A ball in balance.
struct BallBalance {
  double load_i = 0, load_o = 0;                      ///< Q [N]
  double sin_i = 0, cos_i = 1, sin_o = 0, cos_o = 1;  ///< of the contact angles, signed
  double orbit_speed = 0;                             ///< omega_m [rad/s]
  double centrifugal_force = 0;                       ///< F_c [N]
  double gyroscopic_moment = 0;                       ///< M_g [N m], signed as sin phi_o
  double inner_traction = 0;                          ///< T_i on the ball along (cos, -sin) of the inner angle [N]
  double energy = 0;                                  ///< of both contacts [J]
  /// Force of the inner race on the ball [N]; the ring takes the opposite.
  [[nodiscard]] double pull_x() const { return load_i * sin_i + inner_traction * cos_i; }
  [[nodiscard]] double pull_r() const { return load_i * cos_i - inner_traction * sin_i; }
  /// Derivative of the pull by B [N/m]: xx, xr, rx, rr.
  double stiffness[4] = {0, 0, 0, 0};
  double residual = 0;  ///< left-over force [N]
  int iterations = 0;
};

/// @param B_x, B_r  centre of the inner groove from that of the outer one [m]
/// @param growth    of the ball's radius [m]; adds to both deflections
/// @param speed     omega of the inner ring [rad/s]; 0: balls without inertia, in closed form
/// @param share     part of the inertia forces that acts, 1 for all
BallBalance ball_balance(const BallContacts& ball, double B_x, double B_r, double growth, double speed,
                         double share = 1.);

}  // namespace rotordrop
