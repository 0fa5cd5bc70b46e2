#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "case/slips/slips.h"

namespace rotordrop {
namespace {

// Results by the last parts of their names. Those that may be wanted either way, such as preload or times, are not here.
constexpr std::array<std::string_view, 5> better_if_large = {
    "static_safety", "smallest_clearance", "clearance.smallest", "allowed_drops", "drops_until_limit"};
constexpr std::array<std::string_view, 22> better_if_small = {"peak_contact_force",
                                                              "mean_contact_force_end",
                                                              "largest_ball_force",
                                                              "largest_contact_pressure",
                                                              "peak_friction_heat_rate",
                                                              "friction_heat",
                                                              "inner_heat",
                                                              "outer_heat",
                                                              "wear_share",
                                                              "fatigue.share",
                                                              "bore_depth",
                                                              "rotor_depth",
                                                              "bore_mean_depth",
                                                              "rotor_mean_depth",
                                                              "bore_rise",
                                                              "bore_rise_high",
                                                              "rotor_rise",
                                                              "support.largest_travel",
                                                              "largest_backward_speed",
                                                              "time_touching",
                                                              "truncation",
                                                              "run.warnings"};

/// Rises of bodies and surfaces, whatever those are called.
bool is_rise(const std::string& name) {
  return name.find("temperature_rise_end.") != std::string::npos || name.find("surface_rise.") != std::string::npos;
}

bool is_of(const std::string& name, std::string_view ending) {
  return name.ends_with(ending) &&
         (name.size() == ending.size() || name[name.size() - ending.size() - 1] == '.');  // not required_static_safety
}

}  // namespace

void look_at_limits(const std::vector<Limit>& limits, std::vector<Fault>& warnings) {
  const auto is_one_of = [](const std::string& name, const auto& endings) {
    return std::any_of(endings.begin(), endings.end(), [&](std::string_view ending) { return is_of(name, ending); });
  };
  const auto has = [&](const std::string& name, std::string Limit::*text) {
    return std::any_of(limits.begin(), limits.end(),
                       [&](const Limit& limit) { return limit.pattern == name && !(limit.*text).empty(); });
  };
  // With both bounds a band is meant.
  for (const auto& limit : limits)
    if (const bool is_large = is_one_of(limit.pattern, better_if_large);
        is_large || is_one_of(limit.pattern, better_if_small) || is_rise(limit.pattern)) {
      const auto given = is_large ? &Limit::max_text : &Limit::min_text,
                 usual = is_large ? &Limit::min_text : &Limit::max_text;
      if ((limit.*given).empty() || has(limit.pattern, usual)) continue;
      warn(warnings, limit.where,
           fmt::format("limits.{} has a {} only: drops with {} values, the better ones, are rejected.", limit.pattern,
                       is_large ? "max" : "min", is_large ? "larger" : "smaller"),
           fmt::format("A limit on it is most often a {0}: {0} = \"{1}\".", is_large ? "min" : "max", limit.*given));
    }
}

}  // namespace rotordrop
