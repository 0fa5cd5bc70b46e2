#include "study/result_limits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "base/parameters/suggestion.h"
#include "base/units.h"
#include "case/keys/dotted_names.h"
#include "study/json_number.h"
#include "study/result_names.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

void collect(const Json& value, const std::string& path, SummaryNumbers& to) {
  for (const char* other :
       {"title", "note", "run.wall_time", "run.cpu_time", "input_warnings", "warnings", "limits", "second_opinion"})
    if (path == other) return;
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items()) collect(inner, path.empty() ? key : path + "." + key, to);
  } else if (value.is_array()) {
    std::size_t i = 0;
    for (const auto& inner : value) collect(inner, fmt::format("{}[{}]", path, i++), to);
  } else if (value.is_boolean()) {
    to.emplace_back(path, value.get<bool>() ? 1. : 0.);
  } else if (value.is_number()) {
    to.emplace_back(path, value.get<double>());
  } else if (value.is_null()) {
    to.emplace_back(path, std::numeric_limits<double>::quiet_NaN());
  } else if (const auto text = value.is_string() ? value.get<std::string>() : ""; text == "yes" || text == "no") {
    to.emplace_back(path, text == "yes" ? 1. : 0.);
  }
}

/// Whether a unit counts from another zero than kelvin does, as degC and degF.
bool has_offset(const std::string& text) {
  char* rest = nullptr;
  std::strtod(text.c_str(), &rest);
  const auto zero = convert_to_si(std::string("0") + rest, "K", QuantityKind::temperature);
  return zero && zero.value != 0.;
}

/// "110 degC" as a limit of a rise: a temperature, or a rise of 110 K?
void refuse_offset(const Limit& limit, const std::string& name, const std::string& text, Faults& faults) {
  const auto rise = convert_to_si(text, "K", QuantityKind::temperature_difference),
             temperature = convert_to_si(text, "K", QuantityKind::temperature);
  constexpr double usual_ambient = 293.15;
  const std::string above =
      temperature && temperature.value > usual_ambient
          ? fmt::format("\"{:.6g} K\" for {} at run.ambient = 20 degC", temperature.value - usual_ambient, text)
          : std::string("the temperature less run.ambient");
  faults.add(
      limit.where,
      fmt::format("limits.{}: the result is a temperature rise, but \"{}\" counts from another zero.", name, text),
      fmt::format("Write a rise in kelvin: {}{}.", above,
                  rise ? fmt::format(", or \"{:.6g} K\" if a rise by so much was meant", rise.value) : ""));
}

std::optional<double> bound(const Limit& limit, const std::string& name, const std::string& text, std::string unit,
                            Faults& faults) {
  if (text.empty()) return {};
  if (unit.empty()) unit = "1";
  auto kind = kind_of(unit);
  if (kind == QuantityKind::temperature && name != "run.ambient") {
    kind = QuantityKind::temperature_difference;  // all other results are rises
    if (has_offset(text)) {
      refuse_offset(limit, name, text, faults);
      return {};
    }
  }
  const auto value = convert_to_si(text, unit, kind, "limits." + name);
  if (value) return value.value;
  faults.add(limit.where, value.error + ".", value.advice);
  return {};
}

/// How much of a limit is used; null where a ratio says nothing: of other signs, or of zero.
Json usage(double value, double limit, bool is_max) {
  const double part = is_max ? value : limit, whole = is_max ? limit : value;
  return part >= 0. && whole > 0. ? json_number(part / whole) : Json(nullptr);
}

std::string with_unit(const Json& value, const Json& unit) {
  return in_words(value.get<double>(), unit.get<std::string>());
}

/// "bearings.*.static_safety" of bearings.TB1.static_safety.
std::string of_any_bearing(const std::string& name) {
  constexpr std::string_view group = "bearings.";
  if (!name.starts_with(group)) return name;
  const auto dot = name.find('.', group.size());
  return dot == std::string::npos ? name : std::string(group) + "*" + name.substr(dot);
}

std::set<std::string> words_of(const std::string& name) {
  std::set<std::string> words;
  std::string word;
  for (const char c : name + ".")
    if (std::isalpha(static_cast<unsigned char>(c))) {
      word += c;
    } else {
      words.insert(word);
      word.clear();
    }
  for (const char* every : {"", "bearings"}) words.erase(every);
  return words;
}

/// Those of which most words are in a name; none if no word is.
std::vector<std::string> with_words_of(const std::string& name, const std::vector<std::string>& names) {
  std::size_t most = 1;
  std::vector<std::string> best;
  const auto asked = words_of(name);
  for (const auto& one : names) {
    const auto words = words_of(one);
    const auto n = static_cast<std::size_t>(
        std::count_if(asked.begin(), asked.end(), [&](const auto& word) { return words.contains(word); }));
    if (n > most) best.clear();
    if (n < most) continue;
    most = n;
    best.push_back(one);
  }
  return best;
}

/// " = 4.1 kN"; a value without which a limit is met has no end.
std::string value_in_words(const Json& limit) {
  if (limit["value"].is_number()) return " = " + with_unit(limit["value"], limit["unit"]);
  return limit["accepted"].is_null() ? ": no value" : ": no limit found";
}

/// "; the rotor touched nothing" of what is not assessed.
std::string why_not_assessed(const Json& limit) {
  const std::string why = limit["accepted"].is_null() && limit.contains("why") ? limit["why"].get<std::string>() : "";
  return why.empty() || why == "no value" ? "" : "; " + why;
}

/// "; between 127 K and 604 K" of a result that is known within bounds.
std::string bounds_in_words(const Json& limit) {
  if (!limit.contains("low")) return {};
  return fmt::format("; between {} and {}", with_unit(limit["low"], limit["unit"]),
                     with_unit(limit["high"], limit["unit"]));
}

/// "; 4.1 N to 4.3 N in 3 drops" where a second opinion has the result.
std::string range_in_words(const Json& opinion, const Json& limit) {
  if (!opinion.is_object()) return {};
  for (const auto& r : opinion["results"])
    if (r["key"] == limit["key"] && r["spread"].is_number())  // in all drops
      return fmt::format("; {} to {} in {} drops", with_unit(r["lowest"], limit["unit"]),
                         with_unit(r["highest"], limit["unit"]), opinion["neighbours"].get<int>() + 1);
  return {};
}

/// Bounds that no value can meet together. @param limits  each of one result
void refuse_empty_bands(const std::vector<Limit>& limits, Faults& faults) {
  for (const auto& upper : limits)
    for (const auto& lower : limits)
      if (upper.max && lower.min && upper.pattern == lower.pattern && *lower.min > *upper.max)
        faults.add(lower.where,
                   fmt::format("limits.{}: min = {} is larger than max = {}, so no drop meets both.", lower.pattern,
                               lower.min_text, upper.max_text),
                   upper.where == lower.where ? "Exchange them, or check their units."
                                              : fmt::format("The max is at {}.", to_string(upper.where)));
}

}  // namespace

SummaryNumbers numbers_of(const Json& summary) {
  SummaryNumbers numbers;
  collect(summary, "", numbers);
  return numbers;
}

std::string advice_on_result(const std::string& name, const std::vector<std::string>& names) {
  constexpr std::size_t most_shown = 6;
  std::vector<std::string> of_any;
  for (const auto& one : names)
    if (const auto any = of_any_bearing(one); std::find(of_any.begin(), of_any.end(), any) == of_any.end())
      of_any.push_back(any);
  std::string rest;
  if (auto alike = with_words_of(of_any_bearing(name), of_any); !alike.empty()) {
    alike.resize(std::min(alike.size(), most_shown));
    rest = fmt::format("Results with such words: {}.\n", fmt::join(alike, ", "));
  }
  rest +=
      "Names are those of summary.json (docs/reference/results.md), such as bearings.TB1.peak_contact_force; * stands "
      "for any text without a dot.";
  const bool is_of_any = name.find('*') != std::string::npos;
  return suggestion(is_of_any ? of_any_bearing(name) : name, is_of_any ? of_any : names, rest);
}

std::vector<Limit> resolved_limits(const std::vector<Limit>& limits, const std::vector<std::string>& names,
                                   const std::function<std::string(const std::string&)>& unit_of, Faults& faults) {
  std::vector<Limit> resolved;
  const auto is_named = [&](const std::string& name, std::string Limit::*text) {
    return std::any_of(limits.begin(), limits.end(),
                       [&](const Limit& limit) { return limit.pattern == name && !(limit.*text).empty(); });
  };
  for (const auto& limit : limits) {
    bool is_on_something = false;
    for (const auto& name : names) {
      if (!fits(name, limit.pattern)) continue;
      is_on_something = true;
      Limit one = limit;
      one.pattern = name;
      // What names the result itself goes before what names it with others.
      if (limit.pattern != name && is_named(name, &Limit::max_text)) one.max_text.clear();
      if (limit.pattern != name && is_named(name, &Limit::min_text)) one.min_text.clear();
      one.max = bound(limit, name, one.max_text, unit_of(name), faults);
      one.min = bound(limit, name, one.min_text, unit_of(name), faults);
      if (!one.max_text.empty() || !one.min_text.empty()) resolved.push_back(std::move(one));
    }
    if (!is_on_something)
      faults.add(limit.where,
                 fmt::format("limits.{}: no result is called so, so the limit is on nothing.", limit.pattern),
                 advice_on_result(limit.pattern, names));
  }
  refuse_empty_bands(resolved, faults);
  return resolved;
}

Json assessed(const std::vector<Limit>& limits, const SummaryNumbers& numbers, bool is_complete) {
  Json list = Json::array();
  const auto number = [&](const std::string& name) {
    const auto found = std::find_if(numbers.begin(), numbers.end(), [&](const auto& n) { return n.first == name; });
    return found == numbers.end() ? std::nan("") : found->second;
  };
  for (const auto& limit : limits) {
    const double value = number(limit.pattern), low = number(limit.pattern + "_low"),
                 high = number(limit.pattern + "_high");
    for (const bool is_max : {true, false}) {
      const auto& bound = is_max ? limit.max : limit.min;
      if (!bound) continue;
      const LimitVerdict verdict =
          is_complete ? verdict_on(limit, is_max, value, numbers) : LimitVerdict{{}, "the run was interrupted"};
      list.push_back({{"key", limit.pattern},
                      {"value", json_number(value)},
                      {"limit", *bound},
                      {"kind", is_max ? "max" : "min"},
                      {"unit", meaning_of(limit.pattern).unit},
                      {"usage", usage(value, *bound, is_max)},
                      {"accepted", verdict.is_kept ? Json(*verdict.is_kept) : Json(nullptr)},
                      {"why", verdict.is_kept ? Json(nullptr) : Json(verdict.why)}});
      if (std::isfinite(low) && std::isfinite(high)) list.back().update({{"low", low}, {"high", high}});
    }
  }
  return list;
}

Json accepted(const Json& limits) {
  bool all = !limits.empty();
  for (const auto& limit : limits) {
    if (limit["accepted"] == false) return false;
    all = all && limit["accepted"] == true;
  }
  return all ? Json(true) : Json(nullptr);
}

Json assessed(const std::vector<Limit>& limits, const Json& summary, bool is_complete) {
  const auto numbers = numbers_of(summary);
  std::vector<std::string> names;
  for (const auto& number : numbers) names.push_back(number.first);
  Faults faults;
  const auto resolved = resolved_limits(
      limits, names, [](const std::string& name) { return meaning_of(name).unit; }, faults);
  faults.throw_if_any();
  return assessed(resolved, numbers, is_complete);
}

std::string limits_text(const Json& limits, const Json& second_opinion, std::size_t n_warnings) {
  if (limits.empty()) return {};
  const Json all = accepted(limits);
  const auto n_met =
      std::count_if(limits.begin(), limits.end(), [](const Json& limit) { return limit["accepted"] == true; });
  std::string text = fmt::format("Limits: {} of {} met in this drop: {}\n", n_met, limits.size(),
                                 all == true    ? "ACCEPTED"
                                 : all == false ? "REJECTED"
                                                : "not accepted, since not all could be assessed");
  if (n_warnings > 0 && all == true)
    text += fmt::format("  {} of the run above {} no limit; run.warnings = {{ max = 0 }} in [limits] is one\n",
                        n_warnings == 1 ? "the warning" : fmt::format("the {} warnings", n_warnings),
                        n_warnings == 1 ? "is" : "are");
  for (const auto& l : limits) {
    const std::string allowed =
        fmt::format("{} {}", l["kind"] == "max" ? "at most" : "at least", with_unit(l["limit"], l["unit"]));
    const std::string usage =
        l["usage"].is_number() ? fmt::format("{:.3g} %", 100. * l["usage"].get<double>()) : std::string("-");
    text += fmt::format("  {:<12} {:>8}  {}{}, {}{}{}{}\n",
                        l["accepted"] == true    ? "accepted"
                        : l["accepted"] == false ? "REJECTED"
                                                 : "not assessed",
                        usage, l["key"].get<std::string>(), value_in_words(l), allowed, bounds_in_words(l),
                        range_in_words(second_opinion, l), why_not_assessed(l));
  }
  return text;
}

}  // namespace rotordrop
