// Rotor against an inner ring that tilts and moves along its axis: the bore in slices along its width, shoulders of the rotor beside its faces.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "bearing/touchdown_touch.h"

namespace rotordrop {
namespace {

struct Slice {
  double place = 0, share = 0;  // in widths from the middle; of the width
};
/// Gauss' three points: they integrate a pressure that changes linearly along the bore, and its moment, exactly.
const std::array<Slice, 3> slices = {
    {{0., 4. / 9.}, {-0.5 * std::sqrt(0.6), 5. / 18.}, {0.5 * std::sqrt(0.6), 5. / 18.}}};

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

/// A force at the point (x, y, z) from a body's centre.
void add_force(Force& to, double x, double y, double z, double f_x, double f_y, double f_z) {
  to.x += f_x;
  to.y += f_y;
  to.z += f_z;
  to.moment_y += z * f_x - x * f_z;
  to.moment_z += x * f_y - y * f_x;
  to.torque += y * f_z - z * f_y;
}

}  // namespace

TouchdownBearing::Touch TouchdownBearing::touch_free_ring(const SupportInput& in, const Expansion& growth,
                                                          std::span<const double> y) const {
  const Motion& j = in.journal;
  const double r_r = data_.rotor_radius, r_b = data_.bore_radius;
  // A point at x on the axis of a body with the tilts psi is displaced by psi x r = x (psi_z, -psi_y).
  const double slope_y = j.theta_z - y[tilt_z], slope_z = y[tilt_y] - j.theta_y;
  const double slope_rate_y = j.tilt_rate_z - y[tilt_rate_z], slope_rate_z = y[tilt_rate_y] - j.tilt_rate_y;
  Touch t;
  double deepest = -std::numeric_limits<double>::infinity();
  for (const Slice& slice : slices) {
    const double x = slice.place * data_.free_ring->width;
    const Bodies at{j.y - y[ring_y] + x * slope_y,
                    j.z - y[ring_z] + x * slope_z,
                    j.velocity_y - y[ring_vy] + x * slope_rate_y,
                    j.velocity_z - y[ring_vz] + x * slope_rate_z,
                    j.velocity_x - y[ring_vx],
                    r_r * j.tilt_rate_y - r_b * y[tilt_rate_y],
                    r_r * j.tilt_rate_z - r_b * y[tilt_rate_z]};
    const Contact c = contact(in, growth, y, at);
    if (slice.place == 0.) t.middle = c;
    deepest = std::max(deepest, c.penetration);
    const double normal = slice.share * c.normal, friction = slice.share * c.friction;
    const double f_x = slice.share * c.friction_x;
    const double f_y = normal * c.n_y - friction * c.n_z, f_z = normal * c.n_z + friction * c.n_y;
    add_force(t.on_ring, x, r_b * c.n_y, r_b * c.n_z, f_x, f_y, f_z);
    add_force(t.on_rotor, x, r_r * c.n_y, r_r * c.n_z, -f_x, -f_y, -f_z);
    t.elastic += slice.share * c.elastic;
    t.normal += normal;
    t.friction += friction;
    t.rub_heat += friction * c.slip_speed + f_x * c.slip_x;
    t.damping += slice.share * (c.normal - c.elastic) * c.rate;
    t.wave_power += slice.share * c.elastic * c.wave_rate;
    t.centres_power += friction * c.tangential_speed + f_x * c.slip_x;
    t.is_touching |= c.penetration > 0.;
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
    for (const auto& [c, s] : around) {
      // The shoulder at +x closes when the rotor moves towards -x.
      const double penetration = -shoulder.side * (x + r * (tilt_about_y * s - tilt_about_z * c)) - shoulder.gap;
      if (penetration <= 0.) continue;
      const double rate = -shoulder.side * (v_x + r * (rate_y * s - rate_z * c));
      const double elastic = ring.shoulder_stiffness / n_around * penetration;
      const double normal = std::max(elastic * (1. + 1.5 * data_.contact.lambda * rate), 0.);
      const double slip_y = v_y - spinning * r * s, slip_z = v_z + spinning * r * c;
      const double per_slip = data_.friction.per_speed(slip_y * slip_y + slip_z * slip_z) * normal;
      const double f_x = -shoulder.side * normal, f_y = per_slip * slip_y, f_z = per_slip * slip_z;
      add_force(sum.on_ring, face, r * c, r * s, f_x, f_y, f_z);
      add_force(sum.on_rotor, face, r * c, r * s, -f_x, -f_y, -f_z);
      sum.shoulder += f_x;
      sum.shoulder_torque += r * (c * f_z - s * f_y);
      sum.rub_heat += f_y * slip_y + f_z * slip_z;
      sum.centres_power += f_y * v_y + f_z * v_z;
      sum.damping += (normal - elastic) * rate;
      sum.is_touching = true;
    }
  }
}

double TouchdownBearing::contact_energy(const SupportInput& in, const Expansion& growth,
                                        std::span<const double> y) const {
  if (!data_.free_ring) return data_.contact.energy(touch(in, growth, y).middle.penetration);
  const Motion& j = in.journal;
  double U = 0.;
  for (const Slice& slice : slices) {
    const double x = slice.place * data_.free_ring->width;
    const Bodies at{.y = j.y - y[ring_y] + x * (j.theta_z - y[tilt_z]),
                    .z = j.z - y[ring_z] - x * (j.theta_y - y[tilt_y])};
    U += slice.share * data_.contact.energy(contact(in, growth, y, at).penetration);
  }
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
