#include "study/opinion/second_opinion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "case/built_machine.h"
#include "machine/build_machine.h"
#include "study/json_number.h"
#include "study/result_limits.h"
#include "study/result_names.h"
#include "study/rub/impact.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// Results that are judged: what users ask of a drop, of each bearing and of the machine.
bool is_judged(const std::string& name) {
  for (const char* ending :
       {".peak_contact_force", ".friction_heat", ".inner_heat", ".outer_heat", ".largest_ball_force",
        ".largest_contact_pressure", ".catch_up_time", ".mean_contact_force_end", ".temperature_rise_end.inner_ring",
        ".local.bore_rise", ".preload.largest", ".axial.shoulder_force.smallest", ".axial.shoulder_force.largest"})
    if (name.starts_with("bearings.") && name.ends_with(ending)) return true;
  return name == "energy.dissipated" || name == "rotor_speed_end";
}

FinishedDrop run_again(const Case& c, const volatile std::sig_atomic_t* stop) {
  BuiltMachine built(c);
  MemoryRunOptions options;
  options.elements = &built.elements();
  options.is_stopped = [stop] { return stop && *stop; };
  options.is_kept = [](const std::string&) { return false; };
  return run_drop_in_memory(c, built.machine(), options);
}

/// The case without what a summary of its own would judge.
Case plain(const Case& c) {
  Case again = c;
  again.parameters.limits.clear();
  again.parameters.run.fatal_warnings.clear();
  return again;
}

/// When every bearing's first impact is over, and those that are hit again are about to be [s]; nothing if no bearing is hit.
std::optional<double> end_of_first_impacts(const FinishedDrop& drop) {
  double end = 0.;
  for (const auto& b : drop.summary.bearings) {
    for (const double time : {b.scalars.first_contact_end, b.scalars.second_contact_time})
      if (std::isfinite(time)) end = std::max(end, time);
    // The second contact is part of the first impact where the first one only knocked a light ring away.
    const Impact impact = first_impact(*drop.recorded, b.name);
    if (impact.end > b.scalars.second_contact_time)
      end = std::max(end, std::isfinite(impact.next) ? impact.next : impact.end);
  }
  return end > 0. ? std::optional(end) : std::nullopt;
}

/// |a - b| over the larger of them; NaN if one of them is nothing.
double relative_difference(double a, double b) {
  const double size = std::max(std::fabs(a), std::fabs(b));
  return size > 0. ? std::fabs(a - b) / size : a == b ? 0. : std::nan("");
}

using Numbers = std::map<std::string, double>;

Numbers numbers_in(const FinishedDrop& drop) {
  const auto list = numbers_of(summary_json(drop.summary));
  return {list.begin(), list.end()};
}

double value_of(const Numbers& numbers, const std::string& name) {
  const auto found = numbers.find(name);
  return found == numbers.end() ? std::nan("") : found->second;
}

/// Relative difference by finer steps of the first impacts; NaN where the drop has what they do not have yet, such as a landing on a shoulder.
double difference_by_steps(double value, double same, double finer) {
  return value != 0. && same == 0. && finer == 0. ? std::nan("") : relative_difference(same, finer);
}

/// What belongs to the end of a drop, or is reached late in it, is not there yet when the first impacts are over.
bool is_of_the_end(const std::string& name) {
  std::string_view result = name;
  if (constexpr std::string_view bearings = "bearings."; result.starts_with(bearings))
    result.remove_prefix(result.find('.', bearings.size()));  // a bearing may be called drive_end
  return result.find("_end") != std::string_view::npos || result.ends_with(".catch_up_time");
}

/// How far orbits of two drops of a case come apart.
struct Parting {
  double first = std::nan("");  ///< time at which they differ by more than parted_share of the air gap [s]; NaN: never
  double largest = 0, share = 0;  ///< largest distance [m], and over the air gap
  double time = std::nan("");     ///< when [s]

  void join(const Parting& other) {
    const double earlier = std::fmin(first, other.first);
    if (other.share > share) *this = other;
    first = earlier;
  }
};

Parting parting(const Case& c, const RecordedDrop& a, const RecordedDrop& b) {
  Parting all;
  for (const std::string& name : touchdown_names(c.parameters)) {
    const double gap = air_gap(touchdown_of(c.parameters, name), c.parameters.contact);
    const std::string path = "/bearings/" + name + "/orbit";
    const TimeSeries y = a.series(path, 0), z = a.series(path, 1), other_y = b.series(path, 0),
                     other_z = b.series(path, 1);
    for (std::size_t i = 0; i < y.times.size(); ++i) {
      const double t = y.times[i], distance = std::hypot(y.values[i] - other_y.at(t), z.values[i] - other_z.at(t));
      all.join({distance > parted_share * gap ? t : std::nan(""), distance, distance / gap, t});
    }
  }
  return all;
}

struct FirstImpacts {
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
  integration.step = 0.5 * step_or_bound(c.parameters.integration);
  integration.tolerance *= 0.1;  // of a fixed step it has no effect
  FirstImpacts impacts{run_again(brief, stop), run_again(fine, stop)};
  if (!impacts.same.completed || !impacts.finer.completed) return {};
  return impacts;
}

}  // namespace

Json second_opinion(const Case& c, const FinishedDrop& first, const volatile std::sig_atomic_t* stop) {
  const double end = first.end_time;
  const double until = std::min(end_of_first_impacts(first).value_or(end), end);
  const auto impacts = repeat_first_impacts(c, until, stop);
  if (!impacts) return nullptr;
  std::vector<Numbers> neighbours;
  Parting apart;
  for (const double shift : {neighbour_distance, -neighbour_distance}) {
    Case beside = plain(c);
    beside.parameters.rotor.initial_offset[0] += shift;
    const FinishedDrop neighbour = run_again(beside, stop);
    if (!neighbour.completed) return nullptr;
    neighbours.push_back(numbers_in(neighbour));
    apart.join(parting(c, *first.recorded, *neighbour.recorded));
  }
  const Numbers same = numbers_in(impacts->same), finer = numbers_in(impacts->finer);
  Json results = Json::array();
  for (const auto& [name, value] : numbers_of(summary_json(first.summary))) {
    if (!is_judged(name)) continue;
    double lowest = value, highest = value;
    bool is_in_all = std::isfinite(value), is_in_some = is_in_all;
    for (const auto& neighbour : neighbours) {
      const double other = value_of(neighbour, name);
      lowest = std::fmin(lowest, other);
      highest = std::fmax(highest, other);
      is_in_all = is_in_all && std::isfinite(other);
      is_in_some = is_in_some || std::isfinite(other);
    }
    if (!is_in_some || std::max(std::fabs(lowest), std::fabs(highest)) < least_judged) continue;
    const double spread = is_in_all ? relative_difference(lowest, highest) : std::nan("");
    const bool is_compared = until >= end || !is_of_the_end(name);
    const double by_steps =
        is_compared ? difference_by_steps(value, value_of(same, name), value_of(finer, name)) : std::nan("");
    results.push_back({{"key", name},
                       {"value", json_number(value)},
                       {"unit", meaning_of(name).unit},
                       {"by_finer_steps", json_number(by_steps)},
                       {"lowest", json_number(lowest)},
                       {"highest", json_number(highest)},
                       {"spread", json_number(spread)},
                       {"differs_by", json_number(is_in_all ? std::fmax(spread, by_steps) : std::nan(""))}});
  }
  const bool is_fixed = c.parameters.integration.method == IntegrationMethod::runge_kutta_4;
  return {{"first_impacts_until", until},
          {"finer_by", is_fixed ? "half the step" : "a tenth of the tolerance and half the longest step"},
          {"neighbours", neighbours.size()},
          {"neighbour_distance", neighbour_distance},
          {"apart_from", json_number(apart.first)},
          {"largest_distance", apart.largest},
          {"largest_distance_share", apart.share},
          {"largest_distance_time", json_number(apart.time)},
          {"results", std::move(results)}};
}

std::string second_opinion_text(const Json& o) {
  if (!o.is_object()) return "Second opinion: interrupted\n";
  const auto n = o.at("neighbours").get<int>();
  std::string text = fmt::format("Second opinion ({} up to {:.4g} ms; {} drops that start {:.0f} nm beside):\n",
                                 o.at("finer_by").get<std::string>(), o.at("first_impacts_until").get<double>() * 1e3,
                                 n, o.at("neighbour_distance").get<double>() * 1e9);
  for (const auto& r : o.at("results")) {
    const std::string key = r.at("key").get<std::string>();
    if (!r.at("differs_by").is_number()) {
      text += fmt::format("  in some only          {}: it happens in some of these drops, in others not\n", key);
      continue;
    }
    const std::string by_steps = r.at("by_finer_steps").is_number()
                                     ? fmt::format("{:.1g} %", 100. * r.at("by_finer_steps").get<double>())
                                     : "not compared";
    text += fmt::format("  differs by {:>8.2g} %  {} (finer steps {}, neighbours {:.1g} %)\n",
                        100. * r.at("differs_by").get<double>(), key, by_steps, 100. * r.at("spread").get<double>());
  }
  text += fmt::format(
      "  Ranges of {} drops: about half of further drops lie within. Parameters and model are not in them.\n", n + 1);
  if (!o.at("largest_distance_time").is_number()) return text;
  text += fmt::format("  Orbits of neighbours differ by at most {:.3g} um ({:.2g} % of the air gap), at {:.4g} ms",
                      o.at("largest_distance").get<double>() * 1e6, 100. * o.at("largest_distance_share").get<double>(),
                      o.at("largest_distance_time").get<double>() * 1e3);
  if (o.at("apart_from").is_number())
    text +=
        fmt::format("; by more than {:g} % of it from {:.4g} ms on: after that an orbit or an instant is one of many",
                    100. * parted_share, o.at("apart_from").get<double>() * 1e3);
  return text + ".\n";
}

}  // namespace rotordrop
