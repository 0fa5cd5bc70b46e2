#include "study/many/study_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "base/dataset_name.h"

namespace rotordrop {
namespace {

/// Columns of study.csv and datasets of study.h5 that every study has.
constexpr std::string_view taken_names[] = {"point",  "design_row", "replicate", "status",
                                            "reason", "search",     "evaluation"};

/// Why a name can be no column; empty: it can.
std::string why_no_name(const std::string& name) {
  if (!is_dataset_name(name) || name == "..")
    return fmt::format("\"{}\" is empty, only dots, or has a slash in it.", name);
  if (std::ranges::find(taken_names, name) != std::end(taken_names))
    return fmt::format("every study has a column \"{}\".", name);
  return "";
}

bool is_key_of_case(const Study& study, const VariedParameter& p) {
  try {
    declared_key(p.name, study.base.tree, p.where);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

void check_parameter(const Study& study, const VariedParameter& p, Faults& faults) {
  if (std::ranges::any_of(p.keys, [&](const DeclaredKey& key) { return key.name == p.name; })) return;
  std::string why = why_no_name(p.name);
  if (why.empty() && is_key_of_case(study, p)) why = "this is the name of a key that it does not set.";
  if (!why.empty()) faults.add(p.where, fmt::format("vary.{}: {}", p.name, why), "Choose another name.");
}

void check_derived(const Study& study, const DerivedResult& derived, Faults& faults) {
  std::string why = why_no_name(derived.name);
  for (const auto& p : study.parameters)
    if (p.name == derived.name ||
        std::ranges::any_of(p.keys, [&](const auto& key) { return key.name == derived.name; }))
      why = "[vary] has a parameter of this name.";
  if (!why.empty()) faults.add(derived.where, fmt::format("derived.{}: {}", derived.name, why), "Choose another name.");
}

}  // namespace

void check_names(const Study& study, const Node& tree, Faults& faults) {
  for (const auto& p : study.parameters) check_parameter(study, p, faults);
  for (const auto& derived : study.derived) check_derived(study, derived, faults);
  std::set<std::string> series;
  const Node* keep = tree.find("keep");
  const SourcePosition where_series =
      keep ? position_of_value(*keep, "series") : SourcePosition{study.file.string(), 0, 0};
  for (const auto& path : study.keep_series)
    if (is_axis_of_times(path))
      faults.add(where_series, fmt::format("keep.series: {} holds the times of other series, which bring them.", path),
                 "Leave it out.");
    else if (!series.insert(path).second)
      faults.add(where_series, fmt::format("keep.series names {} twice.", path), "Name each dataset once.");
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  const auto drawn = study.drawn();
  for (const auto& c : study.correlations)
    if (!pairs.insert(std::minmax(c.first, c.second)).second)
      faults.add(position_of(tree, "correlation"),
                 fmt::format("two [[correlation]] are of {} and {}.", study.parameters[drawn[c.first]].name,
                             study.parameters[drawn[c.second]].name),
                 "Keep one of them.");
}

}  // namespace rotordrop
