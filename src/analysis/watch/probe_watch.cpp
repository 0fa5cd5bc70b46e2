#include "analysis/watch/probe_watch.h"

#include <cmath>
#include <map>
#include <stdexcept>

namespace rotordrop {

void ProbeScalars::follow(double t, double left, double force) {
  if (!(smallest_clearance <= left)) {
    smallest_clearance = left;
    smallest_clearance_time = t;
  }
  // Bottom of the parabola through three steps whose middle one is the lowest.
  if (std::isfinite(time_before) && clearance < clearance_before && clearance <= left &&
      clearance <= smallest_clearance) {
    const double falling = (clearance - clearance_before) / (time - time_before),
                 rising = (left - clearance) / (t - time);
    const double curvature = (rising - falling) / (t - time_before);
    const double slope = falling + curvature * (time - time_before);
    if (curvature > 0.) {
      smallest_clearance = clearance - 0.25 * slope * slope / curvature;
      smallest_clearance_time = time - 0.5 * slope / curvature;
    }
  }
  if (std::isfinite(time)) {
    const double high = std::fmax(-left, -clearance), low = std::fmin(-left, -clearance);
    if (high > 0.) {
      const double share = low >= 0. ? 1. : high / (high - low);
      time_touching += share * (t - time);
      if (std::isnan(first_touch_time)) first_touch_time = low >= 0. ? time : t - share * (t - time);
    }
  } else if (left < 0.) {
    first_touch_time = t;
  }
  if (force > largest_force) {
    largest_force = force;
    largest_force_time = t;
  }
  time_before = time;
  clearance_before = clearance;
  time = t;
  clearance = left;
}

ProbeWatch::ProbeWatch(const Machine& machine) {
  std::map<std::string, std::size_t> where;
  std::size_t at = 0;
  for (const auto& o : machine.step_observables()) {
    where[o.name] = at;
    at += o.size;
  }
  for (const Probe& probe : machine.probes()) {
    const std::string path = "/probes/" + probe.name + "/";
    const auto force = where.find(path + "contact_force");
    names_.push_back(probe.name);
    columns_.push_back({where.at(path + "clearance"), force == where.end() ? 0 : force->second, force != where.end()});
  }
  scalars_.resize(columns_.size());
}

void ProbeWatch::follow(double t, std::span<const double> step) {
  for (std::size_t i = 0; i < columns_.size(); ++i)
    scalars_[i].follow(t, step[columns_[i].clearance], columns_[i].has_force ? step[columns_[i].force] : 0.);
}

void ProbeWatch::pack(PackedValues& to) const {
  for (std::size_t i = 0; i < scalars_.size(); ++i) {
    const ProbeScalars& s = scalars_[i];
    to["probes/" + names_[i]] = {s.smallest_clearance,
                                 s.smallest_clearance_time,
                                 s.first_touch_time,
                                 s.time_touching,
                                 s.largest_force,
                                 s.largest_force_time,
                                 s.time,
                                 s.clearance,
                                 s.time_before,
                                 s.clearance_before};
  }
}

void ProbeWatch::unpack(const PackedValues& from) {
  for (std::size_t i = 0; i < scalars_.size(); ++i) {
    const auto& v = from.at("probes/" + names_[i]);
    if (v.size() != 10) throw std::invalid_argument("a probe of another kind");
    scalars_[i] = {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8], v[9]};
  }
}

}  // namespace rotordrop
