#pragma once
// What rolling and gyroscopic moments ask of the friction between balls and races, outer ring at rest.
//
// One ball on the pitch radius r_m, carried round with omega_c, J_b = m d^2/10; t: its direction of travel, n: contact normal, both contacts in line,
// a = n x t the axis about which it rolls, W = -Omega . a the part of its absolute spin along it. Tractions T_i, T_o of the races on the ball along +t:
//   T_i + T_o = m r_m omega_c'                     orbit, no force from the cage
//   (T_i - T_o) d/2 = J_b W'                       spin about a
//   W d/2 = r_m omega_c                            rolling on the outer race, which stands
// so T_i = 0.7 m r_m omega_c', T_o = 0.3 m r_m omega_c', whatever the contact angle. On the inner race, which moves with v = 2 r_m omega_c, T_i v is the
// rate of m r_m^2 omega_c^2 / 2 + J_b W^2 / 2. A cage may move forces from ball to ball; the sums over a row stay.
#include "base/real.h"

namespace rotordrop {

/// Tractions of the races on one ball along its direction of travel [N].
template <class Real>
struct RollingTractionsOf {
  Real inner, outer;
};
/// Those that keep a ball rolling while its centre is accelerated along its path.
/// Source: Newton's and Euler's equations of a solid sphere, above. Valid for both contacts in line; left out: friction torques of
/// the bearing (rolling resistance, drag on the balls) and the small moment J_b omega_c' sin phi about the contact normal.
/// @param ball_mass m [kg]; @param acceleration r_m omega_c' [m/s^2]
template <class Real>
RollingTractionsOf<Real> rolling_tractions(const Real& ball_mass, const Real& acceleration) {
  return {0.7 * ball_mass * acceleration, 0.3 * ball_mass * acceleration};
}

// Always inline: loops over balls are compiled for several kinds of machine, and such a loop calls what is compiled for the plain one. Arguments by value:
// by reference they keep such loops from becoming vectors (GCC 12).

/// Outer contact of a ball.
template <class Real>
struct OuterContactOf {
  Real load;      ///< Q_o [N]
  Real sine;      ///< of the contact angle, 0 without load
  Real per_load;  ///< 1 / Q_o, finite without load [1/N]
};
/// The outer contact of a ball takes the inner one's load and the centrifugal force: Q_o n_o = Q_i n_i + F_c e_r.
/// @param load, sine, cosine  Q_i [N] and the inner contact angle's; @param centrifugal_force F_c [N], >= 0
template <class Real>
[[gnu::always_inline]] inline OuterContactOf<Real> outer_contact(Real load, Real sine, Real cosine,
                                                                 Real centrifugal_force) {
  const Real axial = load * sine, radial = load * cosine + centrifugal_force;
  const Real square = axial * axial + radial * radial;
  constexpr double nothing = 1e-200;  // [N^2], added instead of asked for, so that loops over balls become vectors
  const Real inverse = inverse_root(square + nothing);
  return {square * inverse, axial * inverse, inverse};
}

/// Friction across the rolling direction that keeps the axis of a ball turning with its orbit [N]:
///   T_g = 2 M_g / d = 0.4 F_c sin phi_o, of both races together (laws/ball_balance.h).
/// In line contacts with outer_contact() it is at most 0.2 tan(phi_i / 2) of the outer load, reached where Q_i = F_c; and 0.4 sin phi_i of the inner load.
/// @param centrifugal_force F_c [N]; @param outer_sine sin phi_o
template <class Real>
[[gnu::always_inline]] inline Real gyroscopic_traction(Real centrifugal_force, Real outer_sine) {
  return 0.4 * centrifugal_force * abs(outer_sine);
}

/// Balls whose inner load is less than this part of the outer one ask no gyroscopic traction of the inner race: theirs falls with that load.
inline constexpr double least_share_of_load = 1e-3;

/// Loads of a row's contacts, the gyroscopic tractions at them, and where they reach: what is observed, not needed for the motion.
template <class Real>
struct RowTractionsOf {
  Real inner_load, outer_load;        ///< sums over the balls [N]
  Real gyroscopic;                    ///< sum of T_g's part at the outer race [N]
  Real largest_gyroscopic_over_load;  ///< largest part of T_g over the load of its contact
  Real inner_gyroscopic;              ///< sum of T_g's part at the inner race [N]
  Real centrifugal;                   ///< F_c of a ball at the cage's speed [N]
  Real truncation;                    ///< largest part of a contact ellipse's length beyond its raceway's edge
};
using RowTractions = RowTractionsOf<double>;

/// What is reported where friction gives nothing, or less than a hundredth of what is asked.
inline constexpr double largest_traction_demand = 100.;

/// Traction asked for over the most that friction gives, mu Q: 0 where nothing is asked, at most largest_traction_demand.
/// @param traction [N], >= 0; @param friction_coefficient mu, >= 0; @param load Q [N], >= 0
template <class Real>
Real traction_demand(const Real& traction, const Real& friction_coefficient, const Real& load) {
  const Real given = friction_coefficient * load;
  const Real most = largest_traction_demand;
  return select(traction == 0., Real(0.), select(given > 0., smaller(traction / given, most), most));
}

/// Demand of a row's rolling: the larger of
///   inner race  sqrt((Z T_i)^2 + (sum T_g,i)^2) / (mu sum Q_i)
///   outer race  sqrt((Z T_o)^2 + (sum T_g,o)^2) / (mu sum Q_o)
/// Above 1 the row's balls together cannot be kept rolling. Below 1 they can if the cage shares forces out.
/// @param n_balls Z; @param acceleration r_m |omega_c'| [m/s^2]
template <class Real>
Real rolling_demand(const RowTractionsOf<Real>& row, int n_balls, const Real& ball_mass, const Real& acceleration,
                    const Real& friction_coefficient) {
  const auto one = rolling_tractions(ball_mass, acceleration);
  const auto demand = [&](const Real& along, const Real& across, const Real& load) {
    return traction_demand(sqrt(along * along + across * across), friction_coefficient, load);
  };
  return larger(demand(n_balls * one.inner, row.inner_gyroscopic, row.inner_load),
                demand(n_balls * one.outer, row.gyroscopic, row.outer_load));
}

}  // namespace rotordrop
