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
  // Bottom of the parabola through three steps whose middle one is the lowest; a higher one may have a lower bottom than one before.
  if (std::isfinite(time_before) && clearance < clearance_before && clearance <= left) {
    const double falling = (clearance - clearance_before) / (time - time_before),
                 rising = (left - clearance) / (t - time);
    const double curvature = (rising - falling) / (t - time_before);
    const double slope = falling + curvature * (time - time_before);
    const double bottom =
        clearance - std::fmin(0.25 * slope * slope / curvature, std::fmax(clearance_before, left) - clearance);
    if (curvature > 0. && bottom < smallest_clearance) {
      smallest_clearance = bottom;
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
  contact_force.follow(true, t, force);
  time_before = time;
  clearance_before = clearance;
  time = t;
  clearance = left;
}

std::vector<double*> ProbeScalars::numbers() {
  std::vector<double*> all = {
      &smallest_clearance, &smallest_clearance_time, &first_touch_time, &time_touching, &time, &clearance,
      &time_before,        &clearance_before};
  for (double* number : contact_force.numbers()) all.push_back(number);
  return all;
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
    ProbeScalars scalars = scalars_[i];
    auto& values = to["probes/" + names_[i]];
    for (const double* number : scalars.numbers()) values.push_back(*number);
  }
}

void ProbeWatch::unpack(const PackedValues& from) {
  for (std::size_t i = 0; i < scalars_.size(); ++i) {
    const auto& values = from.at("probes/" + names_[i]);
    const auto numbers = scalars_[i].numbers();
    if (values.size() != numbers.size()) throw std::invalid_argument("a probe of another kind");
    for (std::size_t k = 0; k < numbers.size(); ++k) *numbers[k] = values[k];
  }
}

}  // namespace rotordrop
