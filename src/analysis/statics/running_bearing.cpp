#include "analysis/statics/running_bearing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bearing/statics/steady_friction.h"
#include "laws/ball_kinematics.h"
#include "laws/ring_growth.h"
#include "machine/build_machine.h"
#include "machine/speed_growth.h"

namespace rotordrop {
namespace {

/// Radial motion of the ring, in its mounted place along the axis, until the first ball touches: sqrt((A + g - 2 eps_b)^2 - B_x^2) - B_r,
/// with g the growth of both groove radii.
double radial_clearance(const RingStatics& ring) {
  const auto& around = ring.surroundings();
  double least = std::numeric_limits<double>::infinity();
  for (const auto& g : ring.rows()) {
    const GroovesOf<double> at = grown(groove_centres(g), row_strains(g), g.difference_share, around);
    const double reach = at.A - 2. * around.ball_growth;
    least = std::min(least, std::sqrt(std::max(reach * reach - at.axial * at.axial, 0.)) - at.radial);
  }
  return least;
}

BallConduction ball_conduction(const TouchdownBearingData& b, const RingReport& ring, double speed) {
  const auto& g = b.rows.front();
  const double rolling =
      0.5 * g.ball_diameter * ball_spin_ratio(g.ball_diameter, g.pitch_diameter, g.contact_angle) * std::fabs(speed);
  BallConductances sum;
  for (const auto& row : ring.rows)
    for (const auto& ball : row.balls)
      sum.add(b.conduction->of_balls(1., std::cbrt(ball.inner.load), std::cbrt(ball.outer.load), rolling));
  return {sum.inner_to_ball, sum.outer_to_ball, sum.inner_to_outer};
}

}  // namespace

double housing_closure(const TouchdownParameters& b) {
  return bore_closure(0.5 * b.outer_ring_diameters[0], 0.5 * b.outer_ring_diameters[1], 0.5 * b.housing_diameters[1]);
}

bool preload_grows_by_speed(const MachineParameters& p) {
  if (p.preload.growth_by_speed == PreloadGrowthBySpeed::as_drop)
    return p.thermal.growth_by_speed != GrowthBySpeed::none;
  return p.preload.growth_by_speed == PreloadGrowthBySpeed::thin_disc;
}

Expansion cold_growth(const MachineParameters& p, const TouchdownParameters& b, double speed) {
  const auto& s = p.preload;
  Expansion g;
  g.inner_race = s.inner_growth;
  g.outer_race = s.outer_growth - s.interference * housing_closure(b);
  if (preload_grows_by_speed(p)) g = combined(1., g, speed * speed, ring_growth_by_speed(p, b));
  return g;
}

Force preload_load(const PreloadParameters& s) {
  return {s.force[0], s.force[1], s.force[2], s.moment[0], s.moment[1], 0.};
}

double preload_speed(const MachineParameters& p) { return p.preload.speed.value_or(std::fabs(p.run.initial_speed)); }

TouchdownRunning::TouchdownRunning(const MachineParameters& p, const std::string& name, const TouchdownParameters& b,
                                   const BearingState& at_rest, FindRest find)
    : statics_(p.statics),
      bearing_(b),
      data_(touchdown_data_of(p, name, b)),
      at_rest_(at_rest),
      find_(std::move(find)) {}

RunningState TouchdownRunning::in(const BearingState& state) const {
  auto system = bearing_equilibrium(statics_, bearing_, data_, state);
  // Always from the mounted place: what is found depends on nothing but what is asked.
  std::vector<double> x = system.start();
  find_(system, x);
  const auto ring = report_ring(system.bent_ring(), system.ring_unknowns(x), 1e-6 * system.force_scale());
  const auto friction = steady_friction(data_, ring, state.speed);
  RunningState s;
  s.heat = friction.total() * std::fabs(state.speed) * data_.heat_over_work;
  s.load_torque = friction.load;
  s.drag_torque = friction.drag;
  s.spin_torque = friction.spin;
  s.preload = ring.preload;
  for (const auto& row : ring.rows) {
    s.largest_ball_load = std::max(s.largest_ball_load, row.largest_load);
    s.largest_pressure = std::max(s.largest_pressure, row.largest_pressure);
    s.centrifugal_over_load = std::max(s.centrifugal_over_load, row.centrifugal_over_load);
    s.neglects_centrifugal = s.neglects_centrifugal || row.neglects_centrifugal;
  }
  s.static_safety = static_safety(s.largest_pressure);
  s.axial_stiffness = ring.stiffness[0][0];
  s.radial_stiffness_y = ring.stiffness[1][1];
  s.radial_stiffness_z = ring.stiffness[2][2];
  s.radial_clearance = radial_clearance(system.ring());
  s.is_floating = ring.is_floating;
  if (data_.conduction) s.balls = ball_conduction(data_, ring, state.speed);
  return s;
}

double TouchdownRunning::inner_share() const { return inner_heat_share(data_); }

}  // namespace rotordrop
