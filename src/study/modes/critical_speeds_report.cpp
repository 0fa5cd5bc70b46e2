#include "study/modes/critical_speeds_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/quantity_list.h"
#include "base/rotation.h"
#include "base/units.h"
#include "study/modes/modes_report.h"

namespace rotordrop {
namespace {

double positive_quantity(const std::string& text, const char* option, const std::string& unit, QuantityKind kind,
                         const std::string& what) {
  const auto read = convert_to_si(text, unit, kind, what);
  if (!read) throw InputError({option, 0, 0}, read.error, read.advice);
  if (!(read.value > 0.)) throw InputError({option, 0, 0}, fmt::format("{} must be larger than 0.", what));
  return read.value;
}

std::vector<double> map_of(const std::string& text) {
  const auto ends = quantities_in(text, "--map", "N/m", QuantityKind::plain, "a stiffness");
  if (ends.size() != 2)
    throw InputError({"--map", 0, 0}, fmt::format("\"{}\" is not a range of stiffness: its two ends are needed.", text),
                     "Write it as: --map '1e6 N/m, 1e9 N/m'");
  const double from = ends[0], to = ends[1];
  if (!(from > 0.)) throw InputError({"--map", 0, 0}, "a stiffness must be larger than 0.");
  if (!(to > from))
    throw InputError({"--map", 0, 0}, "the second stiffness is not larger than the first.", "Exchange them.");
  std::vector<double> stiffness;
  constexpr int n = 61;
  for (int k = 0; k < n; ++k) stiffness.push_back(from * std::pow(to / from, static_cast<double>(k) / (n - 1)));
  return stiffness;
}

}  // namespace

CriticalSpeedOptions critical_speed_options(const Case& rotor_case, const CriticalSpeedQuestion& question) {
  CriticalSpeedOptions options;
  const double operating = std::abs(rotor_case.parameters.run.initial_speed);
  if (!question.up_to.empty())
    options.up_to = positive_quantity(question.up_to, "--up-to", "rad/s", QuantityKind::angular_speed, "a speed");
  else if (operating > 0.)
    options.up_to = 2. * operating;
  else
    throw InputError({"--up-to", 0, 0}, "the case's run.initial_speed is 0, so the range of speeds is open.",
                     "Give it: --up-to '20000 rpm'");
  if (!question.stiffness.empty())
    options.stiffness = positive_quantity(question.stiffness, "--stiffness", "N/m", QuantityKind::plain, "a stiffness");
  if (!question.map.empty()) options.map = map_of(question.map);
  return options;
}

nlohmann::ordered_json critical_speeds_json(const Case& rotor_case, const CriticalSpeedReport& report,
                                            const CriticalSpeedOptions& options) {
  const double operating = std::abs(rotor_case.parameters.run.initial_speed);
  nlohmann::ordered_json j;
  j["case"] = rotor_case.name;
  j["units"] = {{"speed", "rad/s"},   {"frequency", "Hz"}, {"damping_ratio", "1"},       {"separation", "1"},
                {"stiffness", "N/m"}, {"up_to", "rad/s"},  {"operating_speed", "rad/s"}, {"divergence_rate", "1/s"}};
  const auto& supports = rotor_case.parameters.bearings;
  const bool has_magnets = std::any_of(supports.begin(), supports.end(), [](const auto& s) { return s.magnet(); });
  j["supports"] = report.stations.empty()        ? "free-free"
                  : report.is_on_given_stiffness ? "isotropic springs of --stiffness"
                  : has_magnets                  ? "the case's linear supports and magnets"
                                                 : "the case's linear supports";
  j["stations"] = report.stations;
  if (!report.left_out.empty()) j["left_out"] = report.left_out;
  if (options.stiffness) j["stiffness"] = *options.stiffness;
  j["up_to"] = options.up_to;
  j["operating_speed"] = operating;
  if (rotor_case.parameters.run.initial_speed < 0.) j["spin"] = "negative";
  j["critical_speeds"] = nlohmann::ordered_json::array();
  for (const auto& one : report.speeds) {
    nlohmann::ordered_json entry = {{"speed", one.speed},
                                    {"frequency", one.speed / two_pi},
                                    {"whirl", std::string(to_string(one.whirl))},
                                    {"damping_ratio", one.damping_ratio}};
    if (operating > 0.) entry["separation"] = one.speed / operating - 1.;
    j["critical_speeds"].push_back(std::move(entry));
  }
  j["overdamped_modes"] = report.n_overdamped;
  j["diverging_modes"] = report.n_diverging;
  j["divergence_rate"] = report.divergence_rate;
  j["rigid_body_modes"] = report.n_rigid_body_modes;
  if (!report.map_stiffness.empty()) {
    j["map"] = nlohmann::ordered_json::array();
    for (std::size_t k = 0; k < report.map_stiffness.size(); ++k)
      j["map"].push_back({{"stiffness", report.map_stiffness[k]}, {"speeds", report.map_speeds[k]}});
  }
  return j;
}

std::string critical_speeds_text(const Case& rotor_case, const nlohmann::ordered_json& j) {
  const std::string held_by = supports_with_stiffness(rotor_case.parameters);
  const bool is_on_own = j["supports"].get<std::string>().starts_with("the case's");
  std::string text = fmt::format("Critical speeds up to {:.6g} rpm{}; supports: {}", j["up_to"].get<double>() * to_rpm,
                                 j.contains("spin") ? " of negative spin" : "",
                                 is_on_own ? "the case's " + held_by : j["supports"].get<std::string>());
  if (j.contains("stiffness")) text += fmt::format(" {:.4g} N/m", j["stiffness"].get<double>());
  for (std::size_t k = 0; k < j["stations"].size(); ++k)
    text += (k ? ", " : " at ") + j["stations"][k].get<std::string>();
  text += "\n";
  if (j["critical_speeds"].empty())
    text += "  none in this range\n";
  else
    text += fmt::format("  {:>12}  {:>12}  {:<8}  {:>10}  {}\n", "speed", "frequency", "whirl", "damping",
                        j["operating_speed"].get<double>() > 0. ? "from the operating speed" : "");
  for (const auto& one : j["critical_speeds"]) {
    text += fmt::format("  {:>8.1f} rpm  {:>9.3f} Hz  {:<8}  {:>8.4f} %", one["speed"].get<double>() * to_rpm,
                        one["frequency"].get<double>(), one["whirl"].get<std::string>(),
                        100. * one["damping_ratio"].get<double>());
    if (one.contains("separation")) text += fmt::format("  {:+8.1f} %", 100. * one["separation"].get<double>());
    text += "\n";
  }
  if (j["overdamped_modes"].get<int>() > 0)
    text += fmt::format("Overdamped at the highest speed: {} motions, which have no critical speed.\n",
                        j["overdamped_modes"].get<int>());
  if (const int n = j["diverging_modes"].get<int>(); n > 0)
    text += "At the highest speed: " + diverging_text(n, j["divergence_rate"].get<double>());
  if (j["rigid_body_modes"].get<int>() > 0)
    text += fmt::format("Rigid-body motions at 0 Hz: {}, which have no critical speed.\n",
                        j["rigid_body_modes"].get<int>());
  if (j["supports"] == "free-free")
    text += "The case has no linear supports or magnets. --stiffness \"5e7 N/m\" puts springs at its bearings.\n";
  if (j.contains("left_out")) text += left_out_text(j["left_out"].get<std::vector<std::string>>());
  return text;
}

}  // namespace rotordrop
