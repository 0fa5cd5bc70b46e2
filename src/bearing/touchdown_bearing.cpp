#include "bearing/touchdown_bearing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/sine_cosine.h"
#include "bearing/statics/ring_equilibrium.h"
#include "bearing/statics/steady_friction.h"
#include "bearing/touchdown_touch.h"
#include "laws/ball_kinematics.h"

namespace rotordrop {

TouchdownBearing::TouchdownBearing(TouchdownBearingData data) : data_(std::move(data)) {
  for (auto& geometry : data_.rows) geometry.conducts = data_.conduction.has_value();
  if (data_.bending)
    for (auto& geometry : data_.rows) geometry.highest_harmonic = data_.bending->inner.back().n;
  if (data_.bending) shape_motions_ = shape_motions();
  if (data_.bending && data_.bending->model == RingBendingModel::arc) arc_table_ = make_arc_table();
  for (const auto& geometry : data_.rows) rows_.emplace_back(geometry, data_.race_waves);
  const auto& g = data_.rows.front();
  if (data_.support_law) n_support_states_ = data_.support_law->n_states();
  strain_per_growth_ = data_.width > 0. ? 1. / data_.width : 0.;
  cage_ratio_ = cage_speed_ratio(g.ball_diameter, g.pitch_diameter, g.contact_angle);
  rolling_speed_ratio_ = 0.5 * g.ball_diameter * ball_spin_ratio(g.ball_diameter, g.pitch_diameter, g.contact_angle);
  inner_heat_share_ = inner_heat_share(data_);
  friction_load_factors_ = friction_load_factors(g.contact_angle);
  const double theta = pitch_angle_outer_race_control(g.contact_angle, g.ball_diameter, g.pitch_diameter);
  const auto spin = spin_speeds(1., g.contact_angle, g.contact_angle, theta, g.ball_diameter, g.pitch_diameter);
  spin_speed_sum_ratio_ = std::fabs(spin.inner) + std::fabs(spin.outer);
}

void TouchdownBearing::initial_state(std::span<double> y) const {
  std::fill(y.begin(), y.end(), 0.);
  const Force weight{data_.free_ring ? data_.ring_mass * data_.free_ring->gravity_x : 0.,
                     data_.ring_mass * data_.gravity_y, data_.ring_mass * data_.gravity_z};
  const auto place = ring_equilibrium(rows_, weight, data_.free_ring.has_value(), data_.cage_angle);
  y[cage_angle] = data_.cage_angle;
  if (data_.support_law) {
    const SupportPlace rest = resting_place(*data_.support_law, weight.y, weight.z);
    y[support_y] = rest.y;
    y[support_z] = rest.z;
    data_.support_law->settle(rest.y, rest.z, y.subspan(support_states_at(), n_support_states_));
  } else {
    y[support_y] = weight.y / data_.support_stiffness_y;
    y[support_z] = weight.z / data_.support_stiffness_z;
  }
  y[ring_y] = place.y + y[support_y];
  y[ring_z] = place.z + y[support_z];
  if (!data_.free_ring) return;
  y[ring_x] = place.x;
  y[tilt_y] = place.psi_y;
  y[tilt_z] = place.psi_z;
}

Expansion TouchdownBearing::growth(const SupportInput& in, std::span<const double> y) const {
  return combined(1., in.growth, y[ring_spin] * y[ring_spin], data_.centrifugal_growth);
}

SupportMotion TouchdownBearing::support_motion(std::span<const double> y) const {
  return {y[support_y], y[support_z], y[support_vy], y[support_vz]};
}

SupportAnswer TouchdownBearing::carried(std::span<const double> y, std::span<double> dydt) const {
  return data_.support_law->evaluate(support_motion(y), y.subspan(support_states_at(), n_support_states_),
                                     dydt.subspan(support_states_at(), n_support_states_));
}

BallRowInput TouchdownBearing::row_input(const Expansion& growth, std::span<const double> y) const {
  BallRowInput in;
  in.displacement.y = y[ring_y] - y[support_y];
  in.displacement.z = y[ring_z] - y[support_z];
  in.rate.y = y[ring_vy] - y[support_vy];
  in.rate.z = y[ring_vz] - y[support_vz];
  if (data_.free_ring) {
    in.displacement.x = y[ring_x];
    in.displacement.psi_y = y[tilt_y];
    in.displacement.psi_z = y[tilt_z];
    in.rate.x = y[ring_vx];
    in.rate.psi_y = y[tilt_rate_y];
    in.rate.psi_z = y[tilt_rate_z];
  }
  in.cage_angle = y[cage_angle];
  const auto [sine, cosine] = sine_cosine(in.cage_angle);
  in.cage_cosine = cosine;
  in.cage_sine = sine;
  in.cage_speed = cage_speed(y);
  in.ring_angle = y[ring_angle];
  in.ring_speed = y[ring_spin];
  in.radial_growth = growth.inner_race - growth.outer_race;
  in.row_difference = growth.row_difference;
  in.ball_growth = growth.ball;
  in.inner_strain = strain_per_growth_ * growth.inner_width;
  in.outer_strain = strain_per_growth_ * growth.outer_width;
  return in;
}

TouchdownBearing::BallForces TouchdownBearing::ball_forces(const BallRowInput& in, bool with_tractions) const {
  BallForces sum;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    auto& row = sum.row[i];
    RowTractions* tractions = with_tractions ? &sum.tractions[i] : nullptr;
    if (data_.free_ring)
      rows_[i].evaluate(in, row, tractions);
    else
      rows_[i].evaluate_translations(in, row, tractions);
    sum.force_x += row.force_x;
    sum.moment_y += row.moment_y;
    sum.moment_z += row.moment_z;
    sum.force_y += row.force_y;
    sum.force_z += row.force_z;
    sum.damping_power += row.damping_power;
    sum.elastic_radial += row.elastic_radial;
    sum.by_row_difference += rows_[i].geometry().difference_share * row.elastic_radial;
    sum.elastic_normal += row.elastic_normal;
    const auto [by_inner, by_outer] = rows_[i].strain_gradient(row);
    sum.by_inner_strain += by_inner;
    sum.by_outer_strain += by_outer;
    sum.cage_power += row.cage_torque * in.cage_speed;
    sum.waviness_power += row.waviness_power;
    sum.inertia_power += row.inertia_power;
    sum.inertia_per_speed += row.inertia_per_speed;
  }
  return sum;
}

double TouchdownBearing::load_torque_of(const BallForces& forces) const {
  const double d_m = data_.rows.front().pitch_diameter;
  if (data_.load_law == FrictionLoadLaw::radial) {
    const double P = std::sqrt(forces.force_y * forces.force_y + forces.force_z * forces.force_z);
    return load_torque({P, P}, data_.f1_z, data_.f1_y, data_.static_rating, d_m);
  }
  double torque = 0.;
  for (std::size_t i = 0; i < rows_.size(); ++i) torque += row_load_torque(forces.row[i]);
  return torque;
}

double TouchdownBearing::row_load_torque(const BallRowOutput& row) const {
  const double radial = std::hypot(row.force_y, row.force_z);
  const FrictionLoads loads = friction_load_factors_.loads(radial, std::fabs(row.force_x));
  return load_torque(loads, data_.f1_z, data_.f1_y, data_.static_rating / static_cast<double>(rows_.size()),
                     data_.rows.front().pitch_diameter);
}

// Torque on the ring that supplies the spin moments of a row's balls: sum M_s (|omega_si| + |omega_so|) / omega_i.
double TouchdownBearing::row_spin_drag(const BallRow& row, const BallRowInput& in) const {
  std::array<double, BallRow::max_balls> load;
  double sum = 0.;
  const auto n = static_cast<std::size_t>(row.geometry().n_balls);
  row.ball_loads(in, {load.data(), n});
  for (std::size_t j = 0; j < n; ++j)
    sum += spin_moment(data_.race_friction_coefficient, load[j], data_.spin_axis_factor * std::cbrt(load[j]),
                       data_.spin_elliptic_integral);
  return sum * spin_speed_sum_ratio_;
}

double TouchdownBearing::spin_drag(const BallRowInput& in) const {
  double sum = 0.;
  for (const auto& row : rows_) sum += row_spin_drag(row, in);
  return sum;
}

// Drag, and a load torque by the resultant of all rows, know no rows: each takes an equal part.
void TouchdownBearing::divide_among_rows(const BallForces& forces, const BallRowInput& in, double M_L, double M_v,
                                         double turning, double ring_speed, std::span<RowHeat> out) const {
  const auto n = static_cast<double>(rows_.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double own = data_.load_law == FrictionLoadLaw::equivalent ? row_load_torque(forces.row[i]) : M_L / n;
    const double spin = data_.add_spin_heat ? row_spin_drag(rows_[i], in) : 0.;
    const double heat = (own + M_v / n + spin) * turning * ring_speed * data_.heat_over_work;
    out[i].inner = inner_heat_share_ * heat;
    out[i].outer = (1. - inner_heat_share_) * heat;
    if (!data_.conduction) continue;
    const BallConductances G = row_conduction(forces.row[i], ring_speed);
    out[i].balls = {G.inner_to_ball, G.outer_to_ball, G.inner_to_outer};
  }
}

BallConductances TouchdownBearing::row_conduction(const BallRowOutput& row, double ring_speed) const {
  return data_.conduction->of_row(row.inner_load_roots, row.inner_loads, row.outer_load_roots, row.outer_loads,
                                  rolling_speed_ratio_ * std::fabs(ring_speed));
}

BallConduction TouchdownBearing::conduction(const BallForces& forces, double ring_speed) const {
  BallConductances sum;
  for (std::size_t i = 0; i < rows_.size(); ++i) sum.add(row_conduction(forces.row[i], ring_speed));
  return {sum.inner_to_ball, sum.outer_to_ball, sum.inner_to_outer};
}

void TouchdownBearing::evaluate(const SupportInput& in, std::span<const double> y, std::span<double> dydt,
                                std::span<double> ledger, SupportOutput& out) const {
  const Expansion grown = growth(in, y);
  ShapeForces shapes;
  std::span<double> by_rotor;
  BallRowInput rows_in = row_input(grown, y);
  if (data_.bending) {
    fill_ball_shapes(y, shapes);
    by_rotor = {shapes.by_rotor.data(), data_.bending->n_inner()};
    lend_shapes(shapes, rows_in);
  }
  const Touch t = touch(in, grown, y, dydt.subspan(bristles_at(), n_bristles()), by_rotor);
  const BallForces balls = ball_forces(rows_in, !out.observed.empty());
  out.force_on_rotor = t.on_rotor;

  const double ring_speed = y[ring_spin];
  const double M_L = load_torque_of(balls);
  const double M_spin = data_.add_spin_heat ? spin_drag(rows_in) : 0.;
  const double M_v = drag_torque(data_.drag_viscosity, ring_speed, data_.rows.front().pitch_diameter, data_.f2);
  const double turning = std::tanh(ring_speed / data_.drag_regularisation), M = (M_L + M_v + M_spin) * turning;

  dydt[ring_y] = y[ring_vy];
  dydt[ring_z] = y[ring_vz];
  dydt[ring_vy] = (t.on_ring.y + balls.force_y) / data_.ring_mass + data_.gravity_y;
  dydt[ring_vz] = (t.on_ring.z + balls.force_z) / data_.ring_mass + data_.gravity_z;
  dydt[ring_angle] = ring_speed;
  dydt[ring_spin] = (t.on_ring.torque - M) / data_.ring_spin_inertia;
  dydt[support_y] = y[support_vy];
  dydt[support_z] = y[support_vz];
  SupportAnswer support;
  if (data_.support_law) {
    support = carried(y, dydt);
    dydt[support_vy] = (-balls.force_y + support.y) / data_.support_mass;
    dydt[support_vz] = (-balls.force_z + support.z) / data_.support_mass;
  } else {
    const double damper_y = data_.support_damping_y * y[support_vy], damper_z = data_.support_damping_z * y[support_vz];
    dydt[support_vy] = (-balls.force_y - data_.support_stiffness_y * y[support_y] - damper_y) / data_.support_mass;
    dydt[support_vz] = (-balls.force_z - data_.support_stiffness_z * y[support_z] - damper_z) / data_.support_mass;
    support.loss = damper_y * y[support_vy] + damper_z * y[support_vz];
  }
  dydt[cage_angle] = rows_in.cage_speed;
  if (data_.free_ring) {
    // The angular momentum of a tilted spinning ring has the parts I_p omega (psi_z, -psi_y) along y and z.
    const FreeRing& ring = *data_.free_ring;
    const double gyroscopic = ring.polar_inertia * ring_speed;
    dydt[ring_x] = y[ring_vx];
    dydt[ring_vx] = (t.on_ring.x + balls.force_x) / data_.ring_mass + ring.gravity_x;
    dydt[tilt_y] = y[tilt_rate_y];
    dydt[tilt_z] = y[tilt_rate_z];
    dydt[tilt_rate_y] = (t.on_ring.moment_y + balls.moment_y - gyroscopic * y[tilt_rate_z]) / ring.diametral_inertia;
    dydt[tilt_rate_z] = (t.on_ring.moment_z + balls.moment_z + gyroscopic * y[tilt_rate_y]) / ring.diametral_inertia;
  }

  const double bending_loss = data_.bending ? bend(y, shapes, dydt) : 0.;

  out.heat.rub = t.rub_heat;
  out.heat.inner = inner_heat_share_ * M * ring_speed * data_.heat_over_work;
  out.heat.outer = (1. - inner_heat_share_) * M * ring_speed * data_.heat_over_work;
  out.heat.is_in_contact = t.is_touching;
  if (data_.conduction) out.heat.balls = conduction(balls, ring_speed);
  if (!out.heat.rows.empty()) divide_among_rows(balls, rows_in, M_L, M_v, turning, ring_speed, out.heat.rows);
  const double slip_loss = data_.free_cage ? turn_cage(balls, y, dydt, out.heat) : 0.;
  // The rubbing spot lies on the line of centres and turns with it.
  const double spot_speed = data_.bore_radius * t.middle.centres_turning;
  out.heat.rotor_surface_speed = in.rotor_spin.speed * data_.rotor_radius - spot_speed;
  out.heat.ring_surface_speed = ring_speed * data_.bore_radius - spot_speed;

  const double inertia_work = balls.inertia_power + balls.inertia_per_speed * dydt[ring_spin];
  const double wave_work = balls.waviness_power + t.wave_power;
  out.other_dissipation =
      t.damping + balls.damping_power + support.loss + bending_loss - (data_.heat_over_work - 1.) * M * ring_speed;
  out.energy_gradient = {t.elastic,
                         -t.elastic,
                         balls.elastic_radial,
                         -balls.elastic_radial,
                         2. * balls.elastic_normal,
                         strain_per_growth_ * balls.by_inner_strain,
                         strain_per_growth_ * balls.by_outer_strain,
                         balls.by_row_difference};
  // The ring's speed makes it grow against its contacts; the spin's balance does not feel that.
  const double centrifugal_work = out.energy_gradient.dot(data_.centrifugal_growth) * 2. * ring_speed * dydt[ring_spin];
  const double cage_work_rate = data_.free_cage ? 0. : balls.cage_power;
  out.prescribed_work = cage_work_rate + wave_work + inertia_work + centrifugal_work;

  ledger[contact_impulse] = t.normal;
  ledger[contact_damping] = t.damping;
  ledger[ball_damping] = balls.damping_power;
  ledger[support_damping] = support.loss;
  ledger[waviness_work] = wave_work;
  ledger[cage_work] = cage_work_rate;
  ledger[inertia_of_balls] = inertia_work;
  // Friction in the bore has the rotor's radius on the rotor, that of shoulders the same on both.
  const double bore_torque = t.on_ring.torque - t.shoulder_torque;
  ledger[spin_up_drive] =
      in.rotor_spin.speed * (bore_torque + t.shoulder_torque * data_.bore_radius / data_.rotor_radius);
  ledger[spin_up_centres] = t.centres_power;
  std::size_t optional_ledger = first_optional_ledger;
  if (data_.bending) ledger[optional_ledger++] = bending_loss;
  if (data_.free_cage) ledger[optional_ledger++] = slip_loss;

  if (!out.observed.empty()) {
    observe(in, grown, y, t, balls, M_L, M_v, dydt[ring_spin], out.heat, out.observed);
    if (data_.support_law) {
      const std::size_t at = out.observed.size() - 3;
      out.observed[at] = support.y;
      out.observed[at + 1] = support.z;
      out.observed[at + 2] =
          data_.support_law->energy(support_motion(y), y.subspan(support_states_at(), n_support_states_));
    }
  }
  if (!out.observed_details.empty()) {
    std::size_t at = 0;
    for (const auto& row : rows_) {
      const auto n = static_cast<std::size_t>(row.geometry().n_balls);
      row.ball_loads(rows_in, out.observed_details.subspan(at, n));
      at += n;
    }
    for (std::size_t k = 0; k < n_shapes(); ++k) out.observed_details[at + k] = y[shapes_at() + k];
  }
}

double TouchdownBearing::turn_cage(const BallForces& balls, std::span<const double> y, std::span<double> dydt,
                                   HeatInput& heat) const {
  CageDrive drive{.ring_speed = y[ring_spin], .cage_speed = y[free_cage_at()], .ball_spin = y[free_cage_at() + 1]};
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto& row = balls.row[i];
    drive.loads += row.inner_loads;
    drive.largest_load = std::max(drive.largest_load, row.largest_load);
    drive.contact_torque -= row.cage_torque;
  }
  const CageMotion m = cage_motion(*data_.free_cage, drive);
  dydt[ring_spin] += m.ring_torque / data_.ring_spin_inertia;
  dydt[free_cage_at()] = m.cage_acceleration;
  dydt[free_cage_at() + 1] = m.ball_acceleration;
  const double inner = m.inner_heat + 0.5 * m.pocket_heat, outer = m.outer_heat + 0.5 * m.pocket_heat;
  heat.inner += inner;
  heat.outer += outer;
  for (auto& row : heat.rows) {
    row.inner += inner / static_cast<double>(heat.rows.size());
    row.outer += outer / static_cast<double>(heat.rows.size());
  }
  return inner + outer;
}

double TouchdownBearing::energy(const SupportInput& in, std::span<const double> y) const {
  const auto& d = data_;
  const auto square = [&](std::size_t i) { return y[i] * y[i]; };
  const Expansion grown = growth(in, y);
  double U = 0.5 * d.ring_mass * (square(ring_vy) + square(ring_vz)) + 0.5 * d.ring_spin_inertia * square(ring_spin) -
             d.ring_mass * (d.gravity_y * y[ring_y] + d.gravity_z * y[ring_z]);
  U += 0.5 * d.support_mass * (square(support_vy) + square(support_vz));
  U += d.support_law ? d.support_law->energy(support_motion(y), y.subspan(support_states_at(), n_support_states_))
                     : 0.5 * (d.support_stiffness_y * square(support_y) + d.support_stiffness_z * square(support_z));
  if (d.free_ring)
    U += 0.5 * d.ring_mass * square(ring_vx) - d.ring_mass * d.free_ring->gravity_x * y[ring_x] +
         0.5 * d.free_ring->diametral_inertia * (square(tilt_rate_y) + square(tilt_rate_z));
  if (d.free_cage) U += d.free_cage->energy(y[free_cage_at()], y[free_cage_at() + 1]);
  U += contact_energy(in, grown, y);
  BallRowInput rows_in = row_input(grown, y);
  ShapeForces shapes;
  if (d.bending) {
    fill_ball_shapes(y, shapes);
    lend_shapes(shapes, rows_in);
    U += bending_energy(y);
  }
  for (const auto& row : rows_) U += row.energy(rows_in);
  return U;
}

}  // namespace rotordrop
