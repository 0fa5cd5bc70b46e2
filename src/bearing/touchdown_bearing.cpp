#include "bearing/touchdown_bearing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bearing/statics/ring_equilibrium.h"
#include "bearing/statics/steady_friction.h"
#include "bearing/touchdown_touch.h"
#include "laws/ball_kinematics.h"
#include "laws/skidding.h"

namespace rotordrop {

struct TouchdownBearing::BallForces {
  BallForces() {}  // leaves the rows unwritten: only those that exist are
  std::array<BallRowOutput, max_rows> row;
  std::array<RowTractions, max_rows> tractions;  // when asked for
  double force_x = 0, force_y = 0, force_z = 0, moment_y = 0, moment_z = 0;
  double damping_power = 0, elastic_radial = 0, elastic_normal = 0, cage_power = 0, waviness_power = 0;
  double by_inner_strain = 0, by_outer_strain = 0;  // dU/d(strain) [J]
  double by_row_difference = 0;                     // dU/d(Expansion::row_difference) [N]
  double inertia_power = 0, inertia_per_speed = 0;
};

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

std::vector<StateEntry> TouchdownBearing::state_entries() const {
  std::vector<StateEntry> entries = {{"inner ring y", "m", 1e-4},
                                     {"inner ring z", "m", 1e-4},
                                     {"inner ring velocity y", "m/s", 0.1},
                                     {"inner ring velocity z", "m/s", 0.1},
                                     {"inner ring angle", "rad", 1.},
                                     {"inner ring spin", "rad/s", 100.},
                                     {"support y", "m", 1e-5},
                                     {"support z", "m", 1e-5},
                                     {"support velocity y", "m/s", 0.01},
                                     {"support velocity z", "m/s", 0.01},
                                     {"cage angle", "rad", 1.}};
  if (data_.free_ring)
    entries.insert(entries.end(), {{"inner ring x", "m", 1e-5},
                                   {"inner ring velocity x", "m/s", 0.01},
                                   {"inner ring tilt y", "rad", 1e-4},
                                   {"inner ring tilt z", "rad", 1e-4},
                                   {"inner ring tilt rate y", "rad/s", 1.},
                                   {"inner ring tilt rate z", "rad/s", 1.}});
  // A bristle of sticking friction gives way after about a micrometre.
  const std::size_t directions = data_.free_ring ? 2 : 1;
  for (std::size_t k = 0; k < n_bristles(); ++k)
    entries.push_back(
        {fmt::format("bristle {} {}", k / directions + 1, k % directions == 0 ? "around" : "along"), "m", 1e-6});
  if (data_.bending)
    for (auto& entry : shape_entries()) entries.push_back(std::move(entry));
  if (data_.support_law)
    for (const auto& state : data_.support_law->states())
      entries.push_back({"support " + state.name, state.unit, state.scale});
  return entries;
}

std::vector<StateEntry> TouchdownBearing::ledger_entries() const {
  std::vector<StateEntry> entries = {
      {"contact impulse", "N s", 100., "integral of the contact force"},
      {"contact damping", "J", 1., "energy dissipated by the damping of rotor and ring's contact"},
      {"ball damping", "J", 1., "energy dissipated by the damping of balls and races"},
      {"support damping", "J", 1., "energy dissipated by the support's damper"},
      {"waviness work", "J", 1., "work of the travelling waves on the machine"},
      {"cage work", "J", 1., "work of the prescribed cage motion on the machine"},
      {"ball inertia work", "J", 1., "work of centrifugal forces and gyroscopic moments on the balls as they move"},
      {"spin-up drive", "J", 100., "integral of omega_r (J omega_i' + M), for the balance of the spin-up"},
      {"spin-up centres", "J", 1., "integral of F_t v_t, friction force times the centres' tangential speed"}};
  if (data_.bending)
    entries.push_back({"ring bending damping", "J", 1., "energy dissipated by the damping of bent rings"});
  return entries;
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
  in.cage_cosine = std::cos(in.cage_angle);
  in.cage_sine = std::sin(in.cage_angle);
  in.cage_speed = cage_ratio_ * y[ring_spin];
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
    sum.cage_power += row.cage_power;
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
  out.prescribed_work = balls.cage_power + wave_work + inertia_work + centrifugal_work;

  ledger[contact_impulse] = t.normal;
  ledger[contact_damping] = t.damping;
  ledger[ball_damping] = balls.damping_power;
  ledger[support_damping] = support.loss;
  ledger[waviness_work] = wave_work;
  ledger[cage_work] = balls.cage_power;
  ledger[inertia_of_balls] = inertia_work;
  // Friction in the bore has the rotor's radius on the rotor, that of shoulders the same on both.
  const double bore_torque = t.on_ring.torque - t.shoulder_torque;
  ledger[spin_up_drive] =
      in.rotor_spin.speed * (bore_torque + t.shoulder_torque * data_.bore_radius / data_.rotor_radius);
  ledger[spin_up_centres] = t.centres_power;
  if (data_.bending) ledger[ring_bending_damping] = bending_loss;

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

std::vector<Observable> TouchdownBearing::observables() const {
  const std::vector<std::string> yz = {"y", "z"};
  std::vector<std::string> row_names;
  for (std::size_t i = 0; i < rows_.size(); ++i) row_names.push_back("row " + std::to_string(i + 1));
  std::vector<Observable> list = {
      {"orbit", "m", "rotor centre at the bearing, from the unloaded outer ring's axis", 2, yz, Observed::orbit},
      {"rotor_velocity", "m/s", "velocity of the rotor centre at the bearing", 2, yz},
      {"ring_position", "m", "inner-ring centre", 2, yz},
      {"ring_velocity", "m/s", "velocity of the inner-ring centre", 2, yz},
      {"support_position", "m", "displacement of the support and outer ring", 2, yz},
      {"penetration",
       "m",
       "penetration of the rotor surface into the bore; negative: remaining gap",
       1,
       {},
       Observed::penetration},
      {"clearance", "m", "radial air gap after thermal growth of bore and shaft", 1, {}, Observed::clearance},
      {"contact_force", "N", "normal force between rotor and inner ring", 1, {}, Observed::contact_force},
      {"friction_force", "N", "friction force on the inner ring, positive about +x", 1, {}},
      {"slip_speed", "m/s", "slip speed of the rotor surface relative to the bore", 1, {}, Observed::slip_speed},
      {"spin_lag",
       "1",
       "speed deficit of the bore surface relative to the rotor surface, divided by the rotor's surface speed",
       1,
       {},
       Observed::spin_lag},
      {"bearing_force", "N", "resultant of the ball forces on the inner ring", 2, yz},
      {"ball_force", "N", "load of the most loaded ball of each row", rows_.size(), row_names, Observed::ball_force},
      {"contact_pressure", "Pa", "largest pressure of balls and races in each row", rows_.size(), row_names,
       Observed::contact_pressure},
      {"ring_speed", "rad/s", "inner-ring spin speed", 1, {}, Observed::ring_speed},
      {"cage_angle", "rad", "rotation of the cage", 1, {}},
      {"load_torque", "N m", "load-dependent friction torque of the bearing (eq. 21)", 1, {}, Observed::load_torque},
      {"drag_torque", "N m", "speed-dependent friction torque of the bearing (eq. 22)", 1, {}},
      {"spin_torque",
       "N m",
       "spin moment of the most loaded ball on the inner race (eq. 23)",
       1,
       {},
       Observed::spin_torque},
      {"spin_speed_inner", "rad/s", "spin of the balls on the inner race, outer-race control (eq. 13)", 1, {}},
      {"rub_heat_rate", "W", "friction heat between rotor and inner ring (eq. 19)", 1, {}, Observed::rub_heat_rate},
      {"inner_heat_rate", "W", "friction heat of balls and inner race", 1, {}, Observed::inner_heat_rate},
      {"outer_heat_rate", "W", "friction heat of balls and outer race", 1, {}, Observed::outer_heat_rate},
      growth_observable("expansion", "thermal and centrifugal growth"),
      {"row_axial_force", "N", "axial force of each row of balls on the inner ring", rows_.size(), row_names},
      {"preload", "N", "preload of opposed rows: the smaller of their axial forces", 1, {}, Observed::preload},
      {"centrifugal_force",
       "N",
       "centrifugal force of one ball at the cage's speed",
       1,
       {},
       Observed::centrifugal_force},
      {"ellipse_truncation", "1", "largest part of a contact ellipse's length beyond the edge of its raceway",
       rows_.size(), row_names, Observed::ellipse_truncation},
      {"skid_demand", "1",
       "traction that rolling and gyroscopic moments require of the row, divided by the available friction",
       rows_.size(), row_names, Observed::skid_demand},
      {"gyroscopic_demand", "1",
       "traction that a ball's gyroscopic moment asks of the outer race, over what friction gives", rows_.size(),
       row_names, Observed::gyroscopic_demand}};
  if (data_.free_ring)
    list.insert(
        list.end(),
        {{"axial_position", "m", "rotor and inner ring along the axis", 2, {"rotor", "ring"}, Observed::axial_position},
         {"ring_tilt", "rad", "rotation of the inner ring about y and z", 2, yz},
         {"axial_force", "N", "rotor on inner ring along +x, shoulders and friction", 1, {}, Observed::axial_force},
         {"shoulder_force", "N", "shoulders of the rotor on the inner ring, along +x", 1, {}},
         {"ring_moment", "N m", "rotor on inner ring about y and z", 2, yz}});
  if (data_.support_law)
    list.insert(list.end(), {{"support_force", "N", "force of the support on the outer ring", 2, yz},
                             {"support_energy", "J", "energy stored in the springs of the support", 1, {}}});
  return list;
}

std::vector<Observable> TouchdownBearing::detailed_observables() const {
  Observable loads{"ball_loads", "N", "load of every ball", 0, {}};
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (int j = 0; j < rows_[i].geometry().n_balls; ++j)
      loads.columns.push_back("row " + std::to_string(i + 1) + " ball " + std::to_string(j + 1));
  loads.size = loads.columns.size();
  std::vector<Observable> list = {loads};
  if (data_.bending)
    for (auto& shape : shape_observables()) list.push_back(std::move(shape));
  return list;
}

void TouchdownBearing::observe(const SupportInput& in, const Expansion& growth, std::span<const double> y,
                               const Touch& touch, const BallForces& balls, double load_torque, double drag_torque,
                               double ring_acceleration, const HeatInput& heat, std::span<double> out) const {
  std::size_t at = 0;
  const auto put = [&](std::initializer_list<double> values) {
    for (const double value : values) out[at++] = value;
  };
  put({in.journal.y, in.journal.z, in.journal.velocity_y, in.journal.velocity_z});
  put({y[ring_y], y[ring_z], y[ring_vy], y[ring_vz], y[support_y], y[support_z]});
  put({touch.middle.penetration, data_.air_gap + growth.bore - growth.shaft, touch.normal, touch.friction,
       touch.middle.slip_speed});
  const double rotor_surface = in.rotor_spin.speed * data_.rotor_radius;
  put({rotor_surface != 0. ? 1. - y[ring_spin] * data_.bore_radius / rotor_surface : 1.});
  put({balls.force_y, balls.force_z});
  double largest = 0.;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    put({balls.row[i].largest_load});
    largest = std::max(largest, balls.row[i].largest_load);
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto& race = rows_[i].geometry();
    put({std::max(race.inner.largest_pressure(balls.row[i].largest_load),
                  race.outer.largest_pressure(balls.row[i].largest_outer_load))});
  }
  const double spin_torque = spin_moment(data_.race_friction_coefficient, largest,
                                         data_.spin_axis_factor * std::cbrt(largest), data_.spin_elliptic_integral);
  put({y[ring_spin], y[cage_angle], load_torque, drag_torque, spin_torque, spin_speed_sum_ratio_ * y[ring_spin]});
  put({heat.rub, heat.inner, heat.outer});
  for (const double surface : growth_values(growth)) out[at++] = surface;
  double towards_plus = 0., towards_minus = 0.;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double axial = balls.row[i].force_x;
    put({axial});
    (axial > 0. ? towards_plus : towards_minus) += std::fabs(axial);
  }
  put({rows_.size() > 1 ? std::min(towards_plus, towards_minus) : 0.});
  put({balls.tractions[0].centrifugal});
  for (std::size_t i = 0; i < rows_.size(); ++i) put({balls.tractions[i].truncation});
  const double mu = data_.race_friction_coefficient;
  const double acceleration = 0.5 * data_.rows.front().pitch_diameter * cage_ratio_ * std::fabs(ring_acceleration);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto& row = rows_[i].geometry();
    put({rolling_demand(balls.tractions[i], row.n_balls, row.ball_mass, acceleration, mu)});
  }
  for (std::size_t i = 0; i < rows_.size(); ++i)
    put({traction_demand(balls.tractions[i].largest_gyroscopic_over_load, mu, 1.)});
  if (!data_.free_ring) return;
  put({in.journal.x, y[ring_x], y[tilt_y], y[tilt_z], touch.on_ring.x, touch.shoulder});
  put({touch.on_ring.moment_y, touch.on_ring.moment_z});
}

}  // namespace rotordrop
