#include "study/many/answers/result_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "study/result_limits.h"
#include "study/result_names.h"

namespace rotordrop {

std::string unit_of_result(const Study& study, const std::string& name) {
  for (const auto& derived : study.derived)
    if (derived.name == name) return derived.unit;
  return meaning_of(name).unit;
}

std::string long_name_of_result(const Study& study, const std::string& name) {
  for (const auto& derived : study.derived)
    if (derived.name == name) return derived.formula.text();
  return meaning_of(name).long_name;
}

bool is_kept(const Study& study, const std::string& name) {
  if (study.keep_results.empty()) return true;
  const auto is_meant = [&](const std::string& pattern) { return fits(name, pattern); };
  const auto needs_it = [&](const Limit& l) { return is_needed_for_verdict(name, l.pattern); };
  if (std::any_of(study.limits.begin(), study.limits.end(), needs_it)) return true;
  return tells_contact(name) || std::any_of(study.keep_results.begin(), study.keep_results.end(), is_meant) ||
         std::any_of(study.limits.begin(), study.limits.end(), [&](const Limit& l) { return is_meant(l.pattern); }) ||
         std::any_of(study.derived.begin(), study.derived.end(), [&](const auto& d) { return d.name == name; }) ||
         (study.choice && study.choice->result == name) || (study.minimise && study.minimise->result == name) ||
         std::find(study.surrogate_results.begin(), study.surrogate_results.end(), name) !=
             study.surrogate_results.end();
}

namespace {

/// Advice where one result must be named, and not several.
std::string advice_on_one(const std::string& name, const std::vector<std::string>& names) {
  if (name.find('*') == std::string::npos) return advice_on_result(name, names);
  std::vector<std::string> meant;
  for (const auto& one : names)
    if (fits(one, name)) meant.push_back(one);
  if (meant.empty()) return advice_on_result(name, names);
  constexpr std::size_t most_shown = 6;
  const std::string more = meant.size() > most_shown ? fmt::format(" and {} more", meant.size() - most_shown) : "";
  meant.resize(std::min(meant.size(), most_shown));
  return fmt::format(
      "Here * stands for nothing: name one result. It would be {}{}; a formula under [derived] makes one of several.",
      fmt::join(meant, ", "), more);
}

}  // namespace

void resolve_results(Study& study, const std::vector<std::string>& names) {
  Faults faults;
  const auto is_known = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const auto& pattern : study.keep_results)
    if (std::none_of(names.begin(), names.end(), [&](const auto& name) { return fits(name, pattern); }))
      faults.add({study.file.string(), 0, 0}, fmt::format("keep.results: no result is called \"{}\".", pattern),
                 advice_on_result(pattern, names));
  if (study.choice && !is_known(study.choice->result))
    faults.add(study.choice->where,
               fmt::format("choose.result = \"{}\": no result is called so.", study.choice->result),
               advice_on_one(study.choice->result, names));
  for (const auto& name : study.surrogate_results)
    if (!is_known(name))
      faults.add({study.file.string(), 0, 0}, fmt::format("surrogate.results: no result is called \"{}\".", name),
                 advice_on_one(name, names));
  if (study.minimise && !is_known(study.minimise->result))
    faults.add({study.file.string(), 0, 0},
               fmt::format("minimise.result = \"{}\": no result is called so.", study.minimise->result),
               advice_on_one(study.minimise->result, names));
  auto limits = resolved_limits(
      study.limits, names, [&](const std::string& name) { return unit_of_result(study, name); }, faults);
  faults.throw_if_any();
  study.limits = std::move(limits);
}

void resolve_results(Study& study, const StudyTable& table) {
  if (table.count(PointStatus::done) == 0) return;
  std::vector<std::string> names;
  for (const auto& column : table.results) names.push_back(column.name);
  resolve_results(study, names);
}

}  // namespace rotordrop
