#include "study/many/answers/result_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "study/many/answers/result_names.h"

namespace rotordrop {
namespace {

std::string advice_for(const std::string& name, const std::vector<std::string>& names) {
  const std::string guess = closest_name(name, names);
  return (guess.empty() ? "" : fmt::format("Did you mean \"{}\"?  ", guess)) +
         "Names are those of summary.json (docs/reference/results.md), such as bearings.TB1.peak_contact_force; * "
         "stands for any "
         "text without a dot.";
}

std::optional<double> bound(const Study& study, const Limit& limit, const std::string& name, const std::string& text,
                            Faults& faults) {
  if (text.empty()) return {};
  const std::string unit = unit_of_result(study, name);
  auto kind = kind_of(unit.empty() ? "1" : unit);
  if (kind == QuantityKind::temperature) kind = QuantityKind::temperature_difference;  // results are rises
  const auto value = convert_to_si(text, unit.empty() ? "1" : unit, kind, "limits." + name);
  if (value) return value.value;
  faults.add(limit.where, value.error + ".", value.advice);
  return {};
}

}  // namespace

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
  return std::any_of(study.keep_results.begin(), study.keep_results.end(), is_meant) ||
         std::any_of(study.limits.begin(), study.limits.end(), [&](const Limit& l) { return is_meant(l.pattern); }) ||
         std::any_of(study.derived.begin(), study.derived.end(), [&](const auto& d) { return d.name == name; }) ||
         (study.choice && study.choice->result == name) || (study.minimise && study.minimise->result == name) ||
         std::find(study.surrogate_results.begin(), study.surrogate_results.end(), name) !=
             study.surrogate_results.end();
}

void resolve_results(Study& study, const std::vector<std::string>& names) {
  Faults faults;
  const auto is_known = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const auto& pattern : study.keep_results)
    if (std::none_of(names.begin(), names.end(), [&](const auto& name) { return fits(name, pattern); }))
      faults.add({study.file.string(), 0, 0}, fmt::format("keep.results: no result is called \"{}\".", pattern),
                 advice_for(pattern, names));
  if (study.choice && !is_known(study.choice->result))
    faults.add(study.choice->where,
               fmt::format("choose.result = \"{}\": no result is called so.", study.choice->result),
               advice_for(study.choice->result, names));
  for (const auto& name : study.surrogate_results)
    if (!is_known(name))
      faults.add({study.file.string(), 0, 0}, fmt::format("surrogate.results: no result is called \"{}\".", name),
                 advice_for(name, names));
  if (study.minimise && !is_known(study.minimise->result))
    faults.add({study.file.string(), 0, 0},
               fmt::format("minimise.result = \"{}\": no result is called so.", study.minimise->result),
               advice_for(study.minimise->result, names));
  std::vector<Limit> resolved;
  for (const auto& limit : study.limits) {
    const std::size_t before = resolved.size();
    for (const auto& name : names) {
      if (!fits(name, limit.pattern)) continue;
      Limit one = limit;
      one.pattern = name;
      one.max = bound(study, limit, name, limit.max_text, faults);
      one.min = bound(study, limit, name, limit.min_text, faults);
      resolved.push_back(std::move(one));
    }
    if (resolved.size() == before)
      faults.add(limit.where,
                 fmt::format("limits.{}: no result is called so, so the limit is on nothing.", limit.pattern),
                 advice_for(limit.pattern, names));
  }
  faults.throw_if_any();
  study.limits = std::move(resolved);
}

}  // namespace rotordrop
