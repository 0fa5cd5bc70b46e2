#pragma once
// Rotor against bore, of one drop or of eight in lanes: where they are, what presses them, and the friction between them.
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "bearing/touchdown_touch.h"

namespace rotordrop {

struct BoreSlice {
  double place = 0, share = 0;  // in widths from the middle; of the width
};
/// Gauss' three points: they integrate a pressure that changes linearly along the bore, and its moment, exactly.
inline const std::array<BoreSlice, 3> bore_slices = {
    {{0., 4. / 9.}, {-0.5 * std::sqrt(0.6), 5. / 18.}, {0.5 * std::sqrt(0.6), 5. / 18.}}};
/// Of a ring that only translates: no axial force, no moments.
inline constexpr std::array<BoreSlice, 1> bore_middle = {{{0., 1.}}};
struct SlicedBore {
  std::span<const BoreSlice> slices;
  double width;
};
inline SlicedBore bore_of(const TouchdownBearingData& data) {
  return data.free_ring ? SlicedBore{bore_slices, data.free_ring->width} : SlicedBore{bore_middle, 0.};
}

/// A force at the point (x, y, z) from a body's centre, with its torque about x.
template <class Real>
void add_force(ForceOf<Real>& to, double x, const Real& y, const Real& z, const Real& f_x, const Real& f_y,
               const Real& f_z, const Real& torque) {
  to.x += f_x;
  to.y += f_y;
  to.z += f_z;
  to.moment_y += z * f_x - x * f_z;
  to.moment_z += x * f_y - y * f_x;
  to.torque += torque;
}

template <class Real>
ExpansionOf<Real> TouchdownBearing::growth(const TouchdownNumbers<Real>& q, const SupportInputOf<Real>& in,
                                           std::span<const Real> y) {
  return combined(1., in.growth, y[ring_spin] * y[ring_spin], q.centrifugal_growth);
}

template <class Real>
TouchdownBearing::BodiesOf<Real> TouchdownBearing::bodies(const MotionOf<Real>& j, std::span<const Real> y,
                                                          double x) const {
  BodiesOf<Real> at{j.y - y[ring_y], j.z - y[ring_z], j.velocity_y - y[ring_vy], j.velocity_z - y[ring_vz]};
  if constexpr (has_all<Real>) {
    if (!data_.free_ring) return at;
    // A point at x on the axis of a body with the tilts psi is displaced by psi x r = x (psi_z, -psi_y).
    at.y += x * (j.theta_z - y[tilt_z]);
    at.z += x * (y[tilt_y] - j.theta_y);
    at.vy += x * (j.tilt_rate_z - y[tilt_rate_z]);
    at.vz += x * (y[tilt_rate_y] - j.tilt_rate_y);
    at.vx = j.velocity_x - y[ring_vx];
    at.rolling_y = data_.rotor_radius * j.tilt_rate_y - data_.bore_radius * y[tilt_rate_y];
    at.rolling_z = data_.rotor_radius * j.tilt_rate_z - data_.bore_radius * y[tilt_rate_z];
  }
  return at;
}

template <class Real>
void TouchdownBearing::slide(const TouchdownNumbers<Real>& q, const SupportInputOf<Real>& in, const BodiesOf<Real>& at,
                             ContactOf<Real>& c) const {
  c.slip_x = at.vx + at.rolling_y * c.n_z - at.rolling_z * c.n_y;
  if (data_.sticking) return;
  const Real slip_squared = c.slip_speed * c.slip_speed + c.slip_x * c.slip_x;
  Real mu = q.friction.largest(data_.friction.has_stribeck, slip_squared);
  if constexpr (has_all<Real>)
    if (data_.friction.has_tables) mu = data_.friction.from_tables(mu, slip_squared, in.ring_temperature);
  const Real per_slip = q.friction.regularised(mu, slip_squared) * c.normal;
  c.friction = per_slip * c.slip_speed;
  c.friction_x = per_slip * c.slip_x;
}

template <class Real>
void TouchdownBearing::contact(const TouchdownNumbers<Real>& q, const SupportInputOf<Real>& in,
                               const ExpansionOf<Real>& growth, std::span<const Real> y, const BodiesOf<Real>& at,
                               ContactOf<Real>& c) const {
  const Real distance = sqrt(at.y * at.y + at.z * at.z);
  // Concentric rings have no direction; they do not touch either.
  const auto is_apart = distance > 0.;
  c.n_y = select(is_apart, at.y / distance, Real(-1.));
  c.n_z = select(is_apart, at.z / distance, Real(0.));
  c.distance = distance;
  c.rate = at.vy * c.n_y + at.vz * c.n_z;
  c.tangential_speed = at.vz * c.n_y - at.vy * c.n_z;
  c.centres_turning = select(is_apart, c.tangential_speed / distance, Real(0.));
  c.slip_speed = in.rotor_spin.speed * q.rotor_radius - y[ring_spin] * q.bore_radius + c.tangential_speed;
  c.penetration = distance - (q.air_gap + growth.bore - growth.shaft);
  if constexpr (has_all<Real>) {
    if (!data_.bore_waves.empty() && distance > 0.) add_bore_waves(y, at, c);
    if (data_.bending) bend_at_point(y, c);
  }
  // Written so that a penetration that is not a number goes on into the force and is found.
  const auto is_touching = !(c.penetration <= 0.);
  if (!any(is_touching)) return;
  c.elastic = q.contact.elastic(c.penetration);
  c.normal = q.contact.total(c.elastic, c.rate);
  c.damping = (c.normal - c.elastic) * c.rate;
  c.wave_power = c.elastic * c.wave_rate;
  c.lateral = -c.normal * c.bore_slope;
  slide(q, in, at, c);
}

template <class Real>
void TouchdownBearing::contact_in_slice(const TouchdownNumbers<Real>& q, const SupportInputOf<Real>& in,
                                        const ExpansionOf<Real>& growth, std::span<const Real> y,
                                        const BodiesOf<Real>& at, [[maybe_unused]] double share,
                                        [[maybe_unused]] std::span<Real> shape_forces, ContactOf<Real>& c) const {
  if constexpr (has_all<Real>)
    if (arc_table_) {
      c = contact_over_arc(in, growth, y, at, share, shape_forces);
      return;
    }
  contact(q, in, growth, y, at, c);
}

template <class Real>
TouchdownBearing::TouchOf<Real> TouchdownBearing::touch(const TouchdownNumbers<Real>& q, const SupportInputOf<Real>& in,
                                                        const ExpansionOf<Real>& growth, std::span<const Real> y,
                                                        [[maybe_unused]] std::span<Real> bristle_rates,
                                                        [[maybe_unused]] std::span<Real> shape_forces) const {
  const Real r_r = q.rotor_radius, r_b = q.bore_radius;
  TouchOf<Real> t;
  Real deepest = -std::numeric_limits<double>::infinity();
  const SlicedBore bore = bore_of(data_);
  for (std::size_t k = 0; k < bore.slices.size(); ++k) {
    const BoreSlice& slice = bore.slices[k];
    const double x = slice.place * bore.width;
    const BodiesOf<Real> at = bodies(in.journal, y, x);
    ContactOf<Real> beside;
    ContactOf<Real>& c = slice.place == 0. ? t.middle : beside;
    contact_in_slice(q, in, growth, y, at, slice.share, shape_forces, c);
    if constexpr (has_all<Real>) {
      if (data_.bending && !arc_table_) press_at_point(c, slice.share, shape_forces);
      if (data_.sticking) stick(in, y, k, c, bristle_rates);
    }
    // A penetration that is not a number goes on.
    deepest = select(c.penetration <= deepest, deepest, c.penetration);
    // On the ring: N n + F_t t, with t = x cross n = (-n_z, n_y).
    const Real normal = slice.share * c.normal, friction = slice.share * c.friction;
    const Real f_x = slice.share * c.friction_x;
    const Real along = friction + slice.share * c.lateral;
    const Real f_y = normal * c.n_y - along * c.n_z, f_z = normal * c.n_z + along * c.n_y;
    add_force(t.on_ring, x, r_b * c.n_y, r_b * c.n_z, f_x, f_y, f_z, friction * r_b);
    add_force(t.on_rotor, x, r_r * c.n_y, r_r * c.n_z, -f_x, -f_y, -f_z, -friction * r_r);
    t.elastic += slice.share * c.elastic;
    t.normal += normal;
    t.friction += friction;
    t.rub_heat += friction * c.slip_speed + f_x * c.slip_x - slice.share * c.stored_rate;
    t.damping += slice.share * c.damping;
    t.wave_power += slice.share * c.wave_power;
    t.centres_power += friction * c.tangential_speed + f_x * c.slip_x;
    t.is_touching |= c.penetration > 0.;
  }
  t.middle.penetration = deepest;  // a tilted journal touches at an end first
  if constexpr (has_all<Real>)
    if (data_.free_ring) touch_shoulders(in, y, t);
  return t;
}

}  // namespace rotordrop
