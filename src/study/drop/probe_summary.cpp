#include "study/drop/probe_summary.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "study/json_number.h"

namespace rotordrop {

using Json = nlohmann::ordered_json;

std::vector<ProbeSummary> probe_summaries(const Machine& machine, const ProbeWatch& watch, std::span<const double> y) {
  std::vector<ProbeSummary> all;
  for (std::size_t i = 0; i < watch.size(); ++i) {
    const Probe& probe = machine.probes()[i];
    ProbeSummary s{probe.name, probe.node, probe.clearance, watch.of(i), {}};
    for (std::size_t k = 0; k < machine.n_supports(); ++k)
      if (machine.support(k).name() == "probes/" + probe.name)
        s.contact = {machine.ledger(k, "contact friction", y), machine.ledger(k, "contact damping", y)};
    all.push_back(std::move(s));
  }
  return all;
}

Json probes_json(const std::vector<ProbeSummary>& probes) {
  Json all = Json::object();
  for (const auto& probe : probes) {
    const ProbeScalars& s = probe.scalars;
    Json& j = all[probe.name];
    j = {{"node", probe.node},
         {"clearance", probe.clearance},
         {"smallest_clearance", json_number(s.smallest_clearance())},
         {"smallest_clearance_time", json_number(s.overlap.time)},
         {"touches", probe.touches()},
         {"first_touch_time", json_number(s.first_touch_time)},
         {"time_touching", s.time_touching}};
    if (probe.contact)
      j["contact"] = {{"peak_contact_force", s.contact_force.value},
                      {"peak_contact_force_time", json_number(s.contact_force.time)},
                      {"friction_heat", probe.contact->friction_heat},
                      {"damping", probe.contact->damping}};
  }
  return all;
}

std::string probe_text(const std::vector<ProbeSummary>& probes) {
  std::string text;
  for (const auto& p : probes) {
    const double left = p.scalars.smallest_clearance(), time = p.scalars.overlap.time;
    if (!p.touches())
      text += fmt::format("{} (node {}): does not touch; smallest clearance {:.4g} of {:.4g} um, at {:.4g} ms\n",
                          p.name, p.node, left * 1e6, p.clearance * 1e6, time * 1e3);
    else
      text += fmt::format(
          "{} (node {}): the rotor TOUCHES at {:.4g} ms{}; {:.4g} um beyond its clearance of {:.4g} um, at "
          "{:.4g} ms{}\n",
          p.name, p.node, p.scalars.first_touch_time * 1e3, p.contact ? "" : " and goes on as if nothing were there",
          -left * 1e6, p.clearance * 1e6, time * 1e3,
          p.contact ? fmt::format("; contact force up to {:.4g} kN", p.scalars.contact_force.value * 1e-3) : "");
  }
  return text;
}

}  // namespace rotordrop
