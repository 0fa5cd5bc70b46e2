#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <tuple>
#include <vector>

#include "analysis/drop_scalars.h"
#include "analysis/statics/statics.h"
#include "bearing/touchdown_parameters.h"
#include "model/run_warning.h"
#include "study/json_number.h"
#include "study/report/checks/checks.h"
#include "study/report/report.h"
#include "study/report/time_words.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// Temperature that a material stands [K]; NaN if it is not given.
double temperature_limit(const RecordedDrop& drop, const std::string& material) {
  const auto* found = find_material(drop.parameters(), material);
  return found ? found->temperature_limit.value_or(std::nan("")) : std::nan("");
}

/// Whether the rotor presses a shoulder on the ring: nothing of what rubs there is computed but force and heat.
bool is_on_shoulder(const Json& summary, const std::string& name) {
  return std::isfinite(number_at(summary, "/bearings/" + name + "/axial/first_shoulder_contact_time"));
}

void check_clearance(Checks& checks, const RecordedDrop& drop, const std::string& name) {
  const std::string path = "/bearings/" + name + "/clearance";
  if (!drop.has(path)) return;
  const TimeSeries s = drop.series(path);
  const auto least = std::min_element(s.values.begin(), s.values.end()) - s.values.begin();
  const double value = s.values[static_cast<std::size_t>(least)], time = s.times[static_cast<std::size_t>(least)];
  checks.add(name + ": air gap", value > 0.,
             value > 0. ? fmt::format("stays open: smallest {:.4g} µm, at {:.4g} ms", value * 1e6, time * 1e3)
                        : fmt::format("CLOSED by growth: {:.4g} µm at {:.4g} ms", value * 1e6, time * 1e3));
}

void check_whirl(Checks& checks, const Json& summary, const std::string& name) {
  const std::string key = "/bearings/" + name + "/whirl/";
  const Json::json_pointer direction(key + "direction");
  if (!summary.contains(direction)) {
    checks.unknown(name + ": whirl", "not assessed in this run");
    return;
  }
  const double speed = number_at(summary, key + "largest_backward_speed");
  const double resolved = number_at(summary, key + "fastest_resolved");
  const bool is_full = summary.at(Json::json_pointer(key + "full_rub")) == "yes";
  if (std::isfinite(speed)) {
    checks.add(name + ": backward whirl", false,
               fmt::format("sustained, up to {:.4g} Hz, during {:.3g} % of the contact time{}",
                           speed / (2. * std::numbers::pi), 100. * number_at(summary, key + "backward_whirl_share"),
                           is_full ? "; full rub" : ""));
    checks.add(
        name + ": whirl resolved by the recording", speed < resolved,
        fmt::format("the recording interval resolves whirl up to {:.4g} Hz", resolved / (2. * std::numbers::pi)));
  } else {
    checks.add(
        name + ": backward whirl", true,
        fmt::format("none sustained for a full turn (longest whirl: {})", summary.at(direction).get<std::string>()));
  }
}

/// @param rotor_speed  at the start [rad/s]
void check_skidding(Checks& checks, const Json& summary, const std::string& name, const TouchdownParameters& b,
                    double rotor_speed) {
  const std::string key = "/bearings/" + name;
  const double all = number_at(summary, key + "/skid/speed_change"),
               beyond = number_at(summary, key + "/skid/speed_change_beyond");
  if (!std::isfinite(beyond)) {
    checks.unknown(name + ": skidding", "not assessed in this run");
    return;
  }
  if (b.cage == CageModel::free)
    checks.unknown(name + ": skidding",
                   "not judged: with cage = \"free\" the slip of the balls is computed; cage_speed in results.h5 has "
                   "how far they lag");
  const bool is_rolling = !is_skidding_relevant(beyond, all, rotor_speed);
  if (b.cage == CageModel::rolling)
    checks.add(
        name + ": skidding", is_rolling,
        fmt::format("{}: for {:.4g} ms in total (longest stretch {:.4g} ms) friction at the raceways cannot keep "
                    "all rows rolling; {:.3g} % of the ring's speed changes occur in that time{}",
                    is_rolling ? "the balls can be assumed to roll"
                    : std::isfinite(number_at(summary, key + "/skid/row"))
                        ? fmt::format("balls of row {:.0f} may skid", number_at(summary, key + "/skid/row"))
                        : "balls may skid",
                    1e3 * number_at(summary, key + "/skid/time_beyond"),
                    1e3 * number_at(summary, key + "/skid/longest_beyond"), all > 0. ? 100. * beyond / all : 0.,
                    is_rolling ? "" : ", although cage = \"rolling\" assumes pure rolling"));
  const double pivoting = number_at(summary, key + "/gyroscopic/largest_demand");
  if (pivoting > 0.)
    checks.add(
        name + ": gyroscopic pivoting of balls", pivoting <= 1.,
        fmt::format("gyroscopic moments require up to {:.3g} times the available friction at the raceway that needs "
                    "more of it, and exceed it for {:.4g} ms",
                    pivoting, 1e3 * number_at(summary, key + "/gyroscopic/time_beyond")));
}

/// Where contact ellipses leave the raceway, and what balls without inertia leave out.
void check_balls(Checks& checks, const Json& summary, const std::string& name) {
  const Json::json_pointer path("/bearings/" + name + "/rows");
  if (!summary.contains(path)) return;
  double truncation = 0., centrifugal = 0.;
  std::size_t worst = 0, number = 0;
  for (const auto& row : summary.at(path)) {
    ++number;
    if (!row.contains("truncation")) return;
    if (row.at("truncation").get<double>() > truncation) {
      truncation = row.at("truncation").get<double>();
      worst = number;
    }
    centrifugal = std::max(centrifugal, row.at("centrifugal_over_load").get<double>());
  }
  checks.add(name + ": contact ellipses on the raceway", worst == 0,
             worst == 0 ? "none extends beyond the raceway's edge"
                        : fmt::format("those of row {} extend beyond the raceway's edge by up to {:.0f} % of their "
                                      "length: pressure and static safety are not valid there",
                                      worst, 100. * truncation));
  if (summary.at(Json::json_pointer("/bearings/" + name)).value("ball_model", "") == "quasi-static" && centrifugal > 0.)
    checks.add(name + ": centrifugal forces of the balls", centrifugal <= relevant_centrifugal_share,
               fmt::format("{:.2g} times the load of the row's most loaded ball (mean over time weighted by the square "
                           "of the load); ball_model = \"quasi-static\" ignores them",
                           centrifugal));
}

/// The rubbed surfaces, by the replay of the moving band in summary.json.
void check_local_temperature(Checks& checks, const RecordedDrop& drop, const Json& summary, const std::string& name,
                             const TouchdownParameters& b) {
  const std::string title = name + ": local temperature where rotor and bore rub",
                    key = "/bearings/" + name + "/local/";
  const double rise = number_at(summary, key + "bore_rise"), low = number_at(summary, key + "bore_rise_low"),
               high = number_at(summary, key + "bore_rise_high"), time = number_at(summary, key + "bore_rise_time");
  if (!std::isfinite(rise)) {
    checks.unknown(title, "not assessed: there is no summary.json with it");
    return;
  }
  if (!std::isfinite(time)) {
    if (is_on_shoulder(summary, name))
      checks.unknown(title,
                     "not assessed: the bore never rubs, and temperatures where a shoulder rubs are not computed");
    else
      checks.add(title, true, "rotor and bore never rub");
    return;
  }
  const double ambient = drop.parameters().run.ambient, limit = temperature_limit(drop, b.ring);
  if (!std::isfinite(limit)) {
    checks.unknown(title, fmt::format("not assessed: materials.{} has no temperature_limit", b.ring));
    return;
  }
  const std::string verdict = ambient + rise >= limit   ? "above"
                              : ambient + high >= limit ? "below, but the upper bound is above,"
                                                        : "below";
  std::string text = fmt::format(
      "the bore reaches {:.0f} K ({}) at {:.4g} ms, bounds {:.0f} to {:.0f} K (moving heat band, lasting some "
      "milliseconds); {} the {:.0f} K ({}) up to which its material is dimensionally stable",
      ambient + rise, in_celsius(ambient + rise), time * 1e3, ambient + low, ambient + high, verdict, limit,
      in_celsius(limit));
  const double rotor = ambient + number_at(summary, key + "rotor_rise"),
               limit_of_rotor = b.journal ? temperature_limit(drop, *b.journal) : std::nan("");
  if (std::isfinite(limit_of_rotor))
    text += fmt::format("; the rotor reaches {:.0f} K ({}), {} the {:.0f} K of {}", rotor, in_celsius(rotor),
                        rotor >= limit_of_rotor ? "above" : "below", limit_of_rotor, *b.journal);
  const bool is_above = ambient + rise >= limit || rotor >= limit_of_rotor;
  if (is_above)
    checks.add(title, false, text);
  else if (is_on_shoulder(summary, name))
    checks.unknown(title, "not assessed: " + text + "; temperatures where a shoulder rubs are not computed");
  else if (ambient + high >= limit)
    checks.uncertain(title, text);
  else
    checks.add(title, true, text);
}

void check_wear(Checks& checks, const Json& summary, const std::string& name) {
  const std::string key = "/bearings/" + name + "/wear/";
  const double bore = number_at(summary, key + "bore_depth"), drops = number_at(summary, key + "drops_until_limit");
  if (!std::isfinite(bore)) {
    checks.unknown(name + ": wear", "not assessed: there is no summary.json with it");
    return;
  }
  if (!std::isfinite(drops)) {
    if (is_on_shoulder(summary, name))
      checks.unknown(name + ": wear",
                     "not assessed: no wear in the bore, and wear where a shoulder rubs is not computed");
    else
      checks.add(name + ": wear", true, "none: nothing rubs, or the wear coefficients are zero");
    return;
  }
  const bool is_whole = !is_on_shoulder(summary, name);
  const std::string text = fmt::format(
      "largest depth {:.2g} um in the bore and {:.2g} um in the rotor after this drop; {:.2g} such drops "
      "at the same position until {:.3g} um. Wear coefficients are known to a factor of ten at best{}",
      bore * 1e6, number_at(summary, key + "rotor_depth") * 1e6, drops, number_at(summary, key + "depth_limit") * 1e6,
      is_whole ? "" : "; wear at the shoulders is not computed");
  if (is_whole || drops < 1.)
    checks.add(name + ": wear", drops >= 1., text);
  else
    checks.unknown(name + ": wear", text);
}

void check_temperatures(Checks& checks, const RecordedDrop& drop, const std::string& name,
                        const TouchdownParameters& b) {
  const std::string title = name + ": mean temperature of rings and balls" + (b.journal ? " and rotor" : "");
  std::string text, without_limit;
  bool is_below = true;
  std::vector<std::tuple<const char*, std::vector<std::string>, std::string>> parts = {
      {"rings", {"inner_ring", "outer_ring"}, b.ring}, {"balls", {"ball"}, b.ball}};
  // Others are reckoned with the ring's material, whatever they are of.
  if (b.journal) parts.push_back({"rotor", {"shaft"}, *b.journal});
  for (const auto& [part, nodes, material] : parts) {
    double warmest = 0.;
    for (const auto& node : nodes)
      for (const ThermalKind* kind : drop.models())
        if (const auto path = drop.node_path(*kind, name, node); drop.has(path))
          warmest = std::max(warmest, largest_of(drop.series(path)).value);
    if (warmest == 0.) continue;
    const double limit = temperature_limit(drop, material);
    text += fmt::format("{}{} of {} up to {:.4g} K ({})", text.empty() ? "" : "; ", part, material, warmest,
                        in_celsius(warmest));
    if (std::isfinite(limit))
      text += fmt::format(", dimensionally stable up to {:.0f} K ({})", limit, in_celsius(limit));
    else
      without_limit = material;
    is_below = is_below && !(warmest >= limit);
  }
  if (!text.empty() && (without_limit.empty() || !is_below))
    checks.add(title, is_below, text + ". Surfaces that rub are hotter");
  else if (!text.empty())
    checks.unknown(title, fmt::format("not assessed: materials.{} has no temperature_limit", without_limit));
  else
    checks.unknown(title, "not assessed: no thermal model ran");
}

/// Travel of the outer ring in its support.
void check_support(Checks& checks, const Json& summary, const std::string& name) {
  const std::string key = "/bearings/" + name + "/support/";
  const double travel = number_at(summary, key + "largest_travel"), limit = number_at(summary, key + "travel_limit");
  if (!std::isfinite(travel) || (!std::isfinite(limit) && summary.at(Json::json_pointer(key + "type")) == "linear"))
    return;
  const std::string text =
      fmt::format("the outer ring moves by up to {:.4g} µm, at {:.4g} ms; its support ({}) dissipates {:.4g} J",
                  travel * 1e6, number_at(summary, key + "largest_travel_time") * 1e3,
                  summary.at(Json::json_pointer(key + "type")).get<std::string>(), number_at(summary, key + "loss"));
  if (std::isfinite(limit))
    checks.add(name + ": travel of the support", travel <= limit, text + fmt::format("; limit {:.4g} µm", limit * 1e6));
  else
    checks.add(name + ": travel of the support", true, text + "; no limit is given");
}

/// Whether the rotor keeps off magnets, seals and the like.
void check_probes(Checks& checks, const RecordedDrop& drop, const Json& summary) {
  for (const auto& [name, probe] : drop.parameters().rotor.probes) {
    const std::string key = "/probes/" + name + "/", title = name + ": clearance at the probe";
    const double left = number_at(summary, key + "smallest_clearance"),
                 time = number_at(summary, key + "smallest_clearance_time");
    if (!std::isfinite(left))
      checks.unknown(title, "not assessed: there is no summary.json with it");
    else
      checks.add(
          title, left > 0.,
          left > 0.
              ? fmt::format("the rotor does not touch: smallest clearance {:.4g} of {:.4g} µm, at {:.4g} ms",
                            left * 1e6, probe.clearance * 1e6, time * 1e3)
              : fmt::format("the rotor TOUCHES, first at {:.4g} ms, {:.4g} µm beyond the clearance of {:.4g} µm "
                            "at {:.4g} ms, for {:.4g} ms in all{}",
                            number_at(summary, key + "first_touch_time") * 1e3, -left * 1e6, probe.clearance * 1e6,
                            time * 1e3, number_at(summary, key + "time_touching") * 1e3,
                            probe.contact ? fmt::format("; contact force up to {:.4g} kN",
                                                        number_at(summary, key + "contact/peak_contact_force") * 1e-3)
                                          : "; it goes on as if nothing were there"));
  }
}

void check_residual(Checks& checks, const Json& summary, const std::string& name, const std::string& residual,
                    const std::string& whole) {
  const double r = number_at(summary, residual), all = number_at(summary, whole);
  if (!std::isfinite(r)) return;
  checks.add(name, std::fabs(r) <= residual_limit * std::max(std::fabs(all), 1e-3),
             fmt::format("{:.2g} J of {:.5g} J (limit 0.1 %); smaller steps or tolerances leave less", r, all));
}

/// Warnings of the run, except those that a check above words by the same criterion.
void add_warnings(Checks& checks, const Json& summary) {
  static constexpr std::array checked = {"ellipse-truncated", "centrifugal-force", "skidding",          "pivoting",
                                         "backward-whirl",    "support-travel",    "local-temperature", "wear",
                                         "probe-touched"};
  if (!summary.contains("warnings")) return;
  for (const auto& w : summary.at("warnings")) {
    const std::string code = w.at("code").get<std::string>();
    if (std::find(checked.begin(), checked.end(), code) == checked.end()) checks.add(code, false, w.at("text"));
  }
}

}  // namespace

Json report_checks(const RecordedDrop& drop, const Json& summary) {
  Checks checks;
  const double end = drop.parameters().run.latest_end();
  if (summary.is_null()) {
    checks.add("complete", false,
               "there is no summary.json: the run is still going, was killed, or failed; the table below omits values "
               "that only the summary contains");
  } else {
    const bool completed = summary.contains("run") && summary.at("run").value("completed", false);
    checks.add("complete", completed,
               completed ? "the run reached its end"
                         : fmt::format("INTERRUPTED at {} of {}: peak and end values cover this part only",
                                       in_time(number_at(summary, "/run/end_time")), in_time(end)));
    for (const auto& w : summary.value("input_warnings", Json::array()))
      checks.add("case, " + w.at("where").get<std::string>(), false, w.at("message").get<std::string>());
  }
  for (const auto& [name, b] : drop.bearings()) {
    check_clearance(checks, drop, name);
    check_load(checks, drop, name, b);
    check_pressure(checks, drop, summary, name, b);
    if (!summary.is_null()) {
      check_balls(checks, summary, name);
      check_skidding(checks, summary, name, b, drop.parameters().run.initial_speed);
      check_whirl(checks, summary, name);
      check_support(checks, summary, name);
    }
    check_temperatures(checks, drop, name, b);
    check_local_temperature(checks, drop, summary, name, b);
    check_wear(checks, summary, name);
  }
  check_probes(checks, drop, summary);
  if (!summary.is_null()) {
    check_residual(checks, summary, "mechanical energy", "/energy/residual", "/energy/dissipated");
    check_residual(checks, summary, "heat", "/energy/heat_residual", "/energy/heat_deposited");
    check_residual(checks, summary, "heat, finite elements", "/energy/fe_heat_residual", "/energy/heat_deposited");
    check_residual(checks, summary, "heat, windows", "/windows/heat_residual", "/windows/heat_input");
    add_warnings(checks, summary);
  }
  return checks.take();
}

}  // namespace rotordrop
