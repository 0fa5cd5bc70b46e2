#include "study/probe_scalars.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>

#include "study/json_number.h"

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

static_assert(std::is_trivially_copyable_v<ProbeScalars> && sizeof(ProbeScalars) % sizeof(double) == 0);

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
    columns_.push_back({where.at(path + "clearance"), force == where.end() ? 0 : force->second, force != where.end()});
  }
  scalars_.resize(columns_.size());
}

void ProbeWatch::follow(double t, std::span<const double> step) {
  for (std::size_t i = 0; i < columns_.size(); ++i)
    scalars_[i].follow(t, step[columns_[i].clearance], columns_[i].has_force ? step[columns_[i].force] : 0.);
}

std::size_t ProbeWatch::packed_size() const { return scalars_.size() * sizeof(ProbeScalars) / sizeof(double); }

void ProbeWatch::pack(std::vector<double>& to) const {
  if (scalars_.empty()) return;
  const std::size_t start = to.size();
  to.resize(start + packed_size());
  std::memcpy(to.data() + start, scalars_.data(), packed_size() * sizeof(double));
}

void ProbeWatch::unpack(std::span<const double> values) {
  if (values.size() != packed_size()) throw std::invalid_argument("probes of another machine");
  if (!values.empty()) std::memcpy(static_cast<void*>(scalars_.data()), values.data(), values.size() * sizeof(double));
}

nlohmann::ordered_json probe_summary(const Machine& machine, const ProbeWatch& watch, std::span<const double> y) {
  using Json = nlohmann::ordered_json;
  Json all = Json::object();
  for (std::size_t i = 0; i < watch.size(); ++i) {
    const Probe& probe = machine.probes()[i];
    const ProbeScalars& s = watch.of(i);
    Json j = {{"node", probe.node},
              {"clearance", probe.clearance},
              {"smallest_clearance", json_number(s.smallest_clearance)},
              {"smallest_clearance_time", json_number(s.smallest_clearance_time)},
              {"touches", s.smallest_clearance < 0.},
              {"first_touch_time", json_number(s.first_touch_time)},
              {"time_touching", s.time_touching}};
    for (std::size_t k = 0; k < machine.n_supports(); ++k)
      if (machine.support(k).name() == "probes/" + probe.name)
        j["contact"] = {{"peak_contact_force", s.largest_force},
                        {"peak_contact_force_time", json_number(s.largest_force_time)},
                        {"friction_heat", machine.ledger(k, "contact friction", y)},
                        {"damping", machine.ledger(k, "contact damping", y)}};
    all[probe.name] = std::move(j);
  }
  return all;
}

std::string probe_text(const nlohmann::ordered_json& probes) {
  std::string text;
  for (const auto& [name, p] : probes.items()) {
    const double left = p["smallest_clearance"].is_number() ? p["smallest_clearance"].get<double>()
                                                            : std::numeric_limits<double>::quiet_NaN();
    const double time = p["smallest_clearance_time"].is_number() ? p["smallest_clearance_time"].get<double>() : left;
    if (!p["touches"].get<bool>())
      text += fmt::format("{} (node {}): does not touch; smallest clearance {:.4g} of {:.4g} um, at {:.4g} ms\n", name,
                          p["node"].get<int>(), left * 1e6, p["clearance"].get<double>() * 1e6, time * 1e3);
    else
      text += fmt::format(
          "{} (node {}): warning: the rotor TOUCHES at {:.4g} ms{}; {:.4g} um beyond its clearance of {:.4g} um, at "
          "{:.4g} ms{}\n",
          name, p["node"].get<int>(), p["first_touch_time"].get<double>() * 1e3,
          p.contains("contact") ? "" : " and goes on as if nothing were there", -left * 1e6,
          p["clearance"].get<double>() * 1e6, time * 1e3,
          p.contains("contact")
              ? fmt::format("; contact force up to {:.4g} kN", p["contact"]["peak_contact_force"].get<double>() * 1e-3)
              : "");
  }
  return text;
}

}  // namespace rotordrop
