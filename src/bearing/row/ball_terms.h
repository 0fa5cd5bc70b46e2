#pragma once
// One ball between its races: the formulas that all sums over a row are made of (see BallRow), for one drop and for eight in lanes.
#include "base/real.h"
#include "bearing/row/ball_row.h"
#include "laws/skidding.h"

namespace rotordrop {

/// What a row's balls have in common at one instant, seen from the cage: there a ball's azimuth is that at cage angle zero.
template <class Real>
struct RowPlaceOf {
  Real grown;                                        // added to every delta: 2 eps_b
  Real A, radial, axial, arm, position, K, damping;  // damping = 1.5 beta
  Real cage_cosine, cage_sine;
  RingDisplacementOf<Real> e, v;  // in the cage's frame

  /// Gives a vector that was summed in the cage's frame its place at rest.
  void turn_back(Real& y, Real& z) const {
    const Real in_cage = y;
    y = cage_cosine * in_cage - cage_sine * z;
    z = cage_sine * in_cage + cage_cosine * z;
  }
};

/// A displacement, or its rate, in the cage's frame.
template <class Real>
RingDisplacementOf<Real> seen_from_cage(const RingDisplacementOf<Real>& d, const Real& cosine, const Real& sine) {
  return {d.x, d.y * cosine + d.z * sine, d.z * cosine - d.y * sine, d.psi_y * cosine + d.psi_z * sine,
          d.psi_z * cosine - d.psi_y * sine};
}

/// @param of_balls  added to every delta
template <class Real>
RowPlaceOf<Real> row_place(const RowNumbers<Real>& row, const BallRowInputOf<Real>& in, const Real& of_balls) {
  const GroovesOf<Real> g = grown(row.grooves, row.strains, row.difference_share, in);
  const Real &C = in.cage_cosine, &S = in.cage_sine;
  return {of_balls,
          g.A,
          g.radial,
          g.axial,
          g.arm,
          row.position,
          row.stiffness,
          row.damping,
          C,
          S,
          seen_from_cage(in.displacement, C, S),
          seen_from_cage(in.rate, C, S)};
}

/// By how much bent rings move a ball's races apart, its rate, and its slope around the ring.
template <class Real>
struct BallWidening {
  Real width, rate, slope;
};

/// One ball's contact with the races, and its parts of the row's sums. Forces are on the ball's inner race, against the ring's.
template <class Real>
struct BallTerms {
  Real cos_phi, sin_phi;  // of the contact angle
  Real delta, root;       // penetration and its root
  Real elastic, F;        // [N]
  Real rate;              // of the penetration [m/s]
  Real turn;              // change of the penetration over the cage's turning [m]
  Real cage;              // torque by elastic forces over the cage's turning [N m]
};

/// How far a ring is displaced along y and z where its row lies, and the rates of that, in the cage's frame.
template <class Real>
struct AtRow {
  Real e_y, e_z, v_y, v_z;
};
/// @tparam tilts  of a ring that also tilts
template <bool tilts, class Real>
[[gnu::always_inline]] inline AtRow<Real> at_row(const RowPlaceOf<Real>& in) {
  AtRow<Real> at{in.e.y, in.e.z, in.v.y, in.v.z};
  if constexpr (tilts) {
    at.e_y += in.position * in.e.psi_z;
    at.e_z -= in.position * in.e.psi_y;
    at.v_y += in.position * in.v.psi_z;
    at.v_z -= in.position * in.v.psi_y;
  }
  return at;
}

/// Displacement of the inner groove along the axis at a ball, or its rate: e_t of Neisi 2019, eq. (2), its first tilt with the other sign.
/// @param d             the ring's displacement, in the cage's frame
/// @param cosine, sine  of the ball's azimuth there
template <class Real>
[[gnu::always_inline]] inline Real axial_at_ball(const Real& arm, const RingDisplacementOf<Real>& d, const Real& cosine,
                                                 const Real& sine) {
  return d.x + arm * (d.psi_y * sine - d.psi_z * cosine);
}
/// Its derivative by the azimuth.
template <class Real>
[[gnu::always_inline]] inline Real axial_slope_at_ball(const Real& arm, const RingDisplacementOf<Real>& d,
                                                       const Real& cosine, const Real& sine) {
  return arm * (d.psi_y * cosine + d.psi_z * sine);
}

/// How a row's grooves can move against each other: what cannot happen is left out of the sums.
enum class GrooveMotion {
  in_plane,  ///< a ring that only translates, its contact angles zero: the centres of both grooves stay in one plane (BallRow::is_radial())
  translating,  ///< a ring that only translates
  all           ///< one that moves in all five ways
};

/// The penetration of a ball, where it is and how it changes. In the symbols of Neisi 2019 e_r^j and e_t^j are what the ring's displacements add to
/// Br and Bx, distance is A + d - D_j, phi_j is in cos_phi and sin_phi, and delta is delta_tot^j.
/// @tparam is_bent      of bent rings
/// @param cosine, sine  of its azimuth, in the cage's frame
/// @param added         to the penetration: waves, or what keeps an idle ball away
template <GrooveMotion motion, bool is_bent, class Real>
[[gnu::always_inline]] inline BallTerms<Real> ball_penetration(const RowPlaceOf<Real>& in, const Real& cosine,
                                                               const Real& sine, const Real& added,
                                                               const BallWidening<Real>& bent) {
  constexpr bool tilts = motion == GrooveMotion::all;
  BallTerms<Real> b;
  const Real &c = cosine, &s = sine;
  auto [e_y, e_z, v_y, v_z] = at_row<tilts>(in);
  Real Bx = in.axial, Bx_rate = 0., Bx_turn = 0.;
  if constexpr (tilts) {
    Bx += axial_at_ball(in.arm, in.e, c, s);
    Bx_rate = axial_at_ball(in.arm, in.v, c, s);
    Bx_turn = axial_slope_at_ball(in.arm, in.e, c, s);
  }
  // eq. (2): e_r
  Real Br = in.radial + e_y * c + e_z * s, Br_rate = v_y * c + v_z * s, Br_turn = e_z * c - e_y * s;
  if constexpr (is_bent) {
    Br += bent.width;
    Br_rate += bent.rate;
    Br_turn += bent.slope;
  }
  Real distance;  // of the groove centres, eq. (3)
  if constexpr (motion == GrooveMotion::in_plane) {
    distance = abs(Br);
    b.cos_phi = select(Br < 0., Real(-1.), Real(1.));
    b.sin_phi = 0.;
  } else {
    const auto [root, inverse] = root_and_inverse(Br * Br + Bx * Bx);
    distance = root;
    // eq. (4)
    b.cos_phi = Br * inverse;
    b.sin_phi = Bx * inverse;
  }
  // eq. (5); with waves eq. (12)
  b.delta = larger(distance - (in.A - in.grown - added), Real(0.));
  b.rate = b.cos_phi * Br_rate;
  if constexpr (tilts) b.rate += b.sin_phi * Bx_rate;
  b.turn = b.cos_phi * Br_turn;
  if constexpr (tilts) b.turn += b.sin_phi * Bx_turn;
  return b;
}

/// What its penetration makes of it: nothing where there is none. F is F_j of eq. (6), with damping.
template <class Real>
[[gnu::always_inline]] inline void press_ball(const RowPlaceOf<Real>& in, BallTerms<Real>& b) {
  b.root = sqrt(b.delta);
  const Real stiffness = in.K * b.root;
  b.elastic = stiffness * b.delta;
  b.F = larger(stiffness * (b.delta + in.damping * b.rate), Real(0.));
  b.cage = b.elastic * b.turn;
}

/// What the tractions of a row depend on besides.
template <class Real>
struct TractionInputOf {
  Real F_c;          // of a ball, at the cage's speed [N]
  Real inner_share;  // of the gyroscopic traction
  RaceEdgesOf<Real> edges;
};

/// One ball's parts of the tractions' sums.
template <class Real>
struct TractionTerms {
  Real outer, gyroscopic, demand, beyond;
};
template <GrooveMotion motion, class Real>
[[gnu::always_inline]] inline TractionTerms<Real> traction_terms(const TractionInputOf<Real>& with,
                                                                 const BallTerms<Real>& b) {
  constexpr double nothing = 1e-100;  // [N]
  TractionTerms<Real> t;
  Real outer_load;
  if constexpr (motion == GrooveMotion::in_plane) {  // what outer_contact() gives where sin phi_i = 0
    outer_load = abs(b.F * b.cos_phi + with.F_c);
    t.gyroscopic = t.demand = 0.;
  } else {
    const OuterContactOf<Real> o = outer_contact(b.F, b.sin_phi, b.cos_phi, with.F_c);
    outer_load = o.load;
    t.gyroscopic = gyroscopic_traction(with.F_c, o.sine);
    t.demand = (1. - with.inner_share) * t.gyroscopic * o.per_load;
    if (any(with.inner_share > 0.)) t.demand = larger(with.inner_share * t.gyroscopic / (b.F + nothing), t.demand);
  }
  // A ball without load lies in the outer race by its centrifugal force alone.
  t.outer = select(b.delta > 0., outer_load, with.F_c);
  // Without damping, Q^(1/3) = K^(1/3) delta^(1/2).
  const auto &inner_edge = with.edges.inner, &outer_edge = with.edges.outer;
  const Real sine = abs(b.sin_phi), per_root = 1. / (b.root + 1e-30);
  const Real inner_margin = (inner_edge.sine * b.cos_phi - inner_edge.cosine * sine) * per_root;
  const Real outer_margin = (outer_edge.sine * b.cos_phi - outer_edge.cosine * sine) * per_root;
  const Real beyond = 0.5 - smaller(outer_margin, inner_margin);
  t.beyond = select(b.delta > 0., beyond, Real(0.));
  return t;
}

/// Sums over the balls of a row, in the cage's frame.
template <class Real>
struct ForceSumsOf {
  Real fx = 0, fy = 0, fz = 0, my = 0, mz = 0, dissipated = 0, elastic_radial = 0, elastic_axial = 0,
       elastic_normal = 0, cage = 0, largest = 0, roots = 0;
  /// @param cosine, sine  of the ball's azimuth
  template <GrooveMotion motion>
  [[gnu::always_inline]] inline void add(const RowPlaceOf<Real>& place, const BallTerms<Real>& b, const Real& cosine,
                                         const Real& sine) {
    const Real F_radial = b.F * b.cos_phi, F_axial = b.F * b.sin_phi;
    fy -= F_radial * cosine;
    fz -= F_radial * sine;
    if constexpr (motion != GrooveMotion::in_plane) {
      fx -= F_axial;
      elastic_axial += b.elastic * b.sin_phi;
    }
    if constexpr (motion == GrooveMotion::all) {
      my += F_radial * place.position * sine - F_axial * place.arm * sine;
      mz += F_axial * place.arm * cosine - F_radial * place.position * cosine;
    }
    dissipated += (b.F - b.elastic) * b.rate;
    elastic_radial += b.elastic * b.cos_phi;
    elastic_normal += b.elastic;
    cage += b.cage;
    largest = larger(largest, b.F);
    roots += b.root;
  }
};
template <class Real>
struct TractionSumsOf {
  Real inner = 0, outer = 0, gyroscopic = 0, demand = 0, truncation = 0;
  template <GrooveMotion motion>
  [[gnu::always_inline]] inline void add(const TractionInputOf<Real>& with, const BallTerms<Real>& b) {
    const TractionTerms<Real> t = traction_terms<motion>(with, b);
    inner += b.F;
    outer += t.outer;
    gyroscopic += t.gyroscopic;
    demand = larger(demand, t.demand);
    truncation = larger(truncation, t.beyond);
  }
};

/// Forces on the inner ring and what goes with them, from sums over the balls of a row in the cage's frame.
/// @tparam Sums  with or without inertia of the balls
template <bool tilts, class Sums, class Real>
[[gnu::always_inline]] inline void put_forces(const Sums& sum, const RowPlaceOf<Real>& place,
                                              BallRowOutputOf<Real>& out) {
  out.force_x = sum.fx;
  out.force_y = sum.fy;
  out.force_z = sum.fz;
  out.moment_y = sum.my;
  out.moment_z = sum.mz;
  place.turn_back(out.force_y, out.force_z);
  if constexpr (tilts) place.turn_back(out.moment_y, out.moment_z);
  out.damping_power = sum.dissipated;
  out.cage_torque = sum.cage;
}

/// What a row without inertia of its balls does, from its sums; its waves' power is left to the caller.
/// @param stiffness_root  K^(1/3)
template <bool tilts, class Real>
[[gnu::always_inline]] inline void put(const ForceSumsOf<Real>& sum, const RowPlaceOf<Real>& place,
                                       const Real& stiffness_root, BallRowOutputOf<Real>& out) {
  put_forces<tilts>(sum, place, out);
  out.elastic_radial = sum.elastic_radial;
  out.elastic_axial = sum.elastic_axial;
  out.elastic_normal = sum.elastic_normal;
  out.elastic_outer_surplus = 0.;
  out.largest_load = out.largest_outer_load = sum.largest;
  out.inner_load_roots = out.outer_load_roots = stiffness_root * sum.roots;
  out.inner_loads = out.outer_loads = sum.elastic_normal;
  out.inertia_power = out.inertia_per_speed = 0.;
}
template <class Real>
[[gnu::always_inline]] inline void put(const TractionSumsOf<Real>& sum, const TractionInputOf<Real>& with,
                                       RowTractionsOf<Real>& out) {
  out = {.inner_load = sum.inner,
         .outer_load = sum.outer,
         .gyroscopic = (1. - with.inner_share) * sum.gyroscopic,
         .largest_gyroscopic_over_load = sum.demand,
         .inner_gyroscopic = with.inner_share * sum.gyroscopic,
         .centrifugal = with.F_c,
         .truncation = smaller(sum.truncation, Real(1.))};
}

}  // namespace rotordrop
