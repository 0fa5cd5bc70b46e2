#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/facts/thermal_report.h"
#include "study/compare/comparison.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// What a unit of the report looks like on the screen.
struct Scale {
  double factor = 1;
  const char* unit = "K";
};
constexpr Scale kelvin = {1., "K"}, micrometres = {1e6, "um"};

std::string in(const Scale& s, double value) { return fmt::format("{:.3g} {}", value * s.factor, s.unit); }
std::string signed_in(const Scale& s, double value) { return fmt::format("{:+.3g} {}", value * s.factor, s.unit); }
std::string ms(double time) { return fmt::format("{:.4g} ms", time * 1e3); }
/// "0.34 s", "12 ms".
std::string duration(double time) {
  return time < 1. ? fmt::format("{:.3g} ms", time * 1e3) : fmt::format("{:.3g} s", time);
}

std::string words(std::string key) {
  for (char& c : key)
    if (c == '_') c = ' ';
  return key == "ball" ? "balls" : key;
}

/// "5 % of the rise at the time (at least 0.01 K)", "0.1 um".
std::string tolerance_text(const Json& d, const Scale& scale) {
  const std::string floor = in(scale, d["tolerance"].get<double>());
  const double part = d["tolerance_part"].get<double>();
  return part > 0. ? fmt::format("{:.3g} % of the rise at the time (at least {})", 100. * part, floor) : floor;
}

/// "within the tolerance to the end at 300 ms (at most -0.19 K at 12 ms)", "within it until 187 ms; up to -0.19 K (300 ms)".
std::string agreement(const Json& d, const Scale& scale) {
  const std::string largest = fmt::format("{} at {}", signed_in(scale, d["largest_difference"].get<double>()),
                                          ms(d["largest_difference_time"].get<double>()));
  if (d["beyond_from"].is_null())
    return fmt::format("within the tolerance to the end of the run at {} (difference at most {})",
                       ms(d["end"].get<double>()), largest);
  const std::string from = ms(d["beyond_from"].get<double>());
  if (d["within_from"].is_null())
    return fmt::format("within the tolerance until {}; difference up to {}", from, largest);
  return fmt::format("within the tolerance until {} and again from {}; difference up to {}", from,
                     ms(d["within_from"].get<double>()), largest);
}

/// Names of what stays within the tolerance, and sentences for what does not.
void add_agreements(const Json& group, const Scale& scale, const std::string& what, std::vector<std::string>& text) {
  std::vector<std::string> within;
  for (const auto& [key, d] : group.items()) {
    if (d["beyond_from"].is_null())
      within.push_back(words(key));
    else
      text.push_back(fmt::format("{} {}: {}.", what, words(key), agreement(d, scale)));
  }
  if (!within.empty())
    text.push_back(fmt::format("{} {}: within {} to the end of the run at {}.", what, fmt::join(within, ", "),
                               tolerance_text(group.front(), scale), ms(group.front()["end"].get<double>())));
}

/// "until 182 ms (shaft)", "to the end of the run (300 ms)", from the earliest time at which one of a group is beyond its tolerance.
std::string trusted(const Json& group) {
  double first = std::numeric_limits<double>::infinity();
  std::string which;
  for (const auto& [key, d] : group.items())
    if (!d["beyond_from"].is_null() && d["beyond_from"].get<double>() < first) {
      first = d["beyond_from"].get<double>();
      which = words(key);
    }
  if (std::isinf(first)) return fmt::format("to the end of the run ({})", ms(group.front()["end"].get<double>()));
  return fmt::format("until {} ({})", ms(first), which);
}

/// Kinds of the two models of a pair.
struct Kinds {
  const ThermalKind &first, &second;
};
Kinds kinds_of(const Json& b) {
  return {*thermal_kind(b["models"][0].get<std::string>()), *thermal_kind(b["models"][1].get<std::string>())};
}

/// What stands for the second model's growth.
std::string growth_words(const Json& b) {
  if (b["growth_by"] == "elasticity") return "judged by elasticity";
  const auto& second = kinds_of(b).second;
  return second.meshes_sections ? "judged by the formula on the finite elements' means"
                                : "judged by the growth of the " + second.word;
}

/// "290 and 301 N at 10 ms": preload of opposed rows under each model's growth.
std::string effect_words(const Json& b) {
  std::vector<std::string> at;
  const auto [a, c] = kinds_of(b);
  for (const auto& e : b["effect"]) {
    const Json &first = e[a.name], &second = e[c.name];
    if (first["preload"].is_null() || second["preload"].is_null()) continue;
    at.push_back(fmt::format("{:.4g} and {:.4g} N at {} (largest ball load {:.3g} and {:.3g} N)",
                             first["preload"].get<double>(), second["preload"].get<double>(),
                             ms(e["time"].get<double>()), first["largest_ball_load"].get<double>(),
                             second["largest_ball_load"].get<double>()));
  }
  return fmt::format("{}", fmt::join(at, "; "));
}

void add_summary(const Json& b, std::vector<std::string>& text) {
  const auto [first, second] = kinds_of(b);
  Json approach = Json::object();
  approach["balls"] = b["ball_approach"];
  text.push_back(
      fmt::format("In short: the {}'s mean temperatures stay within {}{} {}; its growth, {}, within {} {}, its "
                  "clearances {}, the approach of its races to the balls {}.",
                  first.word, tolerance_text(b["temperatures"].front(), kelvin),
                  second.meshes_sections ? "" : " of those of the " + second.word, trusted(b["temperatures"]),
                  growth_words(b), tolerance_text(b["growth"].front(), micrometres), trusted(b["growth"]),
                  trusted(b["clearances"]), trusted(approach)));
  std::vector<std::string> each, surfaces;
  for (const auto& [name, d] : b["temperatures"].items())
    if (!d["beyond_from"].is_null())
      each.push_back(fmt::format("{} {}", words(name), ms(d["beyond_from"].get<double>())));
  for (const auto& [name, s] : b["surfaces"].items())
    if (const Json& from = s["mean"]["beyond_from"]; !from.is_null())
      surfaces.push_back(fmt::format("{} {}", words(name), ms(from.get<double>())));
  if (each.empty() && surfaces.empty()) return;
  const auto list = [](const std::vector<std::string>& parts) {
    return parts.empty() ? std::string("none") : fmt::format("{}", fmt::join(parts, ", "));
  };
  text.push_back(fmt::format("Beyond the tolerance from: means: {}{}.", list(each),
                             b["surfaces"].empty() ? ""
                                                   : fmt::format("; surfaces (which the {} has no nodes for): {}",
                                                                 first.word, list(surfaces))));
}

/// What the finite elements know and the circuit does not, when a mean temperature leaves its tolerance.
void add_reasons(const Json& b, std::vector<std::string>& text) {
  const auto [circuit, section] = kinds_of(b);
  for (const auto& [name, r] : b["reasons"].items()) {
    std::vector<std::string> reasons;
    if (r.contains("bore_over_ring"))
      reasons.push_back(fmt::format("no node for the bore, which is {} above its ring's mean",
                                    in(kelvin, r["bore_over_ring"].get<double>())));
    for (const char* side : {"inner", "outer"})
      if (const std::string key = std::string(side) + "_contact_over_ring"; r.contains(key))
        reasons.push_back(fmt::format("spreading: {} raceway {} above its ring's mean, the circuit's contact {}", side,
                                      in(kelvin, r[key][section.name].get<double>()),
                                      in(kelvin, r[key][circuit.name].get<double>())));
    if (r.contains("fourier") && r["fourier"].get<double>() < 0.3)
      reasons.push_back(fmt::format("temperatures inside the body not equalised yet (Fourier number {:.2g})",
                                    r["fourier"].get<double>()));
    if (r.contains("biot") && r["biot"].get<double>() > largest_lumped_biot)
      reasons.push_back(
          fmt::format("heat leaves as easily as it spreads (Biot number {:.2g})", r["biot"].get<double>()));
    if (!reasons.empty())
      text.push_back(fmt::format("When {} {} the tolerance ({}): {}.", words(name), name == "ball" ? "leave" : "leaves",
                                 ms(b["temperatures"][name]["beyond_from"].get<double>()), fmt::join(reasons, "; ")));
  }
}

void add_local(const Json& b, std::vector<std::string>& text) {
  const Json& bore = b["bore"];
  if (bore.contains("first_impact") && !bore["largest_local_over_node"]["value"].is_null()) {
    const Json& first = bore["first_impact"];
    std::string line = fmt::format(
        "Local bore temperature, upper bound by the case's heat share (consistent value: bore_rise in the drop's "
        "summary): "
        "the "
        "first impact ({}) sweeps {:.1f} mm of the bore while the ring turns {:.1f} deg; "
        "the hottest point of that arc is up to {} hotter than the circuit's inner ring, at {}",
        duration(first["duration"].get<double>()), first["arc"].get<double>() * 1e3,
        first["ring_angle"].get<double>() * 180. / std::numbers::pi,
        in(kelvin, bore["largest_local_over_node"]["value"].get<double>()),
        ms(bore["largest_local_over_node"]["time"].get<double>()));
    for (const auto& entry : bore["at"])
      if (entry["instant"] != "first impact's peak" && !entry["lumped_node"].is_null())
        line += fmt::format("; at {} {}", ms(entry["time"].get<double>()),
                            in(kelvin, entry["local"].get<double>() - entry["lumped_node"].get<double>()));
    text.push_back(line + ".");
  }
}

void add_models(const Json& b, std::vector<std::string>& text) {
  if (!b["lumps_in_both"].empty()) {
    std::vector<std::string> lumps;
    for (const auto& lump : b["lumps_in_both"]) lumps.push_back(words(lump.get<std::string>()));
    text.push_back(
        fmt::format("These are single lumps in the finite-element model too, so agreement proves little: {}.",
                    fmt::join(lumps, ", ")));
  }
  add_agreements(b["temperatures"], kelvin, "Mean temperature of", text);
  add_reasons(b, text);
  add_agreements(b["growth"], micrometres, "Growth (" + growth_words(b) + ") of", text);
  text.push_back(fmt::format("Approach of the races to the balls: {}.", agreement(b["ball_approach"], micrometres)));
  for (const auto& row : b["row_growth"])
    if (b["row_growth"].size() > 1)
      text.push_back(fmt::format("The same of row {} by itself: {}.", row["row"].get<int>(),
                                 agreement(row["ball_approach"], micrometres)));
  if (const std::string effect = effect_words(b); !effect.empty())
    text.push_back(fmt::format("Preload of the ring without load under the growth of {} and {}: {}.",
                               kinds_of(b).first.word, kinds_of(b).second.word, effect));
  text.push_back(fmt::format("Air gap: {}.", agreement(b["clearances"]["air_gap"], micrometres)));
  if (b["surfaces"].contains("bore"))
    text.push_back(fmt::format("Bore surface (circumferential mean) minus the circuit's inner ring: {}.",
                               agreement(b["surfaces"]["bore"]["mean"], kelvin)));
}

void add_lumping(const Json& b, std::vector<std::string>& text) {
  std::vector<std::string> uneven, early;
  for (const auto& [name, body] : b["lumping"].items()) {
    if (body["biot"].get<double>() > largest_lumped_biot)
      uneven.push_back(fmt::format("{} (Bi {:.2g})", words(name), body["biot"].get<double>()));
    early.push_back(fmt::format("{} {}", words(name), duration(body["evening_time"].get<double>())));
  }
  text.push_back(
      fmt::format("After a heat pulse on one side, a body is uniform to within a tenth (Fo 0.3) after: {}. Before "
                  "that, its single temperature is only a mean and says nothing about the surface.",
                  fmt::join(early, ", ")));
  if (!uneven.empty())
    text.push_back(
        fmt::format("Not at a uniform temperature even in the long run, because heat leaves these bodies as easily as "
                    "it spreads inside (Bi above {:.2g}): {}.",
                    largest_lumped_biot, fmt::join(uneven, ", ")));
}

void add_runs(const Json& report, const Json& b, std::vector<std::string>& text) {
  const Json &runs = b["runs"], &mine = runs["forces"]["this"], &other = runs["forces"]["against"];
  const auto change = [&](const char* key) {
    if (mine[key].is_null() || other[key].is_null()) return std::string("none");
    const double a = mine[key].get<double>(), c = other[key].get<double>();
    return a != 0. ? fmt::format("{:+.3g} %", 100. * (c / a - 1.)) : std::string("none");
  };
  if (runs["ends"]["this"] != runs["ends"]["against"])
    text.push_back(fmt::format("The two runs are compared until {}, the end of the shorter one.",
                               ms(runs["until"].get<double>())));
  text.push_back(
      fmt::format("Growth driver {} in this run, {} in the other: peak force of the first impact {}, peak contact "
                  "force {}, impulse {}, rub heat {}.",
                  report["run"]["driver"].get<std::string>(), report["against"]["driver"].get<std::string>(),
                  change("first_impact_peak"), change("peak_contact_force"), change("impulse"), change("rub_heat")));
  text.push_back(
      fmt::format("Air gap used in the drop, other run minus this run: {}.", agreement(runs["air_gap"], micrometres)));
}

std::string table_row(const std::string& name, const Json& d, const Scale& scale) {
  const auto number = [&](const Json& v) { return fmt::format("{:.4g}", v.get<double>() * scale.factor); };
  const auto time = [](const Json& v, const char* none) {
    return v.is_null() ? std::string(none) : fmt::format("{:.4g}", v.get<double>() * 1e3);
  };
  std::string line = fmt::format("  {:<24} {:>10} {:>9} {:>9} {:>9} |", name, number(d["largest_difference"]),
                                 time(d["largest_difference_time"], "-"), time(d["beyond_from"], "never"),
                                 time(d["within_from"], "not"));
  for (const auto& entry : d["at"]) line += fmt::format(" {:>12}", number(entry["difference"]));
  return line + "\n";
}

std::string table_head(const std::string& title, const Json& d) {
  std::string line = fmt::format("  {:<24} {:>10} {:>9} {:>9} {:>9} |", title, "largest", "at ms", "beyond", "within");
  for (const auto& entry : d["at"]) line += fmt::format(" {:>12}", ms(entry["time"].get<double>()));
  return line + "\n";
}

std::string model_tables(const Json& b) {
  const auto [first, second] = kinds_of(b);
  const std::string difference = second.mark + " - " + first.word;
  std::string text = table_head(difference + " [K]", b["temperatures"]["inner_ring"]);
  for (const auto& [node, d] : b["temperatures"].items()) text += table_row(words(node), d, kelvin);
  for (const auto& [surface, s] : b["surfaces"].items())
    for (const char* column : {"mean", "highest"}) text += table_row(words(surface) + " " + column, s[column], kelvin);
  text += table_head(difference + " [um]", b["growth"]["bore"]);
  for (const auto& [surface, d] : b["growth"].items()) text += table_row("growth " + words(surface), d, micrometres);
  for (const auto& [name, d] : b["clearances"].items()) text += table_row(words(name), d, micrometres);
  text += table_row("ball approach", b["ball_approach"], micrometres);
  return text;
}

std::string bore_table(const Json& bore) {
  std::string text = fmt::format("  {:<24} {:>10} {:>10} {:>10} {:>10} {:>10} {:>9} {:>9}\n", "bore [K]", "circuit",
                                 "mean", "hottest", "contact", "rotor +", "arc mm", "turns");
  const auto kelvins = [](const Json& v) {
    return v.is_null() ? std::string("-") : fmt::format("{:.2f}", v.get<double>());
  };
  for (const auto& e : bore["at"])
    text += fmt::format("  {:<24} {:>10} {:>10} {:>10} {:>10} {:>10} {:>9.2f} {:>9.3f}\n", ms(e["time"].get<double>()),
                        kelvins(e["lumped_node"]), kelvins(e["mean"]), kelvins(e["local"]), kelvins(e["flash"]),
                        kelvins(e["rotor_flash_rise"]), e["arc"].get<double>() * 1e3, e["ring_turns"].get<double>());
  return text;
}

}  // namespace

std::vector<std::string> verdict_of(const Json& report) {
  std::vector<std::string> all;
  for (const auto& [name, b] : report["bearings"].items()) {
    std::vector<std::string> text;
    if (b.contains("temperatures")) add_models(b, text);
    add_lumping(b, text);
    if (b.contains("runs")) add_runs(report, b, text);
    for (const auto& line : text) all.push_back(name + ": " + line);
    if (b.contains("further"))
      for (const auto& [model, pair] : b["further"].items()) {
        text.clear();
        add_models(pair, text);
        for (const auto& line : text) all.push_back(name + ", " + model + ": " + line);
      }
  }
  return all;
}

std::vector<std::string> short_verdict_of(const Json& report) {
  std::vector<std::string> all;
  for (const auto& [name, b] : report["bearings"].items()) {
    std::vector<std::string> text;
    if (b.contains("temperatures")) add_summary(b, text);
    add_local(b, text);
    for (const auto& line : text) all.push_back(name + ": " + line);
    if (b.contains("further"))
      for (const auto& [model, pair] : b["further"].items()) {
        text.clear();
        add_summary(pair, text);
        for (const auto& line : text) all.push_back(name + ", " + model + ": " + line);
      }
  }
  return all;
}

std::string comparison_text(const Json& report) {
  std::string text;
  for (const auto& [name, b] : report["bearings"].items()) {
    text += name + "\n";
    if (b.contains("temperatures")) text += model_tables(b);
    if (b.contains("further"))
      for (const auto& [model, pair] : b["further"].items()) text += model_tables(pair);
    text += bore_table(b["bore"]);
    if (b.contains("runs"))
      for (const auto& [model, nodes] : b["runs"]["temperatures"].items()) {
        text += table_head("other - this, " + model + " [K]", nodes["inner_ring"]);
        for (const auto& [node, d] : nodes.items()) text += table_row(words(node), d, kelvin);
      }
  }
  for (const char* list : {"in_short", "verdict"})
    for (const auto& line : report[list]) text += line.get<std::string>() + "\n";
  return text;
}

}  // namespace rotordrop
