#include "study/opinion/second_opinion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "case/fe_module.h"
#include "case/recorded_growth.h"
#include "machine/build_machine.h"
#include "study/json_number.h"
#include "study/result_limits.h"
#include "study/result_names.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// Results that are judged: what users ask of a drop, of each bearing and of the machine.
bool is_judged(const std::string& name) {
  for (const char* ending :
       {".peak_contact_force", ".friction_heat", ".inner_heat", ".outer_heat", ".largest_ball_force",
        ".largest_contact_pressure", ".catch_up_time", ".mean_contact_force_end", ".temperature_rise_end.inner_ring",
        ".fe.temperature_rise_end.inner_ring", ".local.bore_rise", ".preload.largest"})
    if (name.starts_with("bearings.") && name.ends_with(ending)) return true;
  return name == "energy.dissipated" || name == "rotor_speed_end";
}

FinishedDrop run_again(const Case& c, const volatile std::sig_atomic_t* stop) {
  FiniteElements elements = finite_elements_of(c);
  const auto machine = build_machine(c.parameters, c.tree, &elements, recorded_growth(c));
  MemoryRunOptions options;
  options.elements = &elements;
  options.is_stopped = [stop] { return stop && *stop; };
  options.is_kept = [](const std::string&) { return false; };
  return run_drop_in_memory(c, *machine, options);
}

/// The case without what a summary of its own would judge.
Case plain(const Case& c) {
  Case again = c;
  again.parameters.limits.clear();
  again.parameters.run.fatal_warnings.clear();
  return again;
}

/// When every bearing's first impact is over, and those that are hit again are about to be [s]; nothing if no bearing is hit.
std::optional<double> end_of_first_impacts(const Json& summary) {
  double end = 0.;
  for (const auto& [name, b] : summary["bearings"].items())
    for (const char* key : {"first_contact_end", "second_contact_time"})
      if (b[key].is_number()) end = std::max(end, b[key].get<double>());
  return end > 0. ? std::optional(end) : std::nullopt;
}

/// |a - b| over the larger of them; 0 if neither happened, NaN if only one did.
double relative_difference(double a, double b) {
  if (std::isnan(a) && std::isnan(b)) return 0.;
  const double size = std::max(std::fabs(a), std::fabs(b));
  return size > 0. ? std::fabs(a - b) / size : a == b ? 0. : std::nan("");
}

double value_of(const Json& summary, const std::string& name) {
  for (const auto& [known, value] : numbers_of(summary))
    if (known == name) return value;
  return std::nan("");
}

/// First time at which orbits of two drops differ by more than a part of the air gap [s]; NaN: never.
double parting(const Case& c, const RecordedDrop& a, const RecordedDrop& b) {
  double first = std::nan("");
  for (const std::string& name : touchdown_names(c.parameters)) {
    const double limit = parted_share * air_gap(touchdown_of(c.parameters, name), c.parameters.contact);
    const std::string path = "/bearings/" + name + "/orbit";
    const TimeSeries y = a.series(path, 0), z = a.series(path, 1), other_y = b.series(path, 0),
                     other_z = b.series(path, 1);
    for (std::size_t i = 0; i < y.times.size(); ++i) {
      const double t = y.times[i];
      if (t >= first) break;
      if (std::hypot(y.values[i] - other_y.at(t), z.values[i] - other_z.at(t)) > limit) first = t;
    }
  }
  return first;
}

struct FirstImpacts {
  double until = 0;
  FinishedDrop same, finer;
};

/// Those of the case and with smaller steps, both up to `until`.
std::optional<FirstImpacts> repeat_first_impacts(const Case& c, double until, const volatile std::sig_atomic_t* stop) {
  Case brief = plain(c), fine = plain(c);
  for (Case* again : {&brief, &fine}) {
    again->parameters.run.until = EndCondition::time;
    again->parameters.run.until_time = until;
  }
  auto& integration = fine.parameters.integration;
  if (integration.method == IntegrationMethod::runge_kutta_4)
    integration.step = 0.5 * step_or_bound(c.parameters.integration);
  else
    integration.tolerance *= 0.1;
  FirstImpacts impacts{until, run_again(brief, stop), run_again(fine, stop)};
  if (!impacts.same.completed || !impacts.finer.completed) return {};
  return impacts;
}

}  // namespace

Json second_opinion(const Case& c, const FinishedDrop& first, const volatile std::sig_atomic_t* stop) {
  const double end = first.end_time;
  const double until = std::min(end_of_first_impacts(first.summary).value_or(end), end);
  const auto impacts = repeat_first_impacts(c, until, stop);
  if (!impacts) return nullptr;
  std::vector<FinishedDrop> neighbours;
  double apart = std::nan("");
  for (const double shift : {neighbour_distance, -neighbour_distance}) {
    Case beside = plain(c);
    beside.parameters.rotor.initial_offset[0] += shift;
    neighbours.push_back(run_again(beside, stop));
    if (!neighbours.back().completed) return nullptr;
    apart = std::fmin(apart, parting(c, *first.recorded, *neighbours.back().recorded));
  }
  Json results = Json::array();
  for (const auto& [name, value] : numbers_of(first.summary)) {
    if (!is_judged(name)) continue;
    double lowest = value, highest = value, spread = 0.;
    for (const auto& neighbour : neighbours) {
      const double other = value_of(neighbour.summary, name);
      lowest = std::fmin(lowest, other);
      highest = std::fmax(highest, other);
      if (std::isnan(other) != std::isnan(value)) spread = std::nan("");
    }
    if (!std::isnan(spread)) spread = relative_difference(lowest, highest);
    const double difference =
        relative_difference(value_of(impacts->same.summary, name), value_of(impacts->finer.summary, name));
    const double known = std::isnan(spread) || std::isnan(difference) ? std::nan("") : std::max(spread, difference);
    results.push_back({{"key", name},
                       {"value", json_number(value)},
                       {"unit", meaning_of(name).unit},
                       {"by_finer_steps", json_number(difference)},
                       {"lowest", json_number(lowest)},
                       {"highest", json_number(highest)},
                       {"spread", json_number(spread)},
                       {"known_to", json_number(known)}});
  }
  const bool is_fixed = c.parameters.integration.method == IntegrationMethod::runge_kutta_4;
  return {{"first_impacts_until", until},     {"finer_by", is_fixed ? "half the step" : "a tenth of the tolerance"},
          {"neighbours", neighbours.size()},  {"neighbour_distance", neighbour_distance},
          {"apart_from", json_number(apart)}, {"is_chaotic", std::isfinite(apart)},
          {"results", std::move(results)}};
}

std::string second_opinion_text(const Json& summary) {
  if (!summary.contains("second_opinion")) return {};
  const Json& o = summary["second_opinion"];
  if (!o.is_object()) return "Second opinion: interrupted\n";
  std::string text = fmt::format("Second opinion ({} up to {:.4g} ms, and {} drops that start {:.0f} nm beside):\n",
                                 o["finer_by"].get<std::string>(), o["first_impacts_until"].get<double>() * 1e3,
                                 o["neighbours"].get<int>(), o["neighbour_distance"].get<double>() * 1e9);
  for (const auto& r : o["results"]) {
    const std::string key = r["key"].get<std::string>();
    if (!r["value"].is_number()) continue;
    if (r["known_to"].is_number())
      text += fmt::format("  known to {:>8.2g} %  {} (finer steps {:.1g} %, neighbours {:.1g} %)\n",
                          100. * r["known_to"].get<double>(), key, 100. * r["by_finer_steps"].get<double>(),
                          100. * r["spread"].get<double>());
    else
      text += fmt::format("  not known           {}: it happens in some of these drops only\n", key);
  }
  if (o["is_chaotic"].get<bool>())
    text += fmt::format(
        "  The motion is chaotic: from {:.4g} ms on orbits of neighbours differ by more than 1 % of the air gap. After "
        "that an orbit or an instant is one of many; peaks and heat are known as above.\n",
        o["apart_from"].get<double>() * 1e3);
  else
    text += "  Neighbours stay together to the end: orbits and instants are known, too.\n";
  return text;
}

}  // namespace rotordrop
