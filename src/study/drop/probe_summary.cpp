#include "study/drop/probe_summary.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "study/json_number.h"

namespace rotordrop {

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
          "{} (node {}): the rotor TOUCHES at {:.4g} ms{}; {:.4g} um beyond its clearance of {:.4g} um, at "
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
