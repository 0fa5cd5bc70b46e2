#include "study/many/answers/study_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "study/many/answers/fit_summary.h"
#include "study/many/answers/search_summary.h"
#include "study/many/answers/surrogate_summary.h"

// What a study says on the screen.
namespace rotordrop {

namespace {

using Json = nlohmann::ordered_json;

std::string number(const Json& value, const std::string& unit) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_number()) return "?";
  return fmt::format("{:.4g}{}", value.get<double>(), unit.empty() || unit == "1" ? "" : " " + unit);
}

std::string percent(const Json& value) {
  return value.is_number() ? fmt::format("{:.3g}", 100. * value.get<double>()) : std::string("?");
}

/// "; not assessed in 3 more: the rotor touched nothing (2), no value (1)".
std::string not_assessed_text(const Json& limit) {
  if (!limit.contains("undefined_because") || limit["undefined_because"].empty()) return {};
  std::string reasons;
  for (const auto& [why, n] : limit["undefined_because"].items())
    reasons += fmt::format("{}{} ({})", reasons.empty() ? "" : ", ", why, n.get<std::size_t>());
  return fmt::format("; not assessed in {} more: {}", limit["undefined"].get<std::size_t>(), reasons);
}

/// " (2 failed)" of drops without a result.
std::string failed_words(const Json& level) {
  const auto n = level.value("failed", std::size_t{0});
  return n > 0 ? fmt::format(" ({} failed)", n) : std::string();
}

std::string choice_text(const Json& choice) {
  const std::string unit = choice["result_unit"], own = choice["unit"];
  const std::string quantile = percent(choice["quantile"]) + " %";
  std::string text = fmt::format("{} quantile of {} by {}:\n", quantile, choice["result"].get<std::string>(),
                                 choice["parameter"].get<std::string>());
  for (const auto& level : choice["levels"]) {
    std::string without;
    if (const auto n = level["without_result"].get<std::size_t>(); n > 0)
      without += fmt::format(", {} without this result{}", n, failed_words(level));
    if (const auto n = level.value("not_run", std::size_t{0}); n > 0) without += fmt::format(", {} not run", n);
    if (level.value("not_drawn", false)) {
      text += fmt::format("  {:>16}: {:>12}, 0 drops: not drawn\n", number(level["value"], own), "none");
      continue;
    }
    if (!level.contains("quantile")) {
      text += fmt::format("  {:>16}: {:>12}{}\n", number(level["value"], own), "none", without);
      continue;
    }
    const std::string interval =
        level["low"].is_number() || level["high"].is_number()
            ? fmt::format(", 95 % interval {} to {}", number(level["low"], ""), number(level["high"], unit))
            : std::string();
    text += fmt::format("  {:>16}: {:>12}{}; mean {}, {} drops{}{}\n", number(level["value"], own),
                        number(level["quantile"], unit), interval, number(level["mean"], unit),
                        level["n"].get<std::size_t>(), without,
                        choice["best"].is_object() && level["value"] == choice["best"]["value"]
                            ? choice.value("all_drawn", true) ? "  <- smallest" : "  <- smallest of those drawn"
                            : "");
  }
  if (choice["best"].is_null())
    text += "  No level is called smallest: each has drops without this result or not run.\n";
  return text;
}

std::string influence_text(const Json& j, const std::string& result) {
  const bool is_morris = j.contains("morris");
  const char* table = is_morris ? "morris" : "indices";
  if (!j.contains(table) || !j[table].contains(result)) return "";
  const char* key = is_morris ? "mean_magnitude" : j[table][result].front().contains("total") ? "total" : "first";
  std::vector<std::pair<double, std::string>> sorted;
  std::string unknown;
  for (const auto& [name, index] : j[table][result].items())
    if (index[key]["value"].is_number())
      sorted.emplace_back(-index[key]["value"].get<double>(), name);
    else
      unknown += (unknown.empty() ? "; nothing known of " : ", ") + name;
  std::sort(sorted.begin(), sorted.end());
  std::string text;
  for (std::size_t i = 0; i < sorted.size() && i < 4; ++i)
    text += fmt::format("{}{} {:.3g}", i ? ", " : "", sorted[i].second, -sorted[i].first);
  return fmt::format("  {} by {}: {}{}\n", result,
                     is_morris                     ? "mean magnitude of effects"
                     : std::string(key) == "total" ? "total Sobol index"
                                                   : "first index",
                     text.empty() ? "?" : text, unknown);
}

}  // namespace

std::string without_contact_text(const Json& summary) {
  // Summaries of earlier versions do not have it.
  const auto n = summary.value("without_contact", std::size_t{0});
  if (n == 0) return {};
  return fmt::format(
      "{} of {} drops ended before the rotor touched anything: limits leave them out, all else counts them. Check "
      "run.end_time, air gaps and what still holds the rotor.",
      n, summary["done"].get<std::size_t>());
}

std::string failed_text(const Json& summary) {
  const auto n = summary["failed"].get<std::size_t>(), n_done = summary["done"].get<std::size_t>();
  if (n == 0 || summary.contains("fit") || summary.contains("minimise")) return {};
  return fmt::format(
      "{} of {} drops failed: quantiles, means, probabilities and indices are those of the other {}. If drops fail "
      "because of what is asked for, these are not the answer.",
      n, n + n_done, n_done);
}

std::string study_text(const Study& study, const Json& j) {
  std::string text = fmt::format(
      "{} drops: {} done, {} failed{}; {:.4g} s of CPU, {:.3g} s each\n", j["points"].get<std::size_t>(),
      j["done"].get<std::size_t>(), j["failed"].get<std::size_t>(),
      j["not_run"].get<std::size_t>() > 0 ? fmt::format(", {} not run", j["not_run"].get<std::size_t>()) : "",
      j["cpu_time"].get<double>(),
      j["cpu_time"].get<double>() / std::max(1., j["done"].get<double>() + j["failed"].get<double>()));
  for (const auto& told : {failed_text(j), without_contact_text(j)})
    if (!told.empty()) text += told + "\n";
  if (j.contains("fit")) return text + fit_text(j["fit"]);
  if (j.contains("minimise")) return text + minimise_text(j["minimise"]);
  for (const auto& limit : j["limits"]) {
    const std::string unit = limit["unit"];
    std::string bounds;
    if (limit["max"].is_number()) bounds += " above " + number(limit["max"], unit);
    if (limit["min"].is_number()) bounds += (bounds.empty() ? " below " : " or below ") + number(limit["min"], unit);
    text +=
        fmt::format("{}{}: {} of {} drops, {} %{}{}\n", limit["result"].get<std::string>(), bounds,
                    limit["broken"].get<std::size_t>(), limit["n"].get<std::size_t>(), percent(limit["probability"]),
                    limit.contains("low") && limit["low"].is_number()
                        ? fmt::format(" (95 % interval {} to {} %)", percent(limit["low"]), percent(limit["high"]))
                        : "",
                    not_assessed_text(limit));
  }
  if (j.contains("choose")) text += choice_text(j["choose"]);
  std::vector<std::string> asked;
  if (study.choice) asked.push_back(study.choice->result);
  for (const auto& limit : study.limits) asked.push_back(limit.pattern);
  for (const auto& derived : study.derived) asked.push_back(derived.name);
  std::vector<std::string> told;
  std::string influences;
  for (const auto& name : asked) {
    if (std::find(told.begin(), told.end(), name) != told.end() || told.size() >= 6) continue;
    told.push_back(name);
    influences += influence_text(j, name);
  }
  if (!influences.empty()) text += "What matters:\n" + influences;
  if (j.contains("surrogate")) text += surrogate_text(j["surrogate"]);
  return text;
}

}  // namespace rotordrop
