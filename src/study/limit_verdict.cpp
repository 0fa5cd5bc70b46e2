#include "study/limit_verdict.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rotordrop {
namespace {

bool tells_touch_of_bearing(const std::string& name) {
  return name.starts_with("bearings.") && name.ends_with(".first_touch_time");
}

bool tells_force_at_probe(const std::string& name) {
  return name.starts_with("probes.") && name.ends_with(".contact.peak_contact_force");
}

/// "bearings.TB1." of all that a bearing has; empty for other results.
std::string bearing_of_result(const std::string& name) {
  constexpr std::string_view group = "bearings.";
  if (!name.starts_with(group)) return {};
  const auto dot = name.find('.', group.size());
  return dot == std::string::npos ? std::string() : name.substr(0, dot + 1);
}

/// Nothing if no number is called so; NaN if it did not happen.
std::optional<double> told_number(const SummaryNumbers& numbers, const std::string& name) {
  const auto found = std::find_if(numbers.begin(), numbers.end(), [&](const auto& n) { return n.first == name; });
  return found == numbers.end() ? std::nullopt : std::optional(found->second);
}

/// NaN also if no number is called so.
double told_value(const SummaryNumbers& numbers, const std::string& name) {
  return told_number(numbers, name).value_or(std::numeric_limits<double>::quiet_NaN());
}

bool is_pressure_or_safety(const std::string& name) {
  return !bearing_of_result(name).empty() &&
         (name.ends_with(".largest_contact_pressure") || name.ends_with(".static_safety"));
}

bool is_fatigue_share(const std::string& name) {
  return !bearing_of_result(name).empty() &&
         (name.ends_with(".damage.fatigue.share") || name.find(".damage.fatigue.rows[") != std::string::npos);
}

/// Whether contact ellipses of a bearing reach over the raceway's edge, or those of the row that a result is of.
bool is_over_the_edge(const std::string& name, const SummaryNumbers& numbers) {
  const bool is_of_row = name.find("].") != std::string::npos;
  const std::string of = is_of_row ? name.substr(0, name.rfind('.') + 1) : bearing_of_result(name);
  return std::any_of(numbers.begin(), numbers.end(), [&](const auto& number) {
    return number.second > 0. && number.first.starts_with(of) && number.first.ends_with(".truncation");
  });
}

constexpr std::array of_contact = {"first_touch_time", "ends_in_first_contact"};
constexpr std::array of_damage = {"damage.assessed",   "damage.pressure_is_void", "damage.rubs_on_shoulder",
                                  "damage.wear_share", "damage.fatigue.share",    "damage.allowed_drops"};

/// A bearing of whose drop nothing was computed that uses it up may be dropped on without end.
bool has_no_end(const std::string& name, const SummaryNumbers& told) {
  const std::string bearing = bearing_of_result(name);
  if (bearing.empty() || name != bearing + "damage.allowed_drops") return false;
  const auto is = [&](const char* what, double value) { return told_value(told, bearing + what) == value; };
  return is("damage.assessed", 1.) && is("damage.pressure_is_void", 0.) && is("damage.rubs_on_shoulder", 0.) &&
         (std::isfinite(told_value(told, bearing + "damage.wear_share")) ||
          std::isfinite(told_value(told, bearing + "damage.fatigue.share")));
}

/// Instants that are known once they have passed.
bool is_instant_of_first_contact(const std::string& name) {
  return name.ends_with(".first_touch_time") || name.ends_with(".first_contact_time") ||
         name.ends_with(".first_shoulder_contact_time");
}

/// Why a bearing's result is not that of a drop on it; empty if it is.
std::string why_no_drop(const std::string& name, const SummaryNumbers& told) {
  const std::string bearing = bearing_of_result(name);
  const auto touch = bearing.empty() ? std::nullopt : told_number(told, bearing + "first_touch_time");
  if (!touch) return {};  // a support of another kind, or results of an earlier version
  if (!std::isfinite(*touch)) return untouched;
  if (is_instant_of_first_contact(name)) return {};
  return told_value(told, bearing + "ends_in_first_contact") == 1. ? in_first_contact : "";
}

constexpr const char* over_the_edge = "contact ellipses reach over the raceway's edge";
constexpr const char* on_shoulder = "the rotor rubs on a shoulder, whose wear is not computed";

/// Why a number is missing.
std::string why_no_value(const std::string& name, const SummaryNumbers& told) {
  const std::string damage = bearing_of_result(name) + "damage.";
  const auto is = [&](const char* what) { return told_value(told, damage + what) == 1.; };
  const bool is_number_of_drops = name == damage + "allowed_drops";
  if (is_number_of_drops && is("pressure_is_void")) return over_the_edge;
  if ((is_number_of_drops || name == damage + "wear_share") && is("rubs_on_shoulder")) return on_shoulder;
  return "no value";
}

/// A value that is not what it is called: the true one is higher or lower.
struct Doubt {
  std::string why;  ///< empty: none
  bool is_higher = false;
};
Doubt doubt_of(const std::string& name, const SummaryNumbers& told) {
  if ((is_pressure_or_safety(name) || is_fatigue_share(name)) && is_over_the_edge(name, told))
    return {over_the_edge, !name.ends_with(".static_safety")};
  const std::string bearing = bearing_of_result(name);
  if (!bearing.empty() && name == bearing + "wear.drops_until_limit" &&
      told_value(told, bearing + "damage.rubs_on_shoulder") == 1.)
    return {on_shoulder, false};
  return {};
}

}  // namespace

bool tells_contact(const std::string& name) { return tells_touch_of_bearing(name) || tells_force_at_probe(name); }

bool is_without_contact(const SummaryNumbers& numbers) {
  bool is_told = false;
  for (const auto& [name, value] : numbers) {
    if ((tells_touch_of_bearing(name) && std::isfinite(value)) || (tells_force_at_probe(name) && value > 0.))
      return false;
    is_told = is_told || tells_contact(name);
  }
  return is_told;
}

bool is_needed_for_verdict(const std::string& name, const std::string& limited) {
  const std::string bearing = bearing_of_result(name);
  if (bearing.empty() || !(limited.starts_with("bearings.") || limited.starts_with("*."))) return false;
  const auto is_of = [&](const auto& list) {
    return std::any_of(list.begin(), list.end(), [&](const char* what) { return name == bearing + what; });
  };
  const bool may_be_any = limited.ends_with("*");
  if (is_of(of_contact)) return true;
  if (is_of(of_damage))
    return may_be_any || limited.find("drops") != std::string::npos || limited.ends_with("wear_share");
  return name.ends_with(".truncation") && (may_be_any || is_pressure_or_safety(limited) || is_fatigue_share(limited));
}

LimitVerdict verdict_on(const Limit& limit, bool is_max, double value, const SummaryNumbers& told) {
  const std::string& name = limit.pattern;
  if (is_without_contact(told)) return {{}, "the rotor touched nothing"};
  const std::string no_drop = why_no_drop(name, told);
  if (!std::isfinite(value) && has_no_end(name, told)) value = std::numeric_limits<double>::infinity();
  if (std::isnan(value)) return {{}, no_drop.empty() ? why_no_value(name, told) : no_drop};
  const bool is_kept = is_max ? value <= *limit.max : value >= *limit.min;
  if (is_kept && !no_drop.empty()) return {{}, no_drop};  // what is broken already stays so
  const Doubt doubt = doubt_of(name, told);
  const bool is_above = is_max != is_kept;  // the bound
  if (!doubt.why.empty() && is_above != doubt.is_higher) return {{}, doubt.why};
  return {is_kept, ""};
}

}  // namespace rotordrop
