#include "analysis/drop_scalars.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rotordrop {
namespace {

// Time at which a quantity falls or rises through `level` between two instants, by a straight line.
double crossing(double t_0, double value_0, double t_1, double value_1, double level) {
  if (!(std::isfinite(t_0)) || value_1 == value_0) return t_1;
  return t_0 + (level - value_0) / (value_1 - value_0) * (t_1 - t_0);
}

struct Peak {
  double time, value;
};
// Top of the parabola through three points whose middle one is the highest.
Peak parabola_top(double t_0, double f_0, double t_1, double f_1, double t_2, double f_2) {
  const double left = (f_1 - f_0) / (t_1 - t_0), right = (f_2 - f_1) / (t_2 - t_1);
  const double curvature = (right - left) / (t_2 - t_0);
  if (!(curvature < 0.)) return {t_1, f_1};
  const double slope = left + curvature * (t_1 - t_0);  // at the middle point
  const double shift = -slope / (2. * curvature);
  return {t_1 + shift, f_1 + 0.5 * slope * shift};
}

}  // namespace

void FollowedPeak::follow(double t, double f) {
  if (f > value) {  // the last step of a run may be the highest
    value = f;
    time = t;
  }
  if (last_ > before_ && last_ >= f && last_ >= value) {
    const Peak top = parabola_top(time_before_, before_, last_time_, last_, t, f);
    value = top.value;
    time = top.time;
  }
  time_before_ = last_time_;
  before_ = last_;
  last_time_ = t;
  last_ = f;
}

void FollowedRange::follow(double t, double f) {
  if (std::isnan(first)) first = f;
  if (!(smallest <= f)) {
    smallest = f;
    smallest_time = t;
  }
  if (!(largest >= f)) {
    largest = f;
    largest_time = t;
  }
  last = f;
}

void FollowedDemand::follow(double t, double demand, double speed) {
  if (demand > largest) {
    largest = demand;
    largest_time = t;
  }
  if (std::isfinite(last_time_)) speed_change += std::fabs(speed - last_speed_);
  const double high = std::max(demand, last_), low = std::min(demand, last_);
  if (std::isfinite(last_time_) && high > 1.) {
    const double share = low >= 1. ? 1. : (high - 1.) / (high - low);
    const double beyond = share * (t - last_time_);
    time_beyond += beyond;
    speed_change_beyond += share * std::fabs(speed - last_speed_);
    stretch_ = last_ > 1. ? stretch_ + beyond : beyond;
    longest_beyond = std::max(longest_beyond, stretch_);
  }
  last_time_ = t;
  last_ = demand;
  last_speed_ = speed;
}

void FollowedTruncation::follow(double t, double truncation) {
  if (truncation > largest) {
    largest = truncation;
    largest_time = t;
  }
  if (std::isfinite(last_time_) && truncation > 0. && last_ > 0.) time_truncated += t - last_time_;
  last_time_ = t;
  last_ = truncation;
}

void FollowedLoad::follow(double t, double force, double load) {
  largest = std::max(largest, force);
  if (std::isfinite(last_time_)) {
    const double half = 0.5 * (t - last_time_);
    product_ += half * (force * load + last_force_ * last_load_);
    load_squared_ += half * (load * load + last_load_ * last_load_);
    time_ += 2. * half;
    if (load > 0. && last_load_ > 0.) time_loaded_ += 2. * half;
  }
  last_time_ = t;
  last_force_ = force;
  last_load_ = load;
}

DropScalars::DropScalars(const Machine& machine) : probes_(machine), supports_(machine) {
  const auto& list = machine.step_observables();
  for (std::size_t i = 0; i < machine.n_supports(); ++i) {
    const std::string& name = machine.support(i).name();
    const auto ball_force = columns_of(list, Observed::ball_force, name);
    if (!ball_force) continue;  // not a touchdown bearing
    const auto column_of_free = [&](Observed kind) -> std::optional<std::size_t> {
      const auto found = columns_of(list, kind, name);
      return found ? std::optional(found->first) : std::nullopt;
    };
    const auto column = [&](Observed kind) { return column_of_free(kind).value(); };
    names_.push_back(name);
    columns_.push_back({i,
                        column(Observed::orbit),
                        column(Observed::penetration),
                        column(Observed::contact_force),
                        column(Observed::rub_heat_rate),
                        column(Observed::spin_lag),
                        column(Observed::load_torque),
                        column(Observed::spin_torque),
                        column(Observed::inner_heat_rate),
                        column(Observed::outer_heat_rate),
                        column(Observed::ring_speed),
                        ball_force->first,
                        column(Observed::contact_pressure),
                        ball_force->size,
                        column(Observed::clearance),
                        column(Observed::growth),
                        column(Observed::preload),
                        column(Observed::skid_demand),
                        column(Observed::gyroscopic_demand),
                        column(Observed::centrifugal_force),
                        column(Observed::ellipse_truncation),
                        column_of_free(Observed::axial_force),
                        column_of_free(Observed::axial_position)});
  }
  scalars_.resize(columns_.size());
}

void DropScalars::step(const Step& step) {
  if (step.is_observed) follow(step.time, step.found->step);
}

void DropScalars::follow(double t, std::span<const double> step) {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Columns& c = columns_[i];
    BearingScalars& s = scalars_[i];
    const double penetration = step[c.penetration], lag = step[c.spin_lag], y = step[c.orbit];

    const bool touches = penetration > 0.;
    const bool touched = s.penetration > 0.;
    if (touches && !touched) {
      const double start = crossing(s.time, s.penetration, t, penetration, 0.);
      if (std::isnan(s.first_contact_time))
        s.first_contact_time = start;
      else if (std::isnan(s.second_contact_time))
        s.second_contact_time = start;
    } else if (touched && !touches && std::isnan(s.first_contact_end)) {
      s.first_contact_end = crossing(s.time, s.penetration, t, penetration, 0.);
    }
    const bool is_first_flight = !std::isnan(s.first_contact_end) && std::isnan(s.second_contact_time);
    if (is_first_flight && !(s.first_bounce_apex >= y)) s.first_bounce_apex = y;

    if (std::isnan(s.catch_up_time) && lag < 0.01) s.catch_up_time = crossing(s.time, s.spin_lag, t, lag, 0.01);

    s.contact_force.follow(t, step[c.contact_force]);
    s.friction_heat_rate.follow(t, step[c.rub_heat_rate]);
    s.load_torque.follow(t, step[c.load_torque]);
    s.spin_torque.follow(t, step[c.spin_torque]);
    s.inner_heat_rate.follow(t, step[c.inner_heat_rate]);
    s.outer_heat_rate.follow(t, step[c.outer_heat_rate]);
    double ball_force = 0.;
    for (std::size_t row = 0; row < c.n_rows; ++row) ball_force = std::max(ball_force, step[c.ball_force + row]);
    s.ball_force.follow(t, ball_force);
    double pressure = 0.;
    for (std::size_t row = 0; row < c.n_rows; ++row) {
      const double of_row = step[c.contact_pressure + row];
      s.row_pressure[row].follow(t, of_row);
      s.row_truncation[row].follow(t, step[c.ellipse_truncation + row]);
      s.row_centrifugal[row].follow(t, step[c.centrifugal_force], step[c.ball_force + row]);
      pressure = std::max(pressure, of_row);
    }
    s.contact_pressure.follow(t, pressure);
    s.clearance.follow(t, step[c.clearance]);
    for (std::size_t k = 0; k < s.growth.size(); ++k) s.growth[k].follow(t, step[c.growth + k]);
    s.preload.follow(t, step[c.preload]);
    double skid = 0., gyroscopic = 0.;
    for (std::size_t row = 0; row < c.n_rows; ++row) {
      skid = std::max(skid, step[c.skid_demand + row]);
      gyroscopic = std::max(gyroscopic, step[c.gyroscopic_demand + row]);
    }
    s.skid.follow(t, skid, step[c.ring_speed]);
    for (std::size_t row = 0; row < c.n_rows; ++row)
      s.row_skid[row].follow(t, step[c.skid_demand + row], step[c.ring_speed]);
    s.gyroscopic.follow(t, gyroscopic, step[c.ring_speed]);
    if (c.axial_force) s.axial_force.follow(t, step[*c.axial_force]);
    if (c.axial_position) s.axial_position.follow(t, step[*c.axial_position]);
    s.ring_speed_end = step[c.ring_speed];

    s.time = t;
    s.penetration = penetration;
    s.spin_lag = lag;
  }
  probes_.follow(t, step);
  supports_.follow(t, step);
}

SkidVerdict skid_verdict(const BearingScalars& s, std::size_t n_rows) {
  SkidVerdict verdict;
  bool all_loaded = true;
  for (std::size_t row = 0; row < n_rows; ++row) {
    if (s.row_centrifugal[row].loaded_share() < relevant_loaded_share) {
      all_loaded = false;
      continue;
    }
    if (verdict.row && s.row_skid[row].speed_change_beyond <= verdict.demand.speed_change_beyond) continue;
    verdict.row = row;
    verdict.demand = s.row_skid[row];
  }
  if (all_loaded) verdict.demand = s.skid;
  return verdict;
}

double DropScalars::largest_contact_force() const {
  double largest = 0.;
  for (const auto& s : scalars_) largest = std::max(largest, s.contact_force.value);
  return largest;
}

void DropScalars::pack(PackedValues& to) const {
  for (std::size_t i = 0; i < scalars_.size(); ++i) {
    BearingScalars s = scalars_[i];
    s.each([&](const std::string& name, const auto& numbers) {
      auto& values = to["scalars/" + names_[i] + "/" + name];
      for (const double* x : numbers) values.push_back(*x);
    });
  }
  probes_.pack(to);
  supports_.pack(to);
}

void DropScalars::unpack(const PackedValues& from) {
  for (std::size_t i = 0; i < scalars_.size(); ++i)
    scalars_[i].each([&](const std::string& name, const auto& numbers) {
      const auto& values = from.at("scalars/" + names_[i] + "/" + name);
      if (values.size() != numbers.size()) throw std::invalid_argument("scalars of another kind");
      for (std::size_t k = 0; k < values.size(); ++k) *numbers[k] = values[k];
    });
  probes_.unpack(from);
  supports_.unpack(from);
}

}  // namespace rotordrop
