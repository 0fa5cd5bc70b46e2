#include "bearing/touchdown_data.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bearing/cage_parameters.h"
#include "bearing/contact_stiffness.h"
#include "bearing/ring_bending_parameters.h"
#include "laws/ball_kinematics.h"
#include "laws/shoulder_contact.h"

namespace rotordrop {

ShoulderCompliance shoulder_compliance(const TouchdownParameters& b, const TouchdownSurroundings& around) {
  const double r_1 = 0.5 * b.inner_ring_diameters[0], r_2 = 0.5 * b.inner_ring_diameters[1],
               middle = b.shoulders.radius.value_or(0.5 * (r_1 + r_2)), height = std::min(middle - r_1, r_2 - middle);
  // A shoulder at the -x face pushes the ring onto the rows that lean to +x; the other side is its mirror.
  double length = 0.;
  int n = 0;
  for (const auto& row : row_places(b))
    if (row.direction > 0.) {
      length += 0.5 * b.width + row.position;
      ++n;
    }
  return {annulus_compliance(middle - height, middle + height, around.rotor()),
          sleeve_compliance(r_1, r_2, length / n, around.ring)};
}

double shoulder_stiffness(const TouchdownParameters& b, const TouchdownSurroundings& around) {
  return b.shoulders.stiffness ? *b.shoulders.stiffness : shoulder_compliance(b, around).stiffness();
}

namespace {

/// @param contact_length  along the axis
FreeRing free_ring_data(const TouchdownParameters& b, const TouchdownSurroundings& around, double contact_length) {
  const double r_1 = 0.5 * b.inner_ring_diameters[0], r_2 = 0.5 * b.inner_ring_diameters[1];
  const double radii = b.ring_mass * (r_1 * r_1 + r_2 * r_2);
  FreeRing ring;
  ring.polar_inertia = radii / 2.;
  ring.diametral_inertia = b.ring_diametral_inertia.value_or(radii / 4. + b.ring_mass * b.width * b.width / 12.);
  ring.gravity_x = around.gravity[0];
  ring.width = b.width;
  ring.contact_length = contact_length;
  if (b.shoulders.gap_minus_x) ring.shoulders.push_back({-1., *b.shoulders.gap_minus_x});
  if (b.shoulders.gap_plus_x) ring.shoulders.push_back({1., *b.shoulders.gap_plus_x});
  ring.shoulder_radius = b.shoulders.radius.value_or(0.5 * (r_1 + r_2));
  ring.shoulder_stiffness = shoulder_stiffness(b, around);
  return ring;
}

}  // namespace

TouchdownBearingData touchdown_data(const std::string& name, const TouchdownParameters& b,
                                    const ContactParameters& contact, const TouchdownSurroundings& around) {
  const double modulus = effective_modulus(around.ring, around.ball);
  const double projected = 0.5 * b.ball_diameter * std::cos(b.contact_angle);
  const auto inner = inner_race_contact(b.ball_diameter, 0.5 * b.pitch_diameter - projected, b.conformity[0]);
  const auto outer = outer_race_contact(b.ball_diameter, 0.5 * b.pitch_diameter + projected, b.conformity[1]);

  BallRowGeometry row;
  row.n_balls = b.balls_per_row;
  row.ball_diameter = b.ball_diameter;
  row.pitch_diameter = b.pitch_diameter;
  row.inner_conformity = b.conformity[0];
  row.outer_conformity = b.conformity[1];
  row.contact_angle = b.contact_angle;
  row.radial_clearance = b.radial_clearance;
  row.damping_beta = b.ball_damping_beta;
  // The groove's circle has its centre at d_m/2 +- (f - 1/2) d cos phi_0 from the axis and reaches the shoulder's radius at the edge's angle.
  const auto race = [&](const ContactGeometry& geometry, double side, double conformity, double shoulder_diameter) {
    RaceContact made{hertz_stiffness(geometry, modulus, b.elliptic_integrals),
                     semi_major_axis_factor(geometry, modulus, b.elliptic_integrals),
                     contact_ellipse(geometry, b.elliptic_integrals).k};
    made.groove_radius = conformity * b.ball_diameter;
    const double centre =
        0.5 * b.pitch_diameter - side * (conformity - 0.5) * b.ball_diameter * std::cos(b.contact_angle);
    made.edge_cosine = std::clamp(side * (0.5 * shoulder_diameter - centre) / made.groove_radius, -1., 1.);
    made.edge_sine = std::sqrt(1. - made.edge_cosine * made.edge_cosine);
    return made;
  };
  row.inner = race(inner, -1., b.conformity[0], b.inner_shoulder_diameter.value_or(b.inner_ring_diameters[1]));
  row.outer = race(outer, 1., b.conformity[1], b.outer_shoulder_diameter.value_or(b.outer_ring_diameters[0]));
  row.stiffness = stiffness_in_series(row.inner.stiffness, row.outer.stiffness);
  row.ball_mass = around.ball_density * std::numbers::pi / 6. * std::pow(b.ball_diameter, 3);
  row.has_inertia = b.ball_model == BallModel::inertial;
  row.inner_gyroscopic_share = b.gyroscopic_split == GyroscopicSplit::equal ? 0.5 : 0.;
  row.preload_offset = b.preload > 0. ? BallRow::offset_for_axial_load(row, b.preload) : 0.;

  TouchdownBearingData d;
  d.name = name;
  const auto places = row_places(b);
  for (int i = 0; i < b.rows; ++i) {
    row.position = places[static_cast<std::size_t>(i)].position;
    row.difference_share = places[static_cast<std::size_t>(i)].difference_share;
    row.direction = places[static_cast<std::size_t>(i)].direction;
    row.phase = i * b.row_phase * 2. * std::numbers::pi / b.balls_per_row;
    d.rows.push_back(row);
  }
  d.cage_angle = b.cage_phase * 2. * std::numbers::pi / b.balls_per_row;
  for (const auto& w : b.waviness) {
    if (w.surface == WavySurface::bore)
      d.bore_waves.push_back({w.order, w.amplitude, w.phase});
    else
      d.race_waves.push_back({w.surface == WavySurface::inner_race, w.order, w.amplitude, w.phase});
  }
  d.ball_model = b.ball_model;
  d.ring_mass = b.ring_mass;
  d.width = b.width;
  d.ring_spin_inertia = b.ring_spin_inertia;
  d.bore_radius = bore_radius(b, contact);
  d.air_gap = air_gap(b, contact);
  d.rotor_radius = d.bore_radius - d.air_gap;
  const ContactStiffness bodies = contact_stiffness(b, contact, around);
  d.contact = {bodies.value, contact.exponent, contact.lambda};
  d.friction = {contact.friction_coefficient, contact.regularisation_speed,
                contact.static_friction_coefficient.value_or(0.), contact.stribeck_speed,
                contact.static_friction_coefficient.has_value()};
  if (contact.friction_over_speed) d.friction.over_speed = *contact.friction_over_speed;
  if (contact.friction_over_temperature) d.friction.over_temperature = *contact.friction_over_temperature;
  d.friction.has_tables = contact.friction_over_speed || contact.friction_over_temperature;
  const auto standard = around.has_axial_motion ? FrictionLaw::sticking : FrictionLaw::regularised;
  if ((contact.friction_law == FrictionLaw::automatic ? standard : contact.friction_law) == FrictionLaw::sticking)
    d.sticking = StickingFriction{contact.tangential_stiffness, contact.contact_length};
  d.f1_z = b.f1_z;
  d.f1_y = b.f1_y;
  d.static_rating = b.C0;
  d.f2 = b.f2;
  d.drag_viscosity = b.drag_viscosity;
  d.drag_regularisation = b.drag_regularisation;
  d.load_law = b.load_law;
  d.race_friction_coefficient = b.race_friction_coefficient.value_or(contact.friction_coefficient);
  d.spin_axis_factor = semi_major_axis_factor(inner, modulus, b.elliptic_integrals);
  d.spin_elliptic_integral = contact_ellipse(inner, b.elliptic_integrals).E;
  d.add_spin_heat = b.internal_heat == InternalHeat::with_spin;
  if (b.internal_heat == InternalHeat::ball_speed) {
    const auto& g = d.rows.front();
    d.heat_over_work = ball_spin_ratio(g.ball_diameter, g.pitch_diameter, g.contact_angle);
  }
  d.support_mass = b.support.mass;
  d.support_law = support_law(b.support, support_surroundings(b));
  d.support_stiffness_y = b.support.K_y.value_or(0.);
  d.support_stiffness_z = b.support.K_z.value_or(0.);
  d.support_damping_y = b.support.C_y.value_or(0.);
  d.support_damping_z = b.support.C_z.value_or(0.);
  d.gravity_y = around.gravity[1];
  d.gravity_z = around.gravity[2];
  d.bending = bent_rings(b, d, around);
  set_free_cage(b, d);
  if (b.ring_motion == RingMotion::free) d.free_ring = free_ring_data(b, around, bodies.length);
  return d;
}

}  // namespace rotordrop
