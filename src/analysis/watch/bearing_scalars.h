#pragma once
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "analysis/watch/bearing_touch.h"
#include "analysis/watch/followed.h"
#include "bearing/touchdown_parameters.h"
#include "machine/machine.h"

namespace rotordrop {

/// Where a touchdown bearing's values stand among a machine's step observables.
struct BearingColumns {
  std::size_t support, orbit;
  TouchColumns touch;
  std::size_t contact_force, rub_heat_rate, spin_lag, load_torque, spin_torque, inner_heat_rate, outer_heat_rate,
      ring_speed, ball_force, contact_pressure, n_rows, clearance, growth, preload, skid_demand, gyroscopic_demand,
      centrifugal_force, ellipse_truncation;
  std::optional<std::size_t> axial_force, axial_position;
};

/// Scalars of one touchdown bearing, followed from step to step. NaN where something has not happened. Numbers alone: what runs in lanes is copied so.
template <class Real>
struct BearingScalarsOf {
  Real first_contact_time = never;                        ///< penetration of the bore first passes zero [s]
  Real first_contact_end = never;                         ///< and first falls below it [s]
  Real second_contact_time = never;                       ///< [s]
  Real first_shoulder_contact_time = never;               ///< a shoulder first presses on the ring [s]
  FollowedPeakOf<Real> contact_force;                     ///< [N]
  Real highest_in_first_flight = never;                   ///< y of the rotor between first and second contact [m]
  FollowedPeakOf<Real> friction_heat_rate;                ///< [W]
  Real catch_up_time = never;                             ///< spin lag first below 1 % [s]
  FollowedPeakOf<Real> load_torque, spin_torque;          ///< [N m]
  FollowedPeakOf<Real> inner_heat_rate, outer_heat_rate;  ///< [W]
  FollowedPeakOf<Real> ball_force;                        ///< of the most loaded ball [N]
  FollowedPeakOf<Real> contact_pressure;                  ///< of balls and races [Pa]
  std::array<FollowedPeakOf<Real>, TouchdownBearing::max_rows> row_pressure;  ///< the same of each row [Pa]
  std::array<FollowedTruncationOf<Real>, TouchdownBearing::max_rows> row_truncation;
  std::array<FollowedLoadOf<Real>, TouchdownBearing::max_rows> row_centrifugal;
  FollowedRangeOf<Real> clearance;                                   ///< radial air gap [m]
  std::array<FollowedRangeOf<Real>, growth_surfaces.size()> growth;  ///< of growth_surfaces [m]
  FollowedRangeOf<Real> preload;                                     ///< of opposed rows [N]
  FollowedDemandOf<Real> skid, gyroscopic;                           ///< of the row that asks for most
  std::array<FollowedDemandOf<Real>, TouchdownBearing::max_rows> row_skid;
  FollowedRangeOf<Real> axial_force, axial_position;  ///< of rotor on ring [N], of the rotor [m]; of a free ring
  FollowedRangeOf<Real> shoulder_force;               ///< the shoulders' part of the former [N]
  Real ring_speed_end = never;                        ///< [rad/s]
  // The last step, for crossings and whether the rotor still rises.
  Real time = never, penetration = never, spin_lag = never, y = never;

  /// Calls f(name, numbers) for everything above; numbers: an array of pointers.
  template <class F>
  void each(F&& f) {
    f("first contact time", std::array{&first_contact_time});
    f("first contact end", std::array{&first_contact_end});
    f("second contact time", std::array{&second_contact_time});
    f("first shoulder contact time", std::array{&first_shoulder_contact_time});
    f("highest in first flight", std::array{&highest_in_first_flight});
    f("catch-up time", std::array{&catch_up_time});
    f("ring speed end", std::array{&ring_speed_end});
    f("last step", std::array{&time, &penetration, &spin_lag, &y});
    f("contact force", contact_force.numbers());
    f("friction heat rate", friction_heat_rate.numbers());
    f("load torque", load_torque.numbers());
    f("spin torque", spin_torque.numbers());
    f("inner heat rate", inner_heat_rate.numbers());
    f("outer heat rate", outer_heat_rate.numbers());
    f("ball force", ball_force.numbers());
    f("contact pressure", contact_pressure.numbers());
    f("clearance", clearance.numbers());
    f("preload", preload.numbers());
    f("skid", skid.numbers());
    f("gyroscopic", gyroscopic.numbers());
    f("axial force", axial_force.numbers());
    f("axial position", axial_position.numbers());
    f("shoulder force", shoulder_force.numbers());
    for (std::size_t k = 0; k < growth.size(); ++k)
      f(std::string("growth of ") + growth_surface_names[k], growth[k].numbers());
    for (std::size_t row = 0; row < row_pressure.size(); ++row) {
      const std::string of_row = " of row " + std::to_string(row + 1);
      f("pressure" + of_row, row_pressure[row].numbers());
      f("truncation" + of_row, row_truncation[row].numbers());
      f("centrifugal load" + of_row, row_centrifugal[row].numbers());
      f("skid" + of_row, row_skid[row].numbers());
    }
  }
};

using BearingScalars = BearingScalarsOf<double>;

/// When the rotor first touches the bearing, in the bore or on a shoulder [s]; NaN: never.
[[nodiscard]] inline double first_touch_time(const BearingScalars& s) {
  return std::fmin(s.first_contact_time, s.first_shoulder_contact_time);
}
/// Highest y of the rotor between first and second contact [m]; NaN as long as it is not known, since the rotor still rises.
[[nodiscard]] inline double first_bounce_apex(const BearingScalars& s) {
  const bool rises_still = std::isnan(s.second_contact_time) && s.y >= s.highest_in_first_flight;
  return rises_still ? never : s.highest_in_first_flight;
}
/// Whether the last step lies in the first contact, whose force is at its largest then: in the bore, or on a shoulder before it. A rotor that stays
/// after its first impact is past it.
[[nodiscard]] inline bool ends_in_first_contact(const BearingScalars& s) {
  if (std::isfinite(s.first_contact_end)) return false;
  if (std::isfinite(s.first_contact_time)) return s.contact_force.time >= s.time;
  const bool pushes_up = s.shoulder_force.largest >= -s.shoulder_force.smallest;
  return std::isfinite(s.first_shoulder_contact_time) &&
         (pushes_up ? s.shoulder_force.largest_time : s.shoulder_force.smallest_time) >= s.time;
}
[[nodiscard]] inline bool has_touched(const BearingScalars& s) { return std::isfinite(first_touch_time(s)); }

/// Time at which a quantity falls or rises through `level` between two instants, by a straight line.
template <class Real>
[[nodiscard]] Real crossing(const Real& t_0, const Real& value_0, const Real& t_1, const Real& value_1,
                            const Real& level) {
  return select(is_never(t_0) | (value_1 == value_0), t_1, t_0 + (level - value_0) / (value_1 - value_0) * (t_1 - t_0));
}

/// The next step of a bearing.
/// @param told  of which lanes; @param step  values of the step observables at t, by column
template <class Real, class StepValues>
void follow(BearingScalarsOf<Real>& s, const BearingColumns& c, const MaskOf<Real>& told, const Real& t,
            const StepValues& step) {
  const Real penetration = step[c.touch.penetration], lag = step[c.spin_lag], y = step[c.orbit];
  const MaskOf<Real> touches = penetration > 0., touched = s.penetration > 0.;
  const MaskOf<Real> changes = told & ((touches & (!touched)) | (touched & (!touches)));
  if (any(changes)) {
    const Real at = crossing(s.time, s.penetration, t, penetration, Real(0.));
    const MaskOf<Real> begins = changes & touches, is_first = begins & is_never(s.first_contact_time),
                       is_second = begins & (!is_first) & is_never(s.second_contact_time);
    put(is_first, s.first_contact_time, at);
    put(is_second, s.second_contact_time, at);
    put(changes & touched & is_never(s.first_contact_end), s.first_contact_end, at);
  }
  const MaskOf<Real> is_first_flight = (!is_never(s.first_contact_end)) & is_never(s.second_contact_time);
  put(told & is_first_flight & (!(s.highest_in_first_flight >= y)), s.highest_in_first_flight, y);
  // Of a rotor that does not spin the lag is a ratio of roundoff.
  const MaskOf<Real> catches_up =
      told & is_never(s.catch_up_time) & (lag < 0.01) & (abs(Real(step[c.ring_speed])) > least_spin);
  if (any(catches_up))
    put(catches_up, s.catch_up_time, select(s.spin_lag >= 0.01, crossing(s.time, s.spin_lag, t, lag, Real(0.01)), t));

  s.contact_force.follow(told, t, step[c.contact_force]);
  s.friction_heat_rate.follow(told, t, step[c.rub_heat_rate]);
  s.load_torque.follow(told, t, step[c.load_torque]);
  s.spin_torque.follow(told, t, step[c.spin_torque]);
  s.inner_heat_rate.follow(told, t, step[c.inner_heat_rate]);
  s.outer_heat_rate.follow(told, t, step[c.outer_heat_rate]);
  s.clearance.follow(told, t, step[c.clearance]);
  for (std::size_t k = 0; k < s.growth.size(); ++k) s.growth[k].follow(told, t, step[c.growth + k]);
  s.preload.follow(told, t, step[c.preload]);

  const Real ring_speed = step[c.ring_speed], centrifugal = step[c.centrifugal_force];
  Real ball_force = 0., pressure = 0., skid = 0., gyroscopic = 0.;
  for (std::size_t row = 0; row < c.n_rows; ++row) {
    const Real force = step[c.ball_force + row], of_row = step[c.contact_pressure + row],
               demand = step[c.skid_demand + row];
    s.row_pressure[row].follow(told, t, of_row);
    s.row_truncation[row].follow(told, t, step[c.ellipse_truncation + row]);
    s.row_centrifugal[row].follow(told, t, centrifugal, force);
    s.row_skid[row].follow(told, t, demand, ring_speed);
    ball_force = larger(ball_force, force);
    pressure = larger(pressure, of_row);
    skid = larger(skid, demand);
    gyroscopic = larger(gyroscopic, Real(step[c.gyroscopic_demand + row]));
  }
  s.ball_force.follow(told, t, ball_force);
  s.contact_pressure.follow(told, t, pressure);
  s.skid.follow(told, t, skid, ring_speed);
  s.gyroscopic.follow(told, t, gyroscopic, ring_speed);
  if (c.axial_force) s.axial_force.follow(told, t, step[*c.axial_force]);
  if (c.axial_position) s.axial_position.follow(told, t, step[*c.axial_position]);
  if (c.touch.shoulder_force) {
    s.shoulder_force.follow(told, t, step[*c.touch.shoulder_force]);
    put(told & is_shoulder_touched<Real>(c.touch, step) & is_never(s.first_shoulder_contact_time),
        s.first_shoulder_contact_time, t);
  }

  put(told, s.ring_speed_end, ring_speed);
  put(told, s.time, t);
  put(told, s.penetration, penetration);
  put(told, s.y, y);
  put(told, s.spin_lag, lag);
}

}  // namespace rotordrop
