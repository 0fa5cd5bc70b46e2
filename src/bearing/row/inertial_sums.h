#pragma once
// What the balls of a row with inertia do together, once each is in its balance: for balls of a row in vectors, and for a ball of eight drops in lanes.
#include <type_traits>

#include "bearing/row/ball_terms.h"
#include "bearing/row/inertial_newton.h"

namespace rotordrop {

/// What acts on a ball. @tparam is_split  part of the gyroscopic traction acts at the inner race; in plane there is none
template <GrooveMotion motion, bool is_split, class Real>
using BallForcesOf =
    std::conditional_t<motion == GrooveMotion::in_plane, BallForcesInPlane<Real>, BallForces<is_split, Real>>;

/// A ball among those of its row.
template <class Real>
struct BallInRow {
  Real cosine, sine;  // of its azimuth, in the cage's frame
  BallWidening<Real> bent;
  BallWavesOf<Real> waves;
};

/// Sums over the balls of a row, in the cage's frame.
template <class Real>
struct InertialSums {
  Real fx = 0, fy = 0, fz = 0;            // on the inner ring [N]
  Real dissipated = 0;                    // in the contacts [W]
  Real radial = 0, axial = 0;             // work per growth of B_r, B_x [N]
  Real inner = 0, outer = 0;              // loads of either race [N]
  Real cage = 0;                          // torque over the cage's turning [N m]
  Real power = 0;                         // of inertia [W]
  Real by_inner = 0, by_outer = 0;        // inertia's work per growth of a contact's deflection [N]
  Real per_force = 0;                     // work per relative change of F_0 [J]
  Real waviness = 0;                      // by the waves' travel [W]
  Real my = 0, mz = 0;                    // on the inner ring [N m]
  Real inner_roots = 0, outer_roots = 0;  // of loads [N^(1/3)]
  Real largest = 0, largest_outer = 0;    // load of a ball [N]
};

/// A row of balls with inertia at an instant.
/// @tparam is_bent  of bent rings
template <GrooveMotion motion, bool is_bent, class Real>
struct RowAtInstant {
  static constexpr bool tilts = motion == GrooveMotion::all, is_in_plane = motion == GrooveMotion::in_plane;
  const RowPlaceOf<Real>& place;
  AtRow<Real> at;
  Real added_i, added_o;  // to the contacts' deflections [m]
  Real cage_speed;
  // 1.5 beta K^(2/3) of both contacts in series: K delta^0.5 of the ball without inertia that has the same load is K^(2/3) u.
  Real damping;
  Real root_K_o;
  bool is_wavy, sums_roots;

  /// @param in_place  kept; its damping is 1.5 beta
  [[gnu::always_inline]] inline RowAtInstant(const RowPlaceOf<Real>& in_place, const InertialRowOf<Real>& row,
                                             const Real& to_inner, const Real& to_outer, const Real& speed_of_cage,
                                             bool has_waves, bool with_roots)
      : place(in_place),
        at(at_row<tilts>(in_place)),
        added_i(to_inner),
        added_o(to_outer),
        cage_speed(speed_of_cage),
        damping(in_place.damping * row.hardness),
        root_K_o(row.root_K_o),
        is_wavy(has_waves),
        sums_roots(with_roots) {}

  [[nodiscard, gnu::always_inline]] inline BallSurroundings<Real> surroundings(const BallInRow<Real>& ball) const {
    const Real &c = ball.cosine, &s = ball.sine;
    BallSurroundings<Real> around{is_in_plane ? Real(0.) : place.axial, place.radial + at.e_y * c + at.e_z * s, added_i,
                                  added_o};
    if constexpr (tilts) around.B_x += axial_at_ball(place.arm, place.e, c, s);
    if constexpr (is_bent) around.B_r += ball.bent.width;
    if (is_wavy) {
      around.added_i += ball.waves.inner;
      around.added_o += ball.waves.outer;
    }
    return around;
  }

  /// @tparam is_split  part of the gyroscopic traction acts at the inner race
  /// @return the ball's radial force on the inner ring
  template <bool is_split>
  [[gnu::always_inline]] inline Real add_forces(const BallInRow<Real>& in_row, const BallInBalance<Real>& balanced,
                                                InertialSums<Real>& sum) const {
    const BalancedBall<Real>& ball = balanced.ball;
    const Real &c = in_row.cosine, &s = in_row.sine;
    Real r_rate = at.v_y * c + at.v_z * s, r_turn = at.e_z * c - at.e_y * s, x_rate = 0., x_turn = 0.;
    if constexpr (tilts) {
      x_rate = axial_at_ball(place.arm, place.v, c, s);
      x_turn = axial_slope_at_ball(place.arm, place.e, c, s);
    }
    if constexpr (is_bent) {
      r_rate += in_row.bent.rate;
      r_turn += in_row.bent.slope;
    }
    Real rate = ball.r * r_rate;
    if constexpr (tilts) rate += ball.x * x_rate;
    const Real u = ball.u, elastic = u * u * u, F = larger(elastic + damping * u * rate, Real(0.));
    Real F_radial = F * ball.r, F_axial = F * ball.x, pull_radial = elastic * ball.r, pull_axial = elastic * ball.x;
    if constexpr (is_split) {
      F_radial -= ball.T * ball.x;
      F_axial += ball.T * ball.r;
      pull_radial -= ball.T * ball.x;
      pull_axial += ball.T * ball.r;
    }
    sum.fy -= F_radial * c;
    sum.fz -= F_radial * s;
    if constexpr (!is_in_plane) {
      sum.fx -= F_axial;
      sum.axial += pull_axial + ball.axial;
    }
    sum.cage += pull_radial * r_turn;
    if constexpr (tilts) {
      sum.my += F_radial * place.position * s - F_axial * place.arm * s;
      sum.mz += F_axial * place.arm * c - F_radial * place.position * c;
      sum.cage += pull_axial * x_turn;
    }
    sum.dissipated += (F - elastic) * rate;
    // The forces of inertia follow no potential: what they do as the balls move is work of the prescribed motion of cage and balls. What they do as
    // parts grow belongs to the work of growth.
    sum.radial += pull_radial + ball.radial;
    sum.inner += elastic;
    sum.outer += ball.Q_o;
    sum.by_inner += ball.by_inner;
    sum.by_outer += ball.by_outer;
    sum.per_force += ball.per_force;
    sum.largest = larger(sum.largest, F);
    sum.largest_outer = larger(sum.largest_outer, ball.Q_o);
    if (sums_roots) {
      sum.inner_roots += u;
      sum.outer_roots += balanced.is_ball * root_K_o * sqrt(ball.delta_o);
    }
    // The cage carries the balls past the grooves, too.
    sum.power += ball.radial * (r_rate + cage_speed * r_turn);
    if constexpr (tilts) sum.power += ball.axial * (x_rate + cage_speed * x_turn);
    if (is_wavy) {
      const auto& waves = in_row.waves;
      sum.power += ball.by_inner * waves.inner_rate + ball.by_outer * waves.outer_rate;
      sum.waviness += elastic * waves.inner_rate + ball.Q_o * waves.outer_rate;
    }
    return F_radial;
  }

  [[gnu::always_inline]] inline void add_tractions(const TractionInputOf<Real>& with,
                                                   const BallInBalance<Real>& balanced,
                                                   TractionSumsOf<Real>& sum) const {
    const auto& centre = balanced.place;
    const Real& is_ball = balanced.is_ball;
    const BalancedBall<Real>& ball = balanced.ball;
    constexpr double nothing = 1e-100;  // [N]
    const Real Q_i = ball.u * ball.u * ball.u, zero = 0.;
    sum.inner += Q_i;
    sum.outer += ball.Q_o;
    if constexpr (!is_in_plane) {
      const Real T_g = is_ball * gyroscopic_traction(with.F_c, centre.x);
      sum.gyroscopic += T_g;
      // A ball that the inner race does not reach lies in the bottom of the outer groove, where T_g is roundoff.
      const Real inner_demand =
          select(Q_i > least_share_of_load * ball.Q_o, with.inner_share * T_g / (Q_i + nothing), zero);
      const Real outer_demand = (1. - with.inner_share) * T_g / (ball.Q_o + nothing);
      sum.demand = larger(sum.demand, larger(inner_demand, outer_demand));
    }
    const Real inner_beyond = select(ball.u > 0., with.edges.inner.beyond(ball.x, ball.r, ball.u), zero);
    const Real outer_beyond = with.edges.outer.beyond(centre.x, centre.r, root_K_o * sqrt(ball.delta_o));
    sum.truncation = larger(sum.truncation, select(is_ball > 0., larger(inner_beyond, outer_beyond), zero));
  }
};

/// What a row does, from its sums; what changes with F_0 is left as work per relative change of it.
template <bool tilts, class Real>
[[gnu::always_inline]] inline void put(const InertialSums<Real>& sum, const RowPlaceOf<Real>& place,
                                       BallRowOutputOf<Real>& out) {
  put_forces<tilts>(sum, place, out);
  out.elastic_radial = sum.radial;
  out.elastic_axial = sum.axial;
  out.inner_loads = sum.inner;
  out.outer_loads = sum.outer;
  out.elastic_normal = 0.5 * ((sum.inner + sum.outer) + (sum.by_inner + sum.by_outer));
  out.elastic_outer_surplus = 0.5 * ((sum.outer - sum.inner) + (sum.by_outer - sum.by_inner));
  out.waviness_power = sum.waviness;
  out.inertia_power = sum.power;
  out.inertia_per_speed = sum.per_force;
  out.inner_load_roots = sum.inner_roots;
  out.outer_load_roots = sum.outer_roots;
  out.largest_load = sum.largest;
  out.largest_outer_load = sum.largest_outer;
}

/// Q delta of both contacts of a ball: 5/2 of its elastic energy [J].
template <class Real>
[[gnu::always_inline]] inline Real elastic_work(const InertialRowOf<Real>& row, const BalancedBall<Real>& ball) {
  const Real square = ball.u * ball.u;
  return row.c_i * square * (square * ball.u) + ball.delta_o * ball.Q_o;
}

}  // namespace rotordrop
