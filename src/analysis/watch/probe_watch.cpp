#include "analysis/watch/probe_watch.h"

#include <cmath>
#include <map>

#include "analysis/watch/packed_numbers.h"

namespace rotordrop {

void ProbeScalars::follow(double t, double left, double force) {
  overlap.follow(true, t, -left);
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
  time = t;
  clearance = left;
}

std::vector<double*> ProbeScalars::numbers() {
  std::vector<double*> all = {&first_touch_time, &time_touching, &time, &clearance};
  for (auto* peak : {&overlap, &contact_force})
    for (double* number : peak->numbers()) all.push_back(number);
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
    to["probes/" + names_[i]] = packed_numbers(scalars.numbers());
  }
}

void ProbeWatch::unpack(const PackedValues& from) {
  for (std::size_t i = 0; i < scalars_.size(); ++i)
    unpack_numbers(from.at("probes/" + names_[i]), scalars_[i].numbers());
}

}  // namespace rotordrop
