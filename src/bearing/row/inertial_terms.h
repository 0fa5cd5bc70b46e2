#pragma once
// One ball with inertia between its races: the balance of laws/ball_balance.h as a step of Newton's method, and the parts of a row's sums.
//
// Unknowns of a ball are its place, in polar coordinates about the outer groove's centre: the deflection of the outer contact and the outer
// normal. The inner contact follows, and two equations say that the forces on the ball cancel; a ball that the inner race does not reach is one
// without an inner load.
#include "base/real.h"
#include "bearing/row/inertial_balls.h"

namespace rotordrop {

/// What a row's balls have in common at one instant.
template <class Real>
struct BalancedRowOf {
  InertialRowOf<Real> constants;
  Real F_0;  // m d_m omega^2 / 2 [N]
};

/// The ball's centre.
template <class Real>
struct BallPlace {
  Real delta_o;  // deflection of the outer contact [m]
  Real x, r;     // outer normal
};
/// Groove centres' distance, and what adds to the deflection of each contact.
template <class Real>
struct BallSurroundings {
  Real B_x, B_r, added_i, added_o;
};

/// A unit vector.
template <class Real>
struct NormalOf {
  Real x, r;
};
/// Turns a unit vector by about an angle; its length stays one to the digits when the angle is small, and comes back to one later when it is not.
template <class Real>
[[gnu::always_inline]] inline NormalOf<Real> turned(const Real& angle, const Real& x, const Real& r) {
  const Real a2 = angle * angle, shrink = 1. - a2 * (0.5 - 0.375 * a2);
  const Real new_x = (x + angle * r) * shrink, new_r = (r - angle * x) * shrink;
  const Real fix = 1.5 - 0.5 * (new_x * new_x + new_r * new_r);
  return {new_x * fix, new_r * fix};
}

template <class Real>
[[gnu::always_inline]] inline BallPlace<Real> select_place(const MaskOf<Real>& condition, const BallPlace<Real>& a,
                                                           const BallPlace<Real>& b) {
  return {select(condition, a.delta_o, b.delta_o), select(condition, a.x, b.x), select(condition, a.r, b.r)};
}

template <class Real>
[[gnu::always_inline]] inline Real limited(const Real& value, double low, double high) {
  return smaller(larger(value, Real(low)), Real(high));
}

/// What acts on a ball along (n) and across (t) the outer normal, and how that changes as the outer normal turns (a) and the outer length
/// grows (x).
/// @tparam is_split  part of the gyroscopic traction acts at the inner race
template <bool is_split, class Real>
struct BallForces {
  static constexpr bool is_in_plane = false;
  Real L_o, delta_i, Q_i, Q_o, S_i, S_o, i_x, i_r, c, s, by_L_i;
  Real F, f_i, f_o, f_a, f_x;  // and its relative change with the inner and the outer angle, and with turn and length
  Real h_n, h_t, force_n, force_t;
  Real angle_a, angle_x;  // of the inner contact
  Real R_n_a, R_t_a, R_n_x, R_t_x, inverse_det;

  [[gnu::always_inline]] inline BallForces(const BalancedRowOf<Real>& of, const BallPlace<Real>& p,
                                           const BallSurroundings<Real>& at) {
    const InertialRowOf<Real>& row = of.constants;
    L_o = row.l_o + p.delta_o - at.added_o;
    const Real v_x = at.B_x - L_o * p.x, v_r = at.B_r - L_o * p.r, v_n = v_x * p.x + v_r * p.r,
               v_t = v_x * p.r - v_r * p.x;
    const auto [L_i, inverse] = root_and_inverse(v_x * v_x + v_r * v_r + 1e-18);
    by_L_i = inverse;
    delta_i = L_i - row.l_i + at.added_i;
    i_x = v_x * by_L_i;
    i_r = v_r * by_L_i;
    c = v_n * by_L_i;
    s = v_t * by_L_i;
    // Both of the ratio are L_i times as large, and need not wait for the normal.
    const Real above = L_i - row.g * abs(v_r), by_below = 1. / (L_i + abs(v_n)), ratio = above * by_below;
    F = of.F_0 * ratio * ratio;
    f_o = -2. * select(v_n < 0., -v_t, v_t) * by_below;
    f_i = 2. * row.g * select(v_r < 0., -v_x, v_x) / above - f_o;

    const Real reached = larger(delta_i, Real(0.)), root_i = sqrt(reached), root_o = sqrt(p.delta_o);
    S_i = 1.5 * row.K_i * root_i;
    S_o = 1.5 * row.K_o * root_o;
    Q_i = row.K_i * root_i * reached;
    Q_o = row.K_o * root_o * p.delta_o;
    h_n = p.r;
    h_t = -1.4 * p.x;
    [[maybe_unused]] const Real k = 0.4 * row.inner_gyroscopic_share;
    if constexpr (is_split) {
      h_n -= k * p.x * s;
      h_t += k * p.x * (1. + c);
    }
    force_n = Q_i * c - Q_o + F * h_n;
    force_t = Q_i * s + F * h_t;

    // The inner contact's stiffness is S_i along its normal and Q_i / L_i across it.
    const Real across = Q_i * by_L_i, more_c = (S_i - across) * c;
    const Real K_nn = across + more_c * c, K_nt = more_c * s, K_tt = S_i + across - K_nn;
    angle_a = -L_o * c * by_L_i;
    angle_x = s * by_L_i;
    f_a = f_i * angle_a + f_o;
    f_x = f_i * angle_x;
    // The force of inertia, F (-0.4 o_x o_r, 1 + 0.4 o_x^2), turns with the outer angle: 0.4 F (o_x n - o_r t).
    R_n_a = F * (f_a * h_n + 0.4 * p.x) - L_o * K_nt;
    R_t_a = F * (f_a * h_t - 0.4 * p.r) - (L_o * K_tt + Q_o);
    R_n_x = F * (f_x * h_n) - (K_nn + S_o);
    R_t_x = F * (f_x * h_t) - K_nt;
    if constexpr (is_split) {
      // From F (-0.4 x t) at the outer race to F (-(0.4 - k) x t + k x t_i), t_i = (i_r, -i_x) across the inner normal.
      const Real T = F * k * p.x;
      R_n_a += F * k * (-p.x - p.r * s) - T * angle_a * c;
      R_t_a += F * k * (p.r + p.r * c) - T * angle_a * s;
      R_n_x -= T * angle_x * c;
      R_t_x -= T * angle_x * s;
    }
    inverse_det = 1. / (R_n_a * R_t_x - R_t_a * R_n_x);
  }
  /// Turn and growth of the outer length that cancel the forces.
  [[nodiscard, gnu::always_inline]] inline Real turn() const {
    return (force_t * R_n_x - force_n * R_t_x) * inverse_det;
  }
  [[nodiscard, gnu::always_inline]] inline Real growth() const {
    return (force_n * R_t_a - force_t * R_n_a) * inverse_det;
  }
  /// Deflection of the inner contact after them.
  [[nodiscard, gnu::always_inline]] inline Real next_delta_i(const Real& turn, const Real& growth) const {
    return delta_i - L_o * s * turn - c * growth;
  }
  /// The ball's place after them, or part of the way.
  [[nodiscard, gnu::always_inline]] inline BallPlace<Real> next(const BallPlace<Real>& p) const {
    const auto normal = turned(limited(turn(), -0.5, 0.5), p.x, p.r);
    return {larger(p.delta_o + growth(), 0.1 * p.delta_o), normal.x, normal.r};
  }
  /// Whether more than `enough` of the loads is left, or no number any more; or the ball got past the inner groove's centre, where
  /// forces balance, too, under loads of no meaning.
  [[nodiscard, gnu::always_inline]] inline MaskOf<Real> is_left(const Real& enough) const {
    const Real left = abs(force_n) + abs(force_t);
    const MaskOf<Real> is_enough = left <= enough * (Q_o + F), is_past = c * Q_i < 0.;
    return is_past | (!is_enough);
  }
};

/// A ball in its balance.
template <class Real>
struct BalancedBall {
  Real u;                   ///< cubic root of the inner load, 0 for a ball that the inner race does not reach [N^(1/3)]
  Real x, r;                ///< inner normal
  Real Q_o, delta_o;        ///< outer load [N] and deflection [m]
  Real T;                   ///< gyroscopic traction of the inner race on the ball along (i_r, -i_x) [N]
  Real radial, axial;       ///< work of the forces of inertia per growth of B_r and B_x [N]
  Real by_inner, by_outer;  ///< and per growth of what adds to the inner and the outer deflection [N]
  Real per_force;           ///< and per relative change of F_0 [J]
};

/// A ball in its balance, from its place near by: the last step of Newton's method, which squares what was left, and whose matrix gives the work of
/// the forces of inertia.
/// @param is_ball  0 for balls that fill up the row, else 1
template <bool is_split, class Real>
[[gnu::always_inline]] inline BalancedBall<Real> balanced_ball(const BallForces<is_split, Real>& b,
                                                               const BalancedRowOf<Real>& row, const BallPlace<Real>& p,
                                                               const Real& is_ball) {
  BalancedBall<Real> ball;
  const Real a = b.turn(), grown = b.growth();
  ball.u = is_ball * row.constants.root_K_i * sqrt(larger(b.next_delta_i(a, grown), Real(0.)));
  ball.Q_o = is_ball * (b.Q_o + b.S_o * grown);
  ball.delta_o = p.delta_o + grown;
  const auto i = turned(b.angle_a * a + b.angle_x * grown, b.i_x, b.i_r);
  ball.x = i.x;
  ball.r = i.r;

  // The forces of inertia and the gyroscopic tractions work on the ball's motion, the inner one on what the ring moves past it. What a force along
  // n or t would make of it, by the transposed matrix; then what moves the groove along and across the inner normal makes such forces.
  const Real F = is_ball * b.F, f_n = F * b.h_n, f_t = F * b.h_t;
  const Real by_n = (f_n * b.R_t_a - f_t * b.L_o * b.R_t_x) * b.inverse_det;
  const Real by_t = (f_t * b.L_o * b.R_n_x - f_n * b.R_n_a) * b.inverse_det;
  Real push_n = b.F * b.f_i * b.h_n - b.Q_i * b.s, push_t = b.F * b.f_i * b.h_t + b.Q_i * b.c, T_past = 0.;
  ball.T = 0.;
  if constexpr (is_split) {
    const Real k = 0.4 * row.constants.inner_gyroscopic_share, T_i = b.F * k * p.x;
    push_n -= T_i * b.c;
    push_t -= T_i * b.s;
    ball.T = is_ball * (T_i + k * b.F * ((b.f_a * a + b.f_x * grown) * p.x + a * p.r));
    T_past = is_ball * T_i;
  }
  ball.by_inner = b.S_i * (b.c * by_n + b.s * by_t);
  const Real gap_t = b.by_L_i * (push_n * by_n + push_t * by_t) - T_past;
  ball.radial = ball.by_inner * b.i_r - gap_t * b.i_x;
  ball.axial = ball.by_inner * b.i_x + gap_t * b.i_r;
  ball.by_outer = ball.by_inner * b.c - (gap_t + T_past) * b.s - f_n;
  ball.per_force = f_n * by_n + f_t * by_t;
  return ball;
}

/// Between the ball without inertia and the ball in the bottom of the outer groove: the moment of its forces about the outer groove's centre
/// shares B_x out to the two normals, what remains of B_r is compression.
template <class Real>
[[gnu::always_inline]] inline BallPlace<Real> guessed_place(const BalancedRowOf<Real>& of,
                                                            const BallSurroundings<Real>& at) {
  const InertialRowOf<Real>& row = of.constants;
  const Real &c_i = row.c_i, &c_o = row.c_o, bottom = 0.5 * c_o * cbrt(0.0625 * of.F_0 * of.F_0);
  const Real distance = sqrt(at.B_x * at.B_x + at.B_r * at.B_r), added = at.added_i + at.added_o;
  const Real delta = larger(distance - row.l_i - row.l_o + added, Real(0.)), soft = c_i + c_o;
  const Real Q = delta * sqrt(delta) / (soft * sqrt(soft));
  const Real ratio = 0.5 * (1. - row.g * at.B_r / distance);
  const Real F = of.F_0 * ratio * ratio;
  const Real Q_guess = Q + 0.7 * F;
  const Real share = Q_guess / (2. * Q_guess + 1.4 * F);
  const Real o_x = limited(at.B_x * share / row.l_o, -0.95, 0.95);
  const Real i_x = limited(at.B_x * (1. - share) / row.l_i, -0.95, 0.95);
  const Real o_r = sqrt(1. - o_x * o_x), i_r = sqrt(1. - i_x * i_x);
  const Real both = (at.B_r - row.l_o * o_r - row.l_i * i_r) * 2. / (o_r + i_r) + added;
  return {larger(both * c_o / soft, bottom), o_x, o_r};
}

}  // namespace rotordrop
