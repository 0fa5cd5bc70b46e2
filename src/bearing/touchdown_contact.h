#pragma once
// Rotor against bore, of one drop or of eight in lanes: where they are, what presses them, and the friction between them.
#include <cmath>
#include <span>

#include "bearing/touchdown_touch.h"

namespace rotordrop {

/// A force at the point (x, y, z) from a body's centre: its moments about y and z.
template <class Real>
void add_moments(ForceOf<Real>& to, double x, const Real& y, const Real& z, const Real& f_x, const Real& f_y,
                 const Real& f_z) {
  to.moment_y += z * f_x - x * f_z;
  to.moment_z += x * f_y - y * f_x;
}

template <class Real>
ExpansionOf<Real> TouchdownBearing::growth(const TouchdownFormulas<Real>& q, const SupportInputOf<Real>& in,
                                           std::span<const Real> y) {
  return combined(1., in.growth, y[ring_spin] * y[ring_spin], q.centrifugal_growth);
}

template <bool tilts, class Real>
TouchdownBearing::BodiesOf<Real> TouchdownBearing::bodies(const MotionOf<Real>& j, std::span<const Real> y,
                                                          [[maybe_unused]] double x) const {
  BodiesOf<Real> at{j.y - y[ring_y], j.z - y[ring_z], j.velocity_y - y[ring_vy], j.velocity_z - y[ring_vz]};
  if constexpr (tilts) {
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

template <bool tilts, class Real>
[[gnu::always_inline]] inline void TouchdownBearing::slide(const TouchdownFormulas<Real>& q,
                                                           const SupportInputOf<Real>& in, const BodiesOf<Real>& at,
                                                           ContactOf<Real>& c) const {
  if constexpr (tilts) c.slip_x = at.vx + at.rolling_y * c.n_z - at.rolling_z * c.n_y;
  if (data_.sticking) return;
  Real slip_squared = c.slip_speed * c.slip_speed;
  if constexpr (tilts) slip_squared += c.slip_x * c.slip_x;
  Real mu = q.friction.largest(data_.friction.has_stribeck, slip_squared);
  if constexpr (has_all<Real>)
    if (data_.friction.has_tables) mu = data_.friction.from_tables(mu, slip_squared, in.ring_temperature);
  // eq. (10) of Neisi 2019, regularised and along the slip
  const Real per_slip = q.friction.regularised(mu, slip_squared) * c.normal;
  c.friction = per_slip * c.slip_speed;
  if constexpr (tilts) c.friction_x = per_slip * c.slip_x;
}

// Takes its numbers by value: GCC would keep a contact in memory whose address goes to a function.
template <class Real>
[[gnu::noinline]] TouchdownBearing::BoreWavesAtPointOf<Real> TouchdownBearing::bore_waves_at(
    const TouchdownFormulas<Real>& q, std::span<const Real> y, Real n_y, Real n_z, Real centres_turning) {
  const Real passing = centres_turning - y[ring_spin];
  BoreWavesAtPointOf<Real> waves;
  for (const auto& wave : q.bore_waves) {
    const SineCosineOf<Real> at = multiple_of(wave.order, SineCosineOf<Real>{n_z, n_y});
    const TurnedWaveOf<Real> turned = wave.turned(y[ring_angle]);
    waves.height += turned.height(at.sine, at.cosine);
    waves.rate += static_cast<double>(wave.order) * passing * turned.slope(at.sine, at.cosine);
  }
  return waves;
}

template <bool tilts, class Real>
[[gnu::always_inline]] inline TouchdownBearing::ContactOf<Real> TouchdownBearing::contact(
    const TouchdownFormulas<Real>& q, const SupportInputOf<Real>& in, const ExpansionOf<Real>& growth,
    std::span<const Real> y, const BodiesOf<Real>& at) const {
  ContactOf<Real> c;
  const Real distance = sqrt(at.y * at.y + at.z * at.z);  // e_r, eq. (9)
  // Concentric rings have no direction; they do not touch either.
  const auto is_apart = distance > 0.;
  c.n_y = select(is_apart, at.y / distance, Real(-1.));
  c.n_z = select(is_apart, at.z / distance, Real(0.));
  c.distance = distance;
  c.rate = at.vy * c.n_y + at.vz * c.n_z;
  c.tangential_speed = at.vz * c.n_y - at.vy * c.n_z;
  c.centres_turning = select(is_apart, c.tangential_speed / distance, Real(0.));
  c.slip_speed = in.rotor_spin.speed * q.rotor_radius - y[ring_spin] * q.bore_radius + c.tangential_speed;
  // eq. (8), corrected: a warm ring opens the gap
  c.penetration = distance - (q.air_gap + growth.bore - growth.shaft);
  if (!q.bore_waves.empty()) {
    const BoreWavesAtPointOf<Real> waves = bore_waves_at(q, y, c.n_y, c.n_z, c.centres_turning);
    c.penetration += select(is_apart, waves.height, Real(0.));
    c.wave_rate = select(is_apart, waves.rate, Real(0.));
  }
  if constexpr (has_all<Real>) {
    if (data_.bending) {
      const BendAtPoint bend = bend_at_point(y, c.n_y, c.n_z);
      c.penetration -= bend.u;
      // d(delta)/dt with the line of centres turning through the shape.
      c.rate -= bend.rate + bend.slope * c.centres_turning;
      // The line of centres' direction has no meaning for concentric rings, which do not touch.
      c.bore_slope = distance > 0. ? bend.slope / distance : 0.;
    }
  }
  // Written so that a penetration that is not a number goes on into the force and is found.
  const auto is_touching = !(c.penetration <= 0.);
  if (!any(is_touching)) return c;
  // eq. (7), corrected
  c.elastic = q.contact.elastic(c.penetration, q.contact_exponent);
  c.normal = q.contact.total(c.elastic, c.rate);
  c.damping = (c.normal - c.elastic) * c.rate;
  c.wave_power = c.elastic * c.wave_rate;
  c.lateral = -c.normal * c.bore_slope;
  slide<tilts>(q, in, at, c);
  return c;
}

template <bool tilts>
[[gnu::noinline]] TouchdownBearing::Contact TouchdownBearing::bent_or_sticking_contact(
    const SupportInput& in, const Expansion& growth, std::span<const double> y, Bodies at, const BoreSlice& slice,
    std::span<double> bristle_rates, std::span<double> shape_forces) const {
  Contact c = arc_table_ ? contact_over_arc(in, growth, y, at, slice.share, shape_forces)
                         : contact<tilts>(numbers_, in, growth, y, at);
  if (data_.bending && !arc_table_) press_at_point(c, slice.share, shape_forces);
  if (data_.sticking) stick(in, y, slice.number, c, bristle_rates);
  return c;
}

template <bool tilts, class Real>
[[gnu::always_inline]] inline TouchdownBearing::ContactOf<Real> TouchdownBearing::contact_in_slice(
    const TouchdownFormulas<Real>& q, const SupportInputOf<Real>& in, const ExpansionOf<Real>& growth,
    std::span<const Real> y, const BoreSlice& slice, [[maybe_unused]] std::span<Real> bristle_rates,
    [[maybe_unused]] std::span<Real> shape_forces) const {
  BodiesOf<Real> at = bodies<tilts>(in.journal, y, slice.x);
  if constexpr (has_all<Real>)
    if (data_.bending || data_.sticking)
      return bent_or_sticking_contact<tilts>(in, growth, y, at, slice, bristle_rates, shape_forces);
  return contact<tilts>(q, in, growth, y, at);
}

template <bool tilts, class Real>
[[gnu::always_inline]] inline TouchdownBearing::TouchOf<Real> TouchdownBearing::touch_in_slice(
    const TouchdownFormulas<Real>& q, const ContactOf<Real>& c, const BoreSlice& slice) {
  // On the ring: N n + F_t t, with t = x cross n = (-n_z, n_y).
  const Real normal = slice.share * c.normal, friction = slice.share * c.friction;
  const Real along = friction + slice.share * c.lateral;
  const Real f_y = normal * c.n_y - along * c.n_z, f_z = normal * c.n_z + along * c.n_y;
  const Real &r_r = q.rotor_radius, &r_b = q.bore_radius;
  TouchOf<Real> t{.on_ring = {.y = f_y, .z = f_z, .torque = friction * r_b},
                  .on_rotor = {.y = -f_y, .z = -f_z, .torque = -friction * r_r},
                  .elastic = slice.share * c.elastic,
                  .normal = normal,
                  .friction = friction,
                  .rub_heat = friction * c.slip_speed - slice.share * c.stored_rate,  // eq. (19)
                  .damping = slice.share * c.damping,
                  .wave_power = slice.share * c.wave_power,
                  .centres_power = friction * c.tangential_speed,
                  .is_touching = c.penetration > 0.};
  if constexpr (tilts) {
    const Real f_x = slice.share * c.friction_x;
    t.on_ring.x = f_x;
    t.on_rotor.x = -f_x;
    add_moments(t.on_ring, slice.x, r_b * c.n_y, r_b * c.n_z, f_x, f_y, f_z);
    add_moments(t.on_rotor, slice.x, r_r * c.n_y, r_r * c.n_z, -f_x, -f_y, -f_z);
    t.rub_heat += f_x * c.slip_x;
    t.centres_power += f_x * c.slip_x;
  }
  return t;
}

// What is not const here and in evaluate_with() would stay in memory with GCC if it were.
template <class Real>
[[gnu::always_inline]] inline TouchdownBearing::TouchOf<Real> TouchdownBearing::touch(
    const TouchdownFormulas<Real>& q, const SupportInputOf<Real>& in, const ExpansionOf<Real>& growth,
    std::span<const Real> y, std::span<Real> bristle_rates, std::span<Real> shape_forces) const {
  if constexpr (has_all<Real>)
    if (data_.free_ring) {
      const Touch all = touch_of_free_ring(in, growth, y, bristle_rates, shape_forces);
      return all;
    }
  ContactOf<Real> c = contact_in_slice<false>(q, in, growth, y, bore_middle, bristle_rates, shape_forces);
  TouchOf<Real> t = touch_in_slice<false>(q, c, bore_middle);
  t.middle = c;
  return t;
}

}  // namespace rotordrop
