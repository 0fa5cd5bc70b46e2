#pragma once
// One ball with inertia between grooves whose centres stay in one plane, contact angle zero: what remains of inertial_terms.h where no force acts
// along the axis. A ball whose contacts are in line rolls round at (1 - g) / 2 of the ring's speed wherever it is, asks for no gyroscopic traction,
// and its one unknown is the deflection of the outer contact.
#include "bearing/row/inertial_terms.h"

namespace rotordrop {

/// What acts on a ball along the outer normal, which is the radial direction, and how that changes with the outer deflection.
template <class Real>
struct BallForcesInPlane {
  static constexpr bool is_in_plane = true;
  Real delta_i, Q_i, Q_o, S_i, S_o;
  Real i_r;    // inner normal: -1 if the ball is past the inner groove's centre
  Real F;      // of inertia [N]
  Real force;  // all [N]
  Real per_stiffness;

  [[gnu::always_inline]] inline BallForcesInPlane(const BalancedRowOf<Real>& of, const BallPlace<Real>& p,
                                                  const BallSurroundings<Real>& at) {
    const InertialRowOf<Real>& row = of.constants;
    const Real v_r = at.B_r - (row.l_o + p.delta_o - at.added_o);
    i_r = select(v_r < 0., Real(-1.), Real(1.));
    delta_i = abs(v_r) - row.l_i + at.added_i;
    const Real reached = larger(delta_i, Real(0.)), root_i = sqrt(reached), root_o = sqrt(p.delta_o);
    S_i = 1.5 * row.K_i * root_i;
    S_o = 1.5 * row.K_o * root_o;
    Q_i = row.K_i * root_i * reached;
    Q_o = row.K_o * root_o * p.delta_o;
    const Real ratio = 0.5 * (1. - row.g);
    F = of.F_0 * ratio * ratio;
    force = Q_i * i_r - Q_o + F;
    per_stiffness = 1. / (S_i + S_o);
  }
  /// Growth of the outer deflection that cancels the force.
  [[nodiscard, gnu::always_inline]] inline Real growth() const { return force * per_stiffness; }
  /// As BallForces.
  [[nodiscard, gnu::always_inline]] inline BallPlace<Real> next(const BallPlace<Real>& p) const {
    return {larger(p.delta_o + growth(), 0.1 * p.delta_o), 0., 1.};
  }
  [[nodiscard, gnu::always_inline]] inline MaskOf<Real> is_left(const Real& enough) const {
    const MaskOf<Real> is_enough = abs(force) <= enough * (Q_o + F), is_past = i_r * Q_i < 0.;
    return is_past | (!is_enough);
  }
};

template <class Real>
[[gnu::always_inline]] inline BalancedBall<Real> balanced_ball(const BallForcesInPlane<Real>& b,
                                                               const BalancedRowOf<Real>& row, const BallPlace<Real>& p,
                                                               const Real& is_ball) {
  BalancedBall<Real> ball;
  const Real grown = b.growth(), F = is_ball * b.F;
  ball.u = is_ball * row.constants.root_K_i * sqrt(larger(b.delta_i - b.i_r * grown, Real(0.)));
  ball.Q_o = is_ball * (b.Q_o + b.S_o * grown);
  ball.delta_o = p.delta_o + grown;
  ball.x = ball.T = ball.axial = 0.;
  ball.r = b.i_r;
  // By how much the force of inertia moves the ball, and what that takes from the inner contact.
  const Real moved = F * b.per_stiffness;
  ball.radial = b.S_i * moved;
  ball.by_inner = ball.radial * b.i_r;
  ball.by_outer = ball.radial - F;
  ball.per_force = F * moved;
  return ball;
}

}  // namespace rotordrop
