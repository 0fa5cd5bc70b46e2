#pragma once
// The motion of a touchdown bearing: rotor against bore, balls, torques and heat, of one drop or of eight in lanes. What runs in lanes are rigid rings that
// translate, in rolling balls, on any support, under regularised friction without tables
// (TouchdownBearing::runs_in_lanes); what is beyond that stands under `has_all`, and is called for one drop only.
#include <span>

#include "base/sine_cosine.h"
#include "bearing/row/ball_terms.h"
#include "bearing/touchdown_contact.h"

namespace rotordrop {

template <class Real>
BallRowInputOf<Real> TouchdownBearing::row_input(const TouchdownFormulas<Real>& q, const ExpansionOf<Real>& growth,
                                                 std::span<const Real> y) const {
  RingDisplacementOf<Real> displacement{0., y[ring_y] - y[support_y], y[ring_z] - y[support_z], 0., 0.};
  RingDisplacementOf<Real> rate{0., y[ring_vy] - y[support_vy], y[ring_vz] - y[support_vz], 0., 0.};
  Real cage_speed = q.cage_ratio * y[ring_spin];
  if constexpr (has_all<Real>) {
    if (data_.free_ring) {
      displacement.x = y[ring_x];
      displacement.psi_y = y[tilt_y];
      displacement.psi_z = y[tilt_z];
      rate.x = y[ring_vx];
      rate.psi_y = y[tilt_rate_y];
      rate.psi_z = y[tilt_rate_z];
    }
    if (data_.free_cage) cage_speed = y[free_cage_at()];
  }
  auto turned = sine_cosine(y[cage_angle]);
  return {.displacement = displacement,
          .rate = rate,
          .cage_angle = y[cage_angle],
          .cage_cosine = turned.cosine,
          .cage_sine = turned.sine,
          .cage_speed = cage_speed,
          .ring_angle = y[ring_angle],
          .ring_speed = y[ring_spin],
          .radial_growth = growth.inner_race - growth.outer_race,
          .row_difference = growth.row_difference,
          .ball_growth = growth.ball,
          .inner_strain = q.strain_per_growth * growth.inner_width,
          .outer_strain = q.strain_per_growth * growth.outer_width,
          .shape = {},
          .shape_rate = {},
          .shape_force = {}};
}

template <class Real, class Row>
TouchdownBearing::BallForcesOf<Real> TouchdownBearing::ball_forces(std::span<const Row> rows,
                                                                   const BallRowInputOf<Real>& in,
                                                                   bool with_tractions) const {
  BallForcesOf<Real> forces;
  BallSumsOf<Real> sum;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    auto& row = forces.row[i];
    RowTractionsOf<Real>* tractions = with_tractions ? &forces.tractions[i] : nullptr;
    if constexpr (has_all<Real>) {
      if (data_.free_ring)
        rows[i].evaluate(in, row, tractions);
      else
        rows[i].evaluate_translations(in, row, tractions);
    } else {
      rows[i].evaluate_translations(in, row, tractions);
    }
    sum.force_x += row.force_x;
    sum.moment_y += row.moment_y;
    sum.moment_z += row.moment_z;
    sum.force_y += row.force_y;
    sum.force_z += row.force_z;
    sum.damping_power += row.damping_power;
    sum.elastic_radial += row.elastic_radial;
    sum.by_row_difference += rows[i].numbers().difference_share * row.elastic_radial;
    sum.elastic_normal += row.elastic_normal;
    const auto by_strain = rows[i].numbers().strain_gradient(row);
    sum.by_inner_strain += by_strain.first;
    sum.by_outer_strain += by_strain.second;
    sum.cage_power += row.cage_torque * in.cage_speed;
    sum.waviness_power += row.waviness_power;
    sum.inertia_power += row.inertia_power;
    sum.inertia_per_speed += row.inertia_per_speed;
  }
  static_cast<BallSumsOf<Real>&>(forces) = sum;
  return forces;
}

template <class Real>
Real TouchdownBearing::load_torque_of(const TouchdownFormulas<Real>& q, const BallForcesOf<Real>& forces) const {
  if (data_.load_law == FrictionLoadLaw::radial) {
    const Real P = sqrt(forces.force_y * forces.force_y + forces.force_z * forces.force_z);
    return load_torque(FrictionLoadsOf<Real>{P, P}, q.f1_z, q.load_exponent, q.static_rating, q.pitch_diameter);
  }
  Real torque = 0.;
  for (std::size_t i = 0; i < rows_.size(); ++i) torque += row_load_torque(q, forces.row[i]);
  return torque;
}

template <class Real>
Real TouchdownBearing::row_load_torque(const TouchdownFormulas<Real>& q, const BallRowOutputOf<Real>& row) const {
  const Real radial = sqrt(row.force_y * row.force_y + row.force_z * row.force_z);
  return load_torque(q.friction_load_factors.loads(radial, abs(row.force_x)), q.f1_z, q.load_exponent,
                     q.static_rating / static_cast<double>(rows_.size()), q.pitch_diameter);
}

template <class Real>
BallConductancesOf<Real> TouchdownBearing::row_conduction(const TouchdownFormulas<Real>& q,
                                                          const BallRowOutputOf<Real>& row, const Real& ring_speed) {
  return q.conduction.of_row(row.inner_load_roots, row.inner_loads, row.outer_load_roots, row.outer_loads,
                             q.rolling_speed_ratio * abs(ring_speed));
}

template <class Real>
BallConductionOf<Real> TouchdownBearing::conduction(const TouchdownFormulas<Real>& q, const BallForcesOf<Real>& forces,
                                                    const Real& ring_speed) const {
  BallConductancesOf<Real> sum;
  for (std::size_t i = 0; i < rows_.size(); ++i) sum.add(row_conduction(q, forces.row[i], ring_speed));
  return {sum.inner_to_ball, sum.outer_to_ball, sum.inner_to_outer};
}

template <class Real, class Of>
void TouchdownBearing::evaluate_with(const Of& of, const SupportInputOf<Real>& in, std::span<const Real> y,
                                     std::span<Real> dydt, std::span<Real> ledger, SupportOutputOf<Real>& out) const {
  const TouchdownFormulas<Real>& q = of.numbers();
  auto rows = of.rows();
  const ExpansionOf<Real> grown = growth(q, in, y);
  BallRowInputOf<Real> rows_in = row_input(q, grown, y);
  ShapeForces shapes;
  std::span<Real> by_rotor;
  if constexpr (has_all<Real>)
    if (data_.bending) {
      fill_ball_shapes(y, shapes);
      by_rotor = {shapes.by_rotor.data(), data_.bending->n_inner()};
      lend_shapes(shapes, rows_in);
    }
  const BallForcesOf<Real> balls = ball_forces(rows, rows_in, !out.observed.empty());
  const Real ring_speed = y[ring_spin];
  const Real M_L = load_torque_of(q, balls);
  const Real M_v = drag_torque(q.drag_viscosity, ring_speed, q.pitch_diameter, q.f2);
  Real M_spin = 0.;
  if constexpr (has_all<Real>)
    if (data_.add_spin_heat) M_spin = spin_drag(rows_in);
  // eq. (20) of Neisi 2019, against the ring's spin in either direction
  const Real turning = tanh(ring_speed / q.drag_regularisation), M = (M_L + M_v + M_spin) * turning;

  // After the balls, whose sums and powers are waited for meanwhile.
  TouchOf<Real> t = touch(q, in, grown, y, dydt.subspan(bristles_at(), n_bristles()), by_rotor);
  const auto& on_rotor = t.on_rotor;
  out.force_on_rotor = {on_rotor.x, on_rotor.y, on_rotor.z, on_rotor.moment_y, on_rotor.moment_z, on_rotor.torque};

  dydt[ring_y] = y[ring_vy];
  dydt[ring_z] = y[ring_vz];
  dydt[ring_vy] = (t.on_ring.y + balls.force_y) / q.ring_mass + q.gravity_y;
  dydt[ring_vz] = (t.on_ring.z + balls.force_z) / q.ring_mass + q.gravity_z;
  dydt[ring_angle] = ring_speed;
  dydt[ring_spin] = (t.on_ring.torque - M) / q.ring_spin_inertia;
  dydt[support_y] = y[support_vy];
  dydt[support_z] = y[support_vz];
  SupportAnswerOf<Real> support;
  if (data_.support_law) {
    support = of.carried(y, dydt);
    dydt[support_vy] = (-balls.force_y + support.y) / q.support_mass;
    dydt[support_vz] = (-balls.force_z + support.z) / q.support_mass;
  } else {
    const Real damper_y = q.support_damping_y * y[support_vy], damper_z = q.support_damping_z * y[support_vz];
    dydt[support_vy] = (-balls.force_y - q.support_stiffness_y * y[support_y] - damper_y) / q.support_mass;
    dydt[support_vz] = (-balls.force_z - q.support_stiffness_z * y[support_z] - damper_z) / q.support_mass;
    support.loss = damper_y * y[support_vy] + damper_z * y[support_vz];
  }
  dydt[cage_angle] = rows_in.cage_speed;
  Real bending_loss = 0.;
  if constexpr (has_all<Real>) {
    if (data_.free_ring) tilt(balls, t.on_ring, y, dydt);
    if (data_.bending) bending_loss = bend(y, shapes, dydt);
  }

  out.heat.rub = t.rub_heat;
  // eq. (24), corrected: the race's share by its radius, times M omega_i, the work that the ring loses, times 1; or times omega_b / omega_i where the heat
  // is asked for as printed (internal_heat = "ball-speed").
  out.heat.inner = q.inner_heat_share * M * ring_speed * q.heat_over_work;
  out.heat.outer = (1. - q.inner_heat_share) * M * ring_speed * q.heat_over_work;
  out.heat.is_in_contact = t.is_touching;
  if (data_.conduction) out.heat.balls = conduction(q, balls, ring_speed);
  Real slip_loss = 0.;
  if constexpr (has_all<Real>) {
    if (!out.heat.rows.empty()) divide_among_rows(balls, rows_in, M_L, M_v, turning, ring_speed, out.heat.rows);
    if (data_.free_cage) slip_loss = turn_cage(balls, y, dydt, out.heat);
  }
  // The rubbing spot lies on the line of centres and turns with it.
  const Real spot_speed = q.bore_radius * t.middle.centres_turning;
  out.heat.rotor_surface_speed = in.rotor_spin.speed * q.rotor_radius - spot_speed;
  out.heat.ring_surface_speed = ring_speed * q.bore_radius - spot_speed;

  const Real inertia_work = balls.inertia_power + balls.inertia_per_speed * dydt[ring_spin];
  const Real wave_work = balls.waviness_power + t.wave_power;
  out.other_dissipation =
      t.damping + balls.damping_power + support.loss + bending_loss - (q.heat_over_work - 1.) * M * ring_speed;
  out.energy_gradient = {t.elastic,
                         -t.elastic,
                         balls.elastic_radial,
                         -balls.elastic_radial,
                         2. * balls.elastic_normal,
                         q.strain_per_growth * balls.by_inner_strain,
                         q.strain_per_growth * balls.by_outer_strain,
                         balls.by_row_difference};
  // The ring's speed makes it grow against its contacts; the spin's balance does not feel that.
  const Real centrifugal_work = out.energy_gradient.dot(q.centrifugal_growth) * 2. * ring_speed * dydt[ring_spin];
  const Real cage_work_rate = data_.free_cage ? Real(0.) : balls.cage_power;
  out.prescribed_work = cage_work_rate + wave_work + inertia_work + centrifugal_work;

  ledger[contact_impulse] = t.normal;
  ledger[contact_damping] = t.damping;
  ledger[ball_damping] = balls.damping_power;
  ledger[support_damping] = support.loss;
  ledger[waviness_work] = wave_work;
  ledger[cage_work] = cage_work_rate;
  ledger[inertia_of_balls] = inertia_work;
  // Friction in the bore has the rotor's radius on the rotor, that of shoulders the same on both.
  const Real bore_torque = t.on_ring.torque - t.shoulder_torque;
  ledger[spin_up_drive] = in.rotor_spin.speed * (bore_torque + t.shoulder_torque * q.bore_radius / q.rotor_radius);
  ledger[spin_up_centres] = t.centres_power;
  std::size_t optional_ledger = first_optional_ledger;
  if (data_.bending) ledger[optional_ledger++] = bending_loss;
  if (data_.free_cage) ledger[optional_ledger++] = slip_loss;

  if (!out.observed.empty()) {
    const ObservedTouchOf<Real> touch{t.middle.penetration, t.normal,   t.friction,         t.middle.slip_speed,
                                      t.on_ring.x,          t.shoulder, t.on_ring.moment_y, t.on_ring.moment_z};
    observe(q, rows, in, grown, y, touch, balls, M_L, M_v, dydt[ring_spin], out.heat, out.observed);
    if (data_.support_law) of.observe_support(support, y, out.observed.last(3));
  }
  if (!out.observed_details.empty()) observe_details(rows, rows_in, y, out.observed_details);
}

template <class Real, class Row>
void TouchdownBearing::observe_details(std::span<const Row> rows, const BallRowInputOf<Real>& rows_in,
                                       std::span<const Real> y, std::span<Real> out) const {
  const bool on_both_races = data_.ball_model == BallModel::inertial;
  std::size_t n_balls = 0, at = 0;
  for (const auto& row : rows) n_balls += row.n_balls();
  for (const auto& row : rows) {
    const std::size_t n = row.n_balls();
    row.ball_loads(rows_in, out.subspan(at, n), on_both_races ? out.subspan(n_balls + at, n) : std::span<Real>());
    at += n;
  }
  if (on_both_races) at += n_balls;
  for (std::size_t k = 0; k < n_shapes(); ++k) out[at + k] = y[shapes_at() + k];
}

template <class Real, class Of>
Real TouchdownBearing::energy_with(const Of& of, const SupportInputOf<Real>& in, std::span<const Real> y) const {
  const TouchdownFormulas<Real>& q = of.numbers();
  const auto square = [&](std::size_t i) { return y[i] * y[i]; };
  const ExpansionOf<Real> grown = growth(q, in, y);
  Real U = 0.5 * q.ring_mass * (square(ring_vy) + square(ring_vz)) + 0.5 * q.ring_spin_inertia * square(ring_spin) -
           q.ring_mass * (q.gravity_y * y[ring_y] + q.gravity_z * y[ring_z]);
  U += 0.5 * q.support_mass * (square(support_vy) + square(support_vz));
  if (data_.support_law)
    U += of.stored_in_support(y);
  else
    U += 0.5 * (q.support_stiffness_y * square(support_y) + q.support_stiffness_z * square(support_z));
  BallRowInputOf<Real> rows_in = row_input(q, grown, y);
  ShapeForces shapes;
  if constexpr (has_all<Real>) {
    if (data_.free_ring)
      U += 0.5 * q.ring_mass * square(ring_vx) - q.ring_mass * data_.free_ring->gravity_x * y[ring_x] +
           0.5 * data_.free_ring->diametral_inertia * (square(tilt_rate_y) + square(tilt_rate_z));
    if (data_.free_cage) U += data_.free_cage->energy(y[free_cage_at()], y[free_cage_at() + 1]);
    U += contact_energy(in, grown, y);
    if (data_.bending) {
      fill_ball_shapes(y, shapes);
      lend_shapes(shapes, rows_in);
      U += bending_energy(y);
    }
  } else {
    U += q.contact.energy(contact<false>(q, in, grown, y, bodies<false>(in.journal, y, 0.)).penetration);
  }
  for (const auto& row : of.rows()) U += row.energy(rows_in);
  return U;
}

template <class Real, class Row>
void TouchdownBearing::observe(const TouchdownFormulas<Real>& q, std::span<const Row> rows,
                               const SupportInputOf<Real>& in, const ExpansionOf<Real>& growth, std::span<const Real> y,
                               const ObservedTouchOf<Real>& touch, const BallForcesOf<Real>& balls,
                               const Real& load_torque, const Real& drag_torque, const Real& ring_acceleration,
                               const HeatInputOf<Real>& heat, std::span<Real> out) const {
  std::size_t at = 0;
  const auto put = [&](std::initializer_list<Real> values) {
    for (const Real& value : values) out[at++] = value;
  };
  put({in.journal.y, in.journal.z, in.journal.velocity_y, in.journal.velocity_z});
  put({y[ring_y], y[ring_z], y[ring_vy], y[ring_vz], y[support_y], y[support_z]});
  put({touch.penetration, q.air_gap + growth.bore - growth.shaft, touch.normal, touch.friction, touch.slip_speed});
  const Real rotor_surface = in.rotor_spin.speed * q.rotor_radius;
  put({select(rotor_surface != 0., 1. - y[ring_spin] * q.bore_radius / rotor_surface, Real(1.))});
  put({balls.force_y, balls.force_z});
  Real largest = 0.;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    put({balls.row[i].largest_load});
    largest = larger(largest, balls.row[i].largest_load);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& race = rows[i].numbers();
    put({larger(race.inner.largest_pressure(balls.row[i].largest_load),
                race.outer.largest_pressure(balls.row[i].largest_outer_load))});
  }
  const Real spin_torque =
      spin_moment(q.race_friction_coefficient, largest, q.spin_axis_factor * cbrt(largest), q.spin_elliptic_integral);
  put({y[ring_spin], y[cage_angle], load_torque, drag_torque, spin_torque, q.spin_speed_sum_ratio * y[ring_spin]});
  put({heat.rub, heat.inner, heat.outer});
  for (const Real& surface : growth_values(growth)) out[at++] = surface;
  Real towards_plus = 0., towards_minus = 0.;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Real axial = balls.row[i].force_x;
    put({axial});
    towards_plus += larger(axial, Real(0.));
    towards_minus += larger(-axial, Real(0.));
  }
  put({rows.size() > 1 ? smaller(towards_plus, towards_minus) : Real(0.)});
  put({balls.tractions[0].centrifugal});
  for (std::size_t i = 0; i < rows.size(); ++i) put({balls.tractions[i].truncation});
  const Real mu = q.race_friction_coefficient;
  const Real acceleration = 0.5 * q.pitch_diameter * q.cage_ratio * abs(ring_acceleration);
  for (std::size_t i = 0; i < rows.size(); ++i)
    put({rolling_demand(balls.tractions[i], rows_[i].geometry().n_balls, rows[i].numbers().ball_mass, acceleration,
                        mu)});
  for (std::size_t i = 0; i < rows.size(); ++i)
    put({traction_demand(balls.tractions[i].largest_gyroscopic_over_load, mu, Real(1.))});
  if constexpr (has_all<Real>) {
    if (data_.free_ring) {
      put({in.journal.x, y[ring_x], y[tilt_y], y[tilt_z], touch.axial, touch.shoulder});
      put({touch.moment_y, touch.moment_z});
    }
    if (data_.free_cage) put({y[free_cage_at()], q.cage_ratio * y[ring_spin], y[free_cage_at() + 1]});
  }
}

}  // namespace rotordrop
