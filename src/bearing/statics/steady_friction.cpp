#include "bearing/statics/steady_friction.h"

#include <cmath>

#include "laws/ball_kinematics.h"
#include "laws/bearing_friction.h"

namespace rotordrop {
namespace {

/// Radial resultant of a row's balls on the ring [N].
double radial_force(const RowReport& row) {
  double y = 0., z = 0.;
  for (const auto& ball : row.balls) {
    const double outwards =
        ball.inner.load * std::cos(ball.inner.angle) - ball.inner_traction * std::sin(ball.inner.angle);
    y += outwards * std::cos(ball.azimuth);
    z += outwards * std::sin(ball.azimuth);
  }
  return std::hypot(y, z);
}

double spin_torque(const TouchdownBearingData& b, const RingReport& ring) {
  const auto& g = b.rows.front();
  const double theta = pitch_angle_outer_race_control(g.contact_angle, g.ball_diameter, g.pitch_diameter);
  const auto speeds = spin_speeds(1., g.contact_angle, g.contact_angle, theta, g.ball_diameter, g.pitch_diameter);
  double moments = 0.;
  for (const auto& row : ring.rows)
    for (const auto& ball : row.balls)
      moments += spin_moment(b.race_friction_coefficient, ball.inner.load,
                             b.spin_axis_factor * std::cbrt(ball.inner.load), b.spin_elliptic_integral);
  return moments * (std::fabs(speeds.inner) + std::fabs(speeds.outer));
}

}  // namespace

SteadyFriction steady_friction(const TouchdownBearingData& b, const RingReport& ring, double speed) {
  SteadyFriction M;
  const double through_standstill = std::fabs(std::tanh(speed / b.drag_regularisation));
  const auto n_rows = static_cast<double>(b.rows.size());
  for (std::size_t i = 0; i < ring.rows.size(); ++i) {
    const auto& g = b.rows[i];
    const FrictionLoads loads =
        friction_load_factors(g.contact_angle).loads(radial_force(ring.rows[i]), std::fabs(ring.rows[i].axial_force));
    M.load += through_standstill * load_torque(loads, b.f1_z, b.f1_y, b.static_rating / n_rows, g.pitch_diameter);
  }
  M.drag = through_standstill * drag_torque(b.drag_viscosity, speed, b.rows.front().pitch_diameter, b.f2);
  if (b.add_spin_heat) M.spin = through_standstill * spin_torque(b, ring);
  return M;
}

double inner_heat_share(const TouchdownBearingData& b) {
  const auto& g = b.rows.front();
  return 0.5 * (g.pitch_diameter - g.ball_diameter * std::cos(g.contact_angle)) / g.pitch_diameter;
}

}  // namespace rotordrop
