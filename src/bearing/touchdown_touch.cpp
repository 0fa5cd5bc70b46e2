// Rotor against the inner ring: the bore, at its middle or in slices along its width, and shoulders of the rotor beside the ring's faces.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "bearing/touchdown_contact.h"

namespace rotordrop {
namespace {

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

/// How far a place of the rotor's shoulder has come towards the ring's face, or how fast it comes: the shoulder at +x closes when the rotor moves towards -x.
/// @param x, about_y, about_z  displacement and tilts of the rotor past the ring, or their rates; @param r  radius of the faces [m]
double towards_ring(const Shoulder& shoulder, double x, double about_y, double about_z, double r, const Direction& at) {
  return -shoulder.side * (x + r * (about_y * at.s - about_z * at.c));
}

}  // namespace

std::array<BoreSlice, n_bore_slices> bore_slices(double width) {
  const double outer = 0.5 * std::sqrt(0.6) * width;
  return {{{0., 4. / 9., 0}, {-outer, 5. / 18., 1}, {outer, 5. / 18., 2}}};
}

std::size_t TouchdownBearing::n_bristles() const {
  if (!data_.sticking) return 0;
  return data_.free_ring ? 2 * n_bore_slices : 1;
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

TouchdownBearing::Touch TouchdownBearing::touch_of_free_ring(const SupportInput& in, const Expansion& growth,
                                                             std::span<const double> y, std::span<double> bristle_rates,
                                                             std::span<double> shape_forces) const {
  Touch t;
  double deepest = -std::numeric_limits<double>::infinity();
  for (const BoreSlice& slice : bore_slices(data_.free_ring->contact_length)) {
    const Contact c = contact_in_slice<true>(numbers_, in, growth, y, slice, bristle_rates, shape_forces);
    t += touch_in_slice<true>(numbers_, c, slice);
    if (slice.x == 0.) t.middle = c;
    if (!(c.penetration <= deepest)) deepest = c.penetration;  // one that is not a number goes on
  }
  t.middle.penetration = deepest;  // a tilted journal touches at an end first
  touch_shoulders(in, y, t);
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
    for (const Direction& at : around) {
      const double penetration = towards_ring(shoulder, x, tilt_about_y, tilt_about_z, r, at) - shoulder.gap;
      if (penetration <= 0.) continue;
      const double rate = towards_ring(shoulder, v_x, rate_y, rate_z, r, at);
      const auto& [c, s] = at;
      const double elastic = ring.shoulder_stiffness / n_around * penetration;
      const double normal = std::max(elastic * (1. + 1.5 * data_.contact.lambda * rate), 0.);
      const double slip_y = v_y - spinning * r * s, slip_z = v_z + spinning * r * c;
      const double slip_squared = slip_y * slip_y + slip_z * slip_z;
      const double per_slip = data_.friction.per_speed(slip_squared, in.ring_temperature) * normal;
      const double f_x = -shoulder.side * normal, f_y = per_slip * slip_y, f_z = per_slip * slip_z;
      const double torque = r * (c * f_z - s * f_y);
      add_moments(sum.on_ring, face, r * c, r * s, f_x, f_y, f_z);
      add_moments(sum.on_rotor, face, r * c, r * s, -f_x, -f_y, -f_z);
      sum.on_ring += Force{.x = f_x, .y = f_y, .z = f_z, .torque = torque};
      sum.on_rotor += Force{.x = -f_x, .y = -f_y, .z = -f_z, .torque = -torque};
      sum.shoulder += f_x;
      sum.shoulder_torque += torque;
      sum.rub_heat += f_y * slip_y + f_z * slip_z;
      sum.centres_power += f_y * v_y + f_z * v_z;
      sum.damping += (normal - elastic) * rate;
      sum.is_touching = true;
    }
  }
}

double TouchdownBearing::overlap_with_shoulders(const Motion& j, std::span<const double> y) const {
  double overlap = -std::numeric_limits<double>::infinity();
  if (!data_.free_ring) return overlap;
  const double x = j.x - y[ring_x], about_y = j.theta_y - y[tilt_y], about_z = j.theta_z - y[tilt_z];
  for (const Shoulder& shoulder : data_.free_ring->shoulders)
    for (const Direction& at : around)
      overlap = std::max(
          overlap, towards_ring(shoulder, x, about_y, about_z, data_.free_ring->shoulder_radius, at) - shoulder.gap);
  return overlap;
}

double TouchdownBearing::energy_of_bristles(std::span<const double> y) const {
  if (!data_.sticking) return 0.;
  if (!data_.free_ring) return data_.sticking->energy(bristle(y, bore_middle.number));
  double U = 0.;
  for (const BoreSlice& slice : bore_slices(data_.free_ring->contact_length))
    U += slice.share * data_.sticking->energy(bristle(y, slice.number));
  return U;
}

double TouchdownBearing::contact_energy(const SupportInput& in, const Expansion& growth,
                                        std::span<const double> y) const {
  const Motion& j = in.journal;
  double U = 0.;
  const auto add = [&](const BoreSlice& slice, const Bodies& at) {
    U += slice.share * (arc_table_ ? arc_energy(growth, y, at)
                                   : data_.contact.energy(contact<true>(numbers_, in, growth, y, at).penetration));
  };
  if (data_.free_ring)
    for (const BoreSlice& slice : bore_slices(data_.free_ring->contact_length)) add(slice, bodies<true>(j, y, slice.x));
  else
    add(bore_middle, bodies<false>(j, y, 0.));
  U += energy_of_bristles(y);
  if (!data_.free_ring) return U;
  const double r = data_.free_ring->shoulder_radius;
  for (const Shoulder& shoulder : data_.free_ring->shoulders)
    for (const Direction& at : around) {
      const double approach =
          towards_ring(shoulder, j.x - y[ring_x], j.theta_y - y[tilt_y], j.theta_z - y[tilt_z], r, at);
      const double penetration = std::max(approach - shoulder.gap, 0.);
      U += 0.5 * data_.free_ring->shoulder_stiffness / n_around * penetration * penetration;
    }
  return U;
}

}  // namespace rotordrop
