// Rotor against the inner ring: the bore, at its middle or in slices along its width, and shoulders of the rotor beside the ring's faces.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "bearing/touchdown_touch.h"

namespace rotordrop {
namespace {

struct Slice {
  double place = 0, share = 0;  // in widths from the middle; of the width
};
/// Gauss' three points: they integrate a pressure that changes linearly along the bore, and its moment, exactly.
const std::array<Slice, 3> slices = {
    {{0., 4. / 9.}, {-0.5 * std::sqrt(0.6), 5. / 18.}, {0.5 * std::sqrt(0.6), 5. / 18.}}};

/// Of a ring that only translates: no axial force, no moments.
constexpr std::array<Slice, 1> middle = {{{0., 1.}}};
struct Bore {
  std::span<const Slice> slices;
  double width;
};
Bore bore_of(const TouchdownBearingData& data) {
  return data.free_ring ? Bore{slices, data.free_ring->width} : Bore{middle, 0.};
}

/// A shoulder meets the ring's face at so many places around it.
constexpr std::size_t n_around = 8;
struct Direction {
  double c, s;
};
const std::array<Direction, n_around> around = [] {
  std::array<Direction, n_around> directions{};
  for (std::size_t j = 0; j < n_around; ++j) {
    const double azimuth = 2. * std::numbers::pi * (static_cast<double>(j) + 0.5) / n_around;
    directions[j] = {std::cos(azimuth), std::sin(azimuth)};
  }
  return directions;
}();

/// A force at the point (x, y, z) from a body's centre, with its torque about x.
void add_force(Force& to, double x, double y, double z, double f_x, double f_y, double f_z, double torque) {
  to.x += f_x;
  to.y += f_y;
  to.z += f_z;
  to.moment_y += z * f_x - x * f_z;
  to.moment_z += x * f_y - y * f_x;
  to.torque += torque;
}

}  // namespace

TouchdownBearing::Bodies TouchdownBearing::bodies(const Motion& j, std::span<const double> y, double x) const {
  Bodies at{j.y - y[ring_y], j.z - y[ring_z], j.velocity_y - y[ring_vy], j.velocity_z - y[ring_vz]};
  if (!data_.free_ring) return at;
  // A point at x on the axis of a body with the tilts psi is displaced by psi x r = x (psi_z, -psi_y).
  at.y += x * (j.theta_z - y[tilt_z]);
  at.z += x * (y[tilt_y] - j.theta_y);
  at.vy += x * (j.tilt_rate_z - y[tilt_rate_z]);
  at.vz += x * (y[tilt_rate_y] - j.tilt_rate_y);
  at.vx = j.velocity_x - y[ring_vx];
  at.rolling_y = data_.rotor_radius * j.tilt_rate_y - data_.bore_radius * y[tilt_rate_y];
  at.rolling_z = data_.rotor_radius * j.tilt_rate_z - data_.bore_radius * y[tilt_rate_z];
  return at;
}

void TouchdownBearing::slide(const SupportInput& in, const Bodies& at, Contact& c) const {
  c.slip_x = at.vx + at.rolling_y * c.n_z - at.rolling_z * c.n_y;
  if (data_.sticking) return;
  const double slip_squared = c.slip_speed * c.slip_speed + c.slip_x * c.slip_x;
  const double per_slip = data_.friction.per_speed(slip_squared, in.ring_temperature) * c.normal;
  c.friction = per_slip * c.slip_speed;
  c.friction_x = per_slip * c.slip_x;
}

TouchdownBearing::Contact TouchdownBearing::contact(const SupportInput& in, const Expansion& growth,
                                                    std::span<const double> y, const Bodies& at) const {
  Contact c;
  const double ey = at.y, ez = at.z, vy = at.vy, vz = at.vz;
  const double distance = std::sqrt(ey * ey + ez * ez);
  // Concentric rings have no direction; they do not touch either.
  c.n_y = distance > 0. ? ey / distance : -1.;
  c.n_z = distance > 0. ? ez / distance : 0.;
  c.distance = distance;
  c.rate = vy * c.n_y + vz * c.n_z;
  c.tangential_speed = vz * c.n_y - vy * c.n_z;
  c.centres_turning = distance > 0. ? c.tangential_speed / distance : 0.;
  c.slip_speed = in.rotor_spin.speed * data_.rotor_radius - y[ring_spin] * data_.bore_radius + c.tangential_speed;
  c.penetration = distance - (data_.air_gap + growth.bore - growth.shaft);
  if (!data_.bore_waves.empty() && distance > 0.) {
    const double angle = std::atan2(ez, ey) - y[ring_angle];
    const double angle_rate = c.centres_turning - y[ring_spin];
    for (const auto& w : data_.bore_waves) {
      c.penetration += w.amplitude * std::sin(w.order * angle + w.phase);
      c.wave_rate += w.amplitude * w.order * angle_rate * std::cos(w.order * angle + w.phase);
    }
  }
  if (data_.bending) bend_at_point(y, c);
  // Written so that a penetration that is not a number goes on into the force and is found.
  if (!(c.penetration <= 0.)) {
    c.elastic = data_.contact.K * std::pow(c.penetration, data_.contact.n);
    c.normal = data_.contact.total(c.elastic, c.rate);
    c.damping = (c.normal - c.elastic) * c.rate;
    c.wave_power = c.elastic * c.wave_rate;
    c.lateral = -c.normal * c.bore_slope;
    slide(in, at, c);
  }
  return c;
}

std::size_t TouchdownBearing::n_bristles() const {
  if (!data_.sticking) return 0;
  return data_.free_ring ? 2 * slices.size() : 1;
}

StickingFriction::Vector TouchdownBearing::bristle(std::span<const double> y, std::size_t slice) const {
  const std::size_t at = bristles_at();
  if (!data_.free_ring) return {y[at], 0.};
  return {y[at + 2 * slice], y[at + 2 * slice + 1]};
}

// Without contact the bristle straightens.
void TouchdownBearing::stick(const SupportInput& in, std::span<const double> y, std::size_t slice, Contact& c,
                             std::span<double> bristle_rates) const {
  const double squared = c.slip_speed * c.slip_speed + c.slip_x * c.slip_x;
  const double through = data_.bore_radius * std::fabs(y[ring_spin] - c.centres_turning);
  const auto r = data_.sticking->evaluate(bristle(y, slice), {c.slip_speed, c.slip_x},
                                          data_.friction.largest(squared, in.ring_temperature) * c.normal, through);
  c.friction = r.force.t;
  c.friction_x = r.force.x;
  c.stored_rate = r.stored_rate;
  if (data_.free_ring) {
    bristle_rates[2 * slice] = r.bristle_rate.t;
    bristle_rates[2 * slice + 1] = r.bristle_rate.x;
  } else {
    bristle_rates[0] = r.bristle_rate.t;
  }
}

TouchdownBearing::Touch TouchdownBearing::touch(const SupportInput& in, const Expansion& growth,
                                                std::span<const double> y, std::span<double> bristle_rates,
                                                std::span<double> shape_forces) const {
  const double r_r = data_.rotor_radius, r_b = data_.bore_radius;
  Touch t;
  double deepest = -std::numeric_limits<double>::infinity();
  const Bore bore = bore_of(data_);
  for (std::size_t k = 0; k < bore.slices.size(); ++k) {
    const Slice& slice = bore.slices[k];
    const double x = slice.place * bore.width;
    const Bodies at = bodies(in.journal, y, x);
    Contact c =
        arc_table_ ? contact_over_arc(in, growth, y, at, slice.share, shape_forces) : contact(in, growth, y, at);
    if (data_.bending && !arc_table_) press_at_point(c, slice.share, shape_forces);
    if (data_.sticking) stick(in, y, k, c, bristle_rates);
    if (slice.place == 0.) t.middle = c;
    // Unlike std::max, a penetration that is not a number goes on.
    if (!(c.penetration <= deepest)) deepest = c.penetration;
    // On the ring: N n + F_t t, with t = x cross n = (-n_z, n_y).
    const double normal = slice.share * c.normal, friction = slice.share * c.friction;
    const double f_x = slice.share * c.friction_x;
    const double along = friction + slice.share * c.lateral;
    const double f_y = normal * c.n_y - along * c.n_z, f_z = normal * c.n_z + along * c.n_y;
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
  if (data_.free_ring) touch_shoulders(in, y, t);
  return t;
}

void TouchdownBearing::touch_shoulders(const SupportInput& in, std::span<const double> y, Touch& sum) const {
  const Motion& j = in.journal;
  const FreeRing& ring = *data_.free_ring;
  const double r = ring.shoulder_radius, spinning = in.rotor_spin.speed - y[ring_spin];
  const double x = j.x - y[ring_x], v_x = j.velocity_x - y[ring_vx];
  const double tilt_about_y = j.theta_y - y[tilt_y], tilt_about_z = j.theta_z - y[tilt_z];
  const double rate_y = j.tilt_rate_y - y[tilt_rate_y], rate_z = j.tilt_rate_z - y[tilt_rate_z];
  for (const Shoulder& shoulder : ring.shoulders) {
    const double face = 0.5 * shoulder.side * ring.width;  // where it is, from the ring's centre
    const double v_y = j.velocity_y - y[ring_vy] + face * rate_z, v_z = j.velocity_z - y[ring_vz] - face * rate_y;
    for (const auto& [c, s] : around) {
      // The shoulder at +x closes when the rotor moves towards -x.
      const double penetration = -shoulder.side * (x + r * (tilt_about_y * s - tilt_about_z * c)) - shoulder.gap;
      if (penetration <= 0.) continue;
      const double rate = -shoulder.side * (v_x + r * (rate_y * s - rate_z * c));
      const double elastic = ring.shoulder_stiffness / n_around * penetration;
      const double normal = std::max(elastic * (1. + 1.5 * data_.contact.lambda * rate), 0.);
      const double slip_y = v_y - spinning * r * s, slip_z = v_z + spinning * r * c;
      const double slip_squared = slip_y * slip_y + slip_z * slip_z;
      const double per_slip = data_.friction.per_speed(slip_squared, in.ring_temperature) * normal;
      const double f_x = -shoulder.side * normal, f_y = per_slip * slip_y, f_z = per_slip * slip_z;
      const double torque = r * (c * f_z - s * f_y);
      add_force(sum.on_ring, face, r * c, r * s, f_x, f_y, f_z, torque);
      add_force(sum.on_rotor, face, r * c, r * s, -f_x, -f_y, -f_z, -torque);
      sum.shoulder += f_x;
      sum.shoulder_torque += torque;
      sum.rub_heat += f_y * slip_y + f_z * slip_z;
      sum.centres_power += f_y * v_y + f_z * v_z;
      sum.damping += (normal - elastic) * rate;
      sum.is_touching = true;
    }
  }
}

double TouchdownBearing::contact_energy(const SupportInput& in, const Expansion& growth,
                                        std::span<const double> y) const {
  const Motion& j = in.journal;
  const Bore bore = bore_of(data_);
  double U = 0.;
  for (const Slice& slice : bore.slices) {
    const Bodies at = bodies(j, y, slice.place * bore.width);
    U += slice.share *
         (arc_table_ ? arc_energy(in, growth, y, at) : data_.contact.energy(contact(in, growth, y, at).penetration));
  }
  if (data_.sticking)
    for (std::size_t k = 0; k < bore.slices.size(); ++k)
      U += bore.slices[k].share * data_.sticking->energy(bristle(y, k));
  if (!data_.free_ring) return U;
  const double r = data_.free_ring->shoulder_radius;
  for (const Shoulder& shoulder : data_.free_ring->shoulders)
    for (const auto& [c, s] : around) {
      const double approach = j.x - y[ring_x] + r * ((j.theta_y - y[tilt_y]) * s - (j.theta_z - y[tilt_z]) * c);
      const double penetration = std::max(-shoulder.side * approach - shoulder.gap, 0.);
      U += 0.5 * data_.free_ring->shoulder_stiffness / n_around * penetration * penetration;
    }
  return U;
}

}  // namespace rotordrop
