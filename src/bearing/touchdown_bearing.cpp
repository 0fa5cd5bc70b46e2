#include "bearing/touchdown_bearing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/sine_cosine.h"
#include "bearing/statics/ring_equilibrium.h"
#include "bearing/statics/steady_friction.h"
#include "bearing/touchdown_evaluate.h"
#include "laws/ball_kinematics.h"

namespace rotordrop {

TouchdownBearing::TouchdownBearing(TouchdownBearingData data)
    : data_(std::move(data)), numbers_(numbers_of(data_), data_.bore_waves) {
  for (auto& geometry : data_.rows) geometry.conducts = data_.conduction.has_value();
  if (data_.bending)
    for (auto& geometry : data_.rows) geometry.highest_harmonic = data_.bending->inner.back().n;
  if (data_.bending) shape_motions_ = shape_motions();
  if (data_.bending && data_.bending->model == RingBendingModel::arc) arc_table_ = make_arc_table();
  for (const auto& geometry : data_.rows) rows_.emplace_back(geometry, data_.race_waves);
  if (data_.support_law) n_support_states_ = data_.support_law->n_states();
}

TouchdownNumbers<double> TouchdownBearing::numbers_of(const TouchdownBearingData& d) {
  const auto& g = d.rows.front();
  TouchdownNumbers<double> q{};
  q.ring_mass = d.ring_mass;
  q.ring_spin_inertia = d.ring_spin_inertia;
  q.bore_radius = d.bore_radius;
  q.rotor_radius = d.rotor_radius;
  q.air_gap = d.air_gap;
  q.contact = d.contact;
  q.friction = d.friction.numbers();
  q.f1_z = d.f1_z;
  q.f1_y = d.f1_y;
  q.static_rating = d.static_rating;
  q.f2 = d.f2;
  q.drag_viscosity = d.drag_viscosity;
  q.drag_regularisation = d.drag_regularisation;
  q.race_friction_coefficient = d.race_friction_coefficient;
  q.spin_axis_factor = d.spin_axis_factor;
  q.spin_elliptic_integral = d.spin_elliptic_integral;
  q.heat_over_work = d.heat_over_work;
  q.support_mass = d.support_mass;
  q.support_stiffness_y = d.support_stiffness_y;
  q.support_stiffness_z = d.support_stiffness_z;
  q.support_damping_y = d.support_damping_y;
  q.support_damping_z = d.support_damping_z;
  q.centrifugal_growth = d.centrifugal_growth;
  q.gravity_y = d.gravity_y;
  q.gravity_z = d.gravity_z;
  if (d.conduction) q.conduction = *d.conduction;
  q.friction_load_factors = friction_load_factors(g.contact_angle);
  q.pitch_diameter = g.pitch_diameter;
  q.strain_per_growth = d.width > 0. ? 1. / d.width : 0.;
  q.cage_ratio = cage_speed_ratio(g.ball_diameter, g.pitch_diameter, g.contact_angle);
  q.rolling_speed_ratio = 0.5 * g.ball_diameter * ball_spin_ratio(g.ball_diameter, g.pitch_diameter, g.contact_angle);
  q.inner_heat_share = inner_heat_share(d);
  const double theta = pitch_angle_outer_race_control(g.contact_angle, g.ball_diameter, g.pitch_diameter);
  const auto spin = spin_speeds(1., g.contact_angle, g.contact_angle, theta, g.ball_diameter, g.pitch_diameter);
  // Under outer-race control omega_so is zero but for roundoff: the sum is the spin on the inner race.
  q.spin_speed_sum_ratio = std::fabs(spin.inner) + std::fabs(spin.outer);
  return q;
}

bool TouchdownBearing::runs_in_lanes() const {
  const auto& d = data_;
  return !d.free_ring && !d.sticking && !d.bending && !d.free_cage && !d.heats_rows_apart && !d.add_spin_heat &&
         !d.friction.has_tables;
}

bool TouchdownBearing::is_alike(const TouchdownBearing& other) const {
  const auto &a = data_, &b = other.data_;
  return runs_in_lanes() && other.runs_in_lanes() && rows_.size() == other.rows_.size() && a.load_law == b.load_law &&
         a.conduction.has_value() == b.conduction.has_value() &&
         (a.support_law != nullptr) == (b.support_law != nullptr) && n_support_states_ == other.n_support_states_ &&
         a.friction.has_stribeck == b.friction.has_stribeck &&
         std::ranges::equal(a.bore_waves, b.bore_waves, {}, &BoreWave::order, &BoreWave::order) &&
         std::equal(rows_.begin(), rows_.end(), other.rows_.begin(), [](const BallRow& r, const BallRow& s) {
           const auto has_split = [](const BallRow& row) { return row.geometry().inner_gyroscopic_share != 0.; };
           return r.geometry().has_inertia == s.geometry().has_inertia && has_split(r) == has_split(s) &&
                  r.is_radial() == s.is_radial() && std::ranges::equal(r.cosines(), s.cosines()) &&
                  std::ranges::equal(r.sines(), s.sines()) &&
                  std::ranges::equal(
                      r.waves().list(), s.waves().list(), [](const RaceWaves::Wave& v, const RaceWaves::Wave& w) {
                        return v.form.order == w.form.order && v.form.on_inner_race == w.form.on_inner_race;
                      });
         });
}

void TouchdownBearing::initial_state(std::span<double> y) const {
  std::fill(y.begin(), y.end(), 0.);
  const Force weight{data_.free_ring ? data_.ring_mass * data_.free_ring->gravity_x : 0.,
                     data_.ring_mass * data_.gravity_y, data_.ring_mass * data_.gravity_z};
  const std::vector<double> both = stiffness_of_both_rings();
  const auto place = ring_equilibrium(rows_, weight, data_.free_ring.has_value(), data_.cage_angle, both);
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
  bend_at_rest(both, place.shape, y);
  if (!data_.free_ring) return;
  y[ring_x] = place.x;
  y[tilt_y] = place.psi_y;
  y[tilt_z] = place.psi_z;
}

SupportMotion TouchdownBearing::support_motion(std::span<const double> y) const {
  return {y[support_y], y[support_z], y[support_vy], y[support_vz]};
}

SupportAnswer TouchdownBearing::carried(std::span<const double> y, std::span<double> dydt) const {
  return data_.support_law->evaluate(support_motion(y), y.subspan(support_states_at(), n_support_states_),
                                     dydt.subspan(support_states_at(), n_support_states_));
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
  return sum * numbers_.spin_speed_sum_ratio;
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
    const double own =
        data_.load_law == FrictionLoadLaw::equivalent ? row_load_torque(numbers_, forces.row[i]) : M_L / n;
    const double spin = data_.add_spin_heat ? row_spin_drag(rows_[i], in) : 0.;
    const double heat = (own + M_v / n + spin) * turning * ring_speed * data_.heat_over_work;
    out[i].inner = numbers_.inner_heat_share * heat;
    out[i].outer = (1. - numbers_.inner_heat_share) * heat;
    if (!data_.conduction) continue;
    const BallConductances G = row_conduction(numbers_, forces.row[i], ring_speed);
    out[i].balls = {G.inner_to_ball, G.outer_to_ball, G.inner_to_outer};
  }
}

void TouchdownBearing::evaluate(const SupportInput& in, std::span<const double> y, std::span<double> dydt,
                                std::span<double> ledger, SupportOutput& out) const {
  evaluate_with<double>(*this, in, y, dydt, ledger, out);
}

void TouchdownBearing::tilt(const BallForces& balls, Force on_ring, std::span<const double> y,
                            std::span<double> dydt) const {
  // The angular momentum of a tilted spinning ring has the parts I_p omega (psi_z, -psi_y) along y and z.
  const FreeRing& ring = *data_.free_ring;
  const double gyroscopic = ring.polar_inertia * y[ring_spin];
  dydt[ring_x] = y[ring_vx];
  dydt[ring_vx] = (on_ring.x + balls.force_x) / data_.ring_mass + ring.gravity_x;
  dydt[tilt_y] = y[tilt_rate_y];
  dydt[tilt_z] = y[tilt_rate_z];
  dydt[tilt_rate_y] = (on_ring.moment_y + balls.moment_y - gyroscopic * y[tilt_rate_z]) / ring.diametral_inertia;
  dydt[tilt_rate_z] = (on_ring.moment_z + balls.moment_z + gyroscopic * y[tilt_rate_y]) / ring.diametral_inertia;
}

void TouchdownBearing::observe_support(const SupportAnswer& answer, std::span<const double> y,
                                       std::span<double> out) const {
  out[0] = answer.y;
  out[1] = answer.z;
  out[2] = stored_in_support(y);
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

double TouchdownBearing::stored_in_support(std::span<const double> y) const {
  return data_.support_law->energy(support_motion(y), y.subspan(support_states_at(), n_support_states_));
}

double TouchdownBearing::energy(const SupportInput& in, std::span<const double> y) const {
  return energy_with<double>(*this, in, y);
}

}  // namespace rotordrop
