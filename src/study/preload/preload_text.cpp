// What `rotordrop preload` says on the screen.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/rotation.h"
#include "study/preload/preload_run.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

double number(const Json& j, const char* key) { return j[key].get<double>(); }
double celsius(double kelvin) { return kelvin - 273.15; }

std::string duration(double seconds) {
  if (seconds < 120.) return fmt::format("{:.3g} s", seconds);
  if (seconds < 7200.) return fmt::format("{:.3g} min", seconds / 60.);
  return fmt::format("{:.3g} h", seconds / 3600.);
}

std::string hottest(const Json& temperatures) {
  std::string name;
  double highest = -HUGE_VAL;
  for (const auto& [node, T] : temperatures.items())
    if (T.get<double>() > highest) {
      highest = T.get<double>();
      name = node;
    }
  return fmt::format("{} {:.1f} degC", name, celsius(highest));
}

std::string state_text(const Json& s) {
  if (s["floating"].get<bool>())
    return fmt::format("no ball in contact, {:.3g} um clearance left; heat {:.4g} W",
                       number(s, "radial_clearance") * 1e6, number(s, "heat"));
  return fmt::format("preload {:.4g} N, ball load {:.4g} N, pressure {:.3g} GPa, heat {:.4g} W", number(s, "preload"),
                     number(s, "largest_ball_load"), number(s, "largest_pressure") * 1e-9, number(s, "heat"));
}

std::string critical_text(const Json& critical) {
  std::string text;
  const auto add = [&](const char* key, auto words) {
    if (!critical.contains(key) || critical[key].is_null()) return;
    const auto& c = critical[key];
    text += fmt::format("{}{} ({})", text.empty() ? "" : "; ", words(number(c, "value"), number(c, "factor")),
                        c["by"] == "limit"       ? "set by a limit"
                        : c["by"] == "loop gain" ? "set by the loop gain"
                                                 : "no steady state beyond");
  };
  add("speed", [](double value, double) { return fmt::format("up to {:.5g} rpm", value * to_rpm); });
  add("preload", [](double value, double) { return fmt::format("up to {:.4g} N mounted preload", value); });
  add("cooling", [](double, double factor) { return fmt::format("down to {:.3g} times this cooling", factor); });
  return text.empty() ? "" : "  a stable operating point exists " + text + "\n";
}

/// @param is_where_it_settled  told where there are several
std::string point_text(const Json& p, bool is_where_it_settled) {
  const double gain = number(p, "loop_gain"), rate = p["eigenvalue"][0].get<double>();
  const bool is_folded = p["eigenvalue_of_held_heat"][0].get<double>() >= 0.;
  std::string text =
      fmt::format("  operating point{}: {}\n    hottest {}; loop gain {:.3g}",
                  is_where_it_settled ? ", where it settles" : "", state_text(p), hottest(p["temperatures"]), gain);
  // Where steady states fold back over the heat, a stable point has a gain above 1.
  if (is_folded)
    text += " where steady states fold back";
  else if (p["stable"].get<bool>())
    text += fmt::format(" (margin {:.3g})", 1. - gain);
  if (p["stable"].get<bool>())
    text += fmt::format(", stable; disturbances decay e-fold in {}", duration(-1. / rate));
  else
    text += fmt::format(", unstable; disturbances grow e-fold in {}", duration(1. / rate));
  return text + "\n";
}

/// Where the search for operating points ended for want of a steady state, or had gaps.
std::string search_text(const Json& search) {
  std::string text;
  if (search["ended_by"] == "no_steady_state")
    text += fmt::format("  the search for operating points ends at {:.4g} W: no steady state was found beyond\n",
                        number(search, "largest_heat"));
  if (const int n = search["without_steady_state"].get<int>(); n > 0)
    text += fmt::format("  at {} heats of the search for operating points no steady state was found\n", n);
  return text;
}

std::string running_text(const std::string& name, const Json& r) {
  const auto verdict = r["verdict"].get<std::string>();
  if (verdict == "failed") return fmt::format("{}: not computed: {}\n", name, r["message"].get<std::string>());
  const auto& end = r["end"];
  const std::string after = duration(number(end, "time"));
  std::string text = fmt::format("{} at {:.6g} rpm: ", name, number(r, "speed") * to_rpm);
  if (verdict == "stable")
    text += fmt::format("stable. It settles in {} at\n  {}\n", after, state_text(end["state"]));
  else if (verdict == "undecided")
    text += fmt::format("undecided after {}: {}.\n  {}\n", after,
                        end["settled"].get<bool>() ? "it settled where the criterion finds no stable point"
                                                   : "it neither settled nor reached a limit by preload.end_time",
                        state_text(end["state"]));
  else {
    const std::string limit = end["limit"] == "pressure_limit"
                                  ? fmt::format("{:.3g} GPa", number(r["limits"], "pressure") * 1e-9)
                                  : fmt::format("{:.4g} degC", celsius(number(r["limits"], "temperature")));
    if (verdict == "seized-from-the-start")
      text += fmt::format("already beyond {} when cold.\n  {}\n", limit, state_text(end["state"]));
    else
      text +=
          fmt::format("runs away: {} reached after {}.\n  state then: {}\n", limit, after, state_text(end["state"]));
    if (verdict == "runs-away-on-the-way")
      text += "  A stable operating point exists, but warm-up from cold does not reach it.\n";
    else if (verdict == "runs-away")
      text += !r["operating_points"].empty() ? "  No stable operating point within the limits.\n"
              : r["search"]["ended_by"] == "no_steady_state"
                  ? "  No operating point was found.\n"
                  : "  No operating point within the limits: at every temperature friction generates more heat than "
                    "is lost.\n";
  }
  text += fmt::format("  cold: {}\n", state_text(r["cold"]));
  if (r["cold"]["neglects_centrifugal"].get<bool>())
    text += fmt::format(
        "  warning: centrifugal forces are {:.2g} times the ball loads when cold, and ball_model = \"quasi-static\" "
        "leaves them out\n",
        number(r["cold"], "centrifugal_over_load"));
  const auto& points = r["operating_points"];
  for (std::size_t i = 0; i < points.size(); ++i)
    text += point_text(points[i], points.size() > 1 && end["operating_point"] == i);
  text += search_text(r["search"]);
  text += critical_text(r["critical"]);
  if (!r["load_law_sees_preload"].get<bool>())
    text +=
        "  Without a contact angle the load law ignores balls loaded uniformly all round: the verdict covers only the "
        "heat of that law.\n";
  return text;
}

std::string maps_text(const Json& maps) {
  std::string text;
  for (const auto& [name, map] : maps.items()) {
    if (!map["preload"].is_null())
      text += fmt::format("  map of {}: preload {:.4g} to {:.4g} N, pressure to {:.3g} GPa\n", name,
                          number(map["preload"], "smallest"), number(map["preload"], "largest"),
                          number(map["largest_pressure"], "largest") * 1e-9);
    if (const int n = map["without_equilibrium"].get<int>(); n > 0)
      text += fmt::format("    {} points without an equilibrium are NaN\n", n);
  }
  return text;
}

std::string history_text(const Json& h) {
  return fmt::format(
      "  over the drop {}: preload {:.4g} N at the start, largest {:.4g} N at {:.4g} ms, {:.4g} N at the end; largest "
      "ball "
      "load {:.4g} N, pressure {:.3g} GPa; smallest clearance {:.3g} um\n",
      h["results_of"].get<std::string>(), number(h["preload"], "start"), number(h["preload"], "largest"),
      number(h["preload"], "time") * 1e3, number(h["preload"], "end"), number(h["largest_ball_load"], "largest"),
      number(h["largest_pressure"], "largest") * 1e-9, number(h["radial_clearance"], "smallest") * 1e6);
}

}  // namespace

std::string preload_text(const Json& report) {
  std::string text;
  for (const auto& [name, b] : report["bearings"].items()) {
    text += running_text(name, b["running"]) + maps_text(b["maps"]);
    if (b.contains("history")) text += history_text(b["history"]);
  }
  return text;
}

}  // namespace rotordrop
