#include "study/many/derived_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/units.h"
#include "study/many/answers/result_check.h"
#include "study/unit_scale.h"

namespace rotordrop {
namespace {

/// "N" and "m" of "N/m2".
std::vector<std::string> words_of_unit(const std::string& unit) {
  std::vector<std::string> all;
  bool is_in_word = false;
  for (const char c : unit) {
    const bool is_of_word = std::isalpha(static_cast<unsigned char>(c)) || (c & 0x80) != 0 || c == '%' || c == '_';
    if (is_of_word && !is_in_word) all.emplace_back();
    if (is_of_word) all.back() += c;
    is_in_word = is_of_word;
  }
  return all;
}

/// Why a unit is not one of SI without a factor; empty: it is.
std::string why_not_si(const std::string& unit) {
  if (unit == "1" || takes_bare_numbers_only(unit)) return "";
  if (!is_unit(unit)) return "is not a unit that is known.";
  for (const auto& word : words_of_unit(unit)) {
    const auto scale = scale_in_si(word);
    if (scale && scale->zero != 0.) return "counts from another zero than kelvin does.";
    if (!scale || std::fabs(scale->factor - 1.) > 1e-12) return "is not a unit of SI without a factor.";
  }
  return "";
}

/// Unit of a formula whose value grows with its results, all of one unit, or does not change with them; empty: it is not told so.
std::string unit_by_formula(const Study& study, const DerivedResult& derived) {
  const auto& names = derived.formula.names();
  const std::string unit = names.empty() ? "" : unit_of_result(study, names.front());
  if (unit.empty() || std::any_of(names.begin(), names.end(),
                                  [&](const std::string& name) { return unit_of_result(study, name) != unit; }))
    return "";
  const auto value = [&](double scale) {
    std::vector<double> x;
    for (std::size_t i = 0; i < names.size(); ++i) x.push_back(scale * (1.3 + 0.37 * static_cast<double>(i * i)));
    return derived.formula.value(x);
  };
  const double one = value(1.);
  bool grows = std::isfinite(one) && one != 0., stays = grows;
  // Over many orders, so that a constant in max() or min() shows.
  for (const double scale : {1e-15, 1e-6, 1e-2, 3., 1e4, 1e9, 1e15}) {
    const double there = value(scale);
    grows = grows && std::fabs(there - scale * one) <= 1e-9 * std::fabs(scale * one);
    stays = stays && std::fabs(there - one) <= 1e-9 * std::fabs(one);
  }
  return grows ? unit : stays ? "1" : "";
}

void check_unit(const Study& study, const DerivedResult& derived, const SourcePosition& where, Faults& faults) {
  const std::string by_formula = unit_by_formula(study, derived);
  if (const std::string why = why_not_si(derived.unit); !why.empty()) {
    const auto scale = scale_in_si(derived.unit);
    const std::string si = !by_formula.empty() ? by_formula : scale ? scale->unit : "";
    faults.add(where, fmt::format("derived.{}: unit = \"{}\" {}", derived.name, derived.unit, why),
               si.empty() ? "Values are SI: write their unit, such as \"N\" or \"m\", or leave unit out."
                          : fmt::format(
                                "Values are SI: write unit = \"{}\", or scale in the formula and leave unit out.", si));
    return;
  }
  if (by_formula.empty() || derived.unit == "1" || takes_bare_numbers_only(derived.unit) ||
      takes_bare_numbers_only(by_formula) || convert_to_si("1 " + derived.unit, by_formula, kind_of(by_formula)))
    return;
  faults.add(where,
             fmt::format("derived.{}: unit = \"{}\", but the formula gives {}.", derived.name, derived.unit,
                         by_formula == "1" ? "a number without a unit" : by_formula),
             fmt::format("Write unit = \"{}\", or leave it out.", by_formula));
}

}  // namespace

void read_derived(const Node& table, Study& study, Faults& faults) {
  if (table.is(Node::Kind::null)) return;
  if (!table.is_table()) {
    faults.add(table.where(), "derived must be a table.", "Write NAME = { formula = \"...\", unit = \"N\" }.");
    return;
  }
  for (const auto& entry : table.entries()) {
    const Node* formula = entry.value.find("formula");
    const Node* unit = entry.value.find("unit");
    if (!formula || !formula->is_text()) {
      faults.add(entry.where, fmt::format("derived.{} has no formula.", entry.key),
                 "Write { formula = \"max(RESULT, RESULT)\", unit = \"N\" }.");
      continue;
    }
    for (const auto& other : entry.value.entries())
      if (other.key != "formula" && other.key != "unit")
        faults.add(other.where, fmt::format("unknown key \"{}\" in derived.{}.", other.key, entry.key),
                   "Known: formula, unit.");
    if (unit && !unit->is_text()) {
      faults.add(unit->where(), fmt::format("derived.{}: unit is {}; it must be a text.", entry.key, to_text(*unit)),
                 "For example unit = \"N\".");
      continue;
    }
    try {
      study.derived.push_back({entry.key, Expression(formula->text()), unit ? unit->text() : "1", entry.where});
      if (unit) check_unit(study, study.derived.back(), unit->where(), faults);
    } catch (const std::invalid_argument& error) {
      faults.add(formula->where(), fmt::format("derived.{}: {} in \"{}\".", entry.key, error.what(), formula->text()));
    }
  }
}

}  // namespace rotordrop
