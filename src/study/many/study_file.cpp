#include "study/many/study_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include "base/parameters/suggestion.h"
#include "case/keys/entry_settings.h"
#include "case/program_files.h"
#include "case/slips/kinds_of_files.h"
#include "case/slips/slips.h"
#include "io/text/input_file.h"
#include "io/text/toml_reader.h"
#include "study/many/common_values.h"
#include "study/many/derived_results.h"
#include "study/many/search/search_check.h"
#include "study/many/search/search_space.h"
#include "study/many/study_keys.h"
#include "study/many/study_names.h"
#include "study/many/vary_reader.h"

namespace rotordrop {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> texts_of(const Node& node, const std::string& name, Faults& faults,
                                  const std::string& example = "bearings.*.peak_contact_force") {
  std::vector<std::string> texts;
  if (node.is(Node::Kind::null)) return texts;
  if (!node.is_array()) {
    faults.add(node.where(), name + " must be a list of texts.", fmt::format("For example [\"{}\"].", example));
    return texts;
  }
  for (const auto& item : node.items()) {
    if (item.is_text())
      texts.push_back(item.text());
    else
      faults.add(item.where(), fmt::format("{}: {} is not a text.", name, to_text(item)));
  }
  return texts;
}

fs::path case_of(const StudyFile& raw, const Node& tree, const fs::path& file) {
  const fs::path beside = file.parent_path() / raw.case_file;
  std::error_code ignored;
  if (fs::is_regular_file(beside, ignored)) return beside;
  const fs::path own = params_folder() / raw.case_file;
  if (fs::is_regular_file(own, ignored)) return own;
  throw InputError(position_of_value(tree, "case"), fmt::format("case = \"{}\": there is no such file.", raw.case_file),
                   fmt::format("Looked for {} and {}.", beside.string(), own.string()));
}

void read_correlations(const std::vector<CorrelationEntry>& entries, const SourcePosition& where, Study& study,
                       Faults& faults) {
  const auto drawn = study.drawn();
  for (const auto& entry : entries) {
    const auto names = texts_of(entry.parameters, "correlation.parameters", faults);
    if (names.size() != 2) {
      faults.add(where, "correlation.parameters must name two parameters of [vary].");
      continue;
    }
    std::vector<std::size_t> found;
    for (const auto& name : names)
      for (std::size_t i = 0; i < drawn.size(); ++i)
        if (study.parameters[drawn[i]].name == name) found.push_back(i);
    if (found.size() != 2 || found[0] == found[1])
      faults.add(entry.parameters.where(),
                 fmt::format("correlation.parameters = [{}]: these are not two parameters that [vary] draws.",
                             fmt::join(names, ", ")));
    else
      study.correlations.push_back({found[0], found[1], entry.rank});
  }
}

bool is_sample(DesignKind kind) {
  return kind == DesignKind::latin_hypercube || kind == DesignKind::sobol_sequence || kind == DesignKind::monte_carlo;
}

/// A reference that is written beside a distribution with ends is a point of one-at-a-time.
void check_references(const Study& study, Faults& faults) {
  for (const auto i : study.drawn()) {
    const auto& p = study.parameters[i];
    const auto& d = p.distribution;
    if (!p.reference || !p.reference->is_number() || !d.has_ends() || is_in_range(d, p.reference->number())) continue;
    faults.add(p.reference->where(),
               fmt::format("vary.{}: reference = {} is not in the range from {} to {}{}.", p.name,
                           shortest(p.reference->number()), shortest(d.lower), shortest(d.upper),
                           p.unit().empty() || p.unit() == "1" ? "" : " " + p.unit()),
               "Choose a reference in the range, or leave it out: it is then the case's value.");
  }
}

void check_design(const Study& study, const Node& tree, Faults& faults) {
  const Node* table = tree.find("design");
  const SourcePosition where = table ? table->where() : SourcePosition{study.file.string(), 0, 0};
  const auto& design = study.design;
  const bool has_size =
      is_sample(design.kind) || design.kind == DesignKind::saltelli || design.kind == DesignKind::morris;
  const std::string kind = name_of(design.kind);
  const bool has_sample = study.searched.size() < study.drawn().size();
  if (has_size && !design.size && has_sample)
    faults.add(where, fmt::format("design.kind = \"{}\" needs design.size.", kind), "For example size = 100.");
  if (!has_size && design.size)
    faults.add(table ? position_of_value(*table, "size") : where,
               fmt::format("design.kind = \"{}\" takes no size: it follows from the values.", kind), "Remove size.");
  const auto drawn = study.drawn();
  if (drawn.empty()) faults.add(where, "[vary] draws no parameter.", "Name at least one key with values or a range.");
  if (design.kind == DesignKind::list) {
    std::set<std::size_t> lengths;
    for (const auto i : drawn) {
      const auto& p = study.parameters[i];
      if (p.distribution.is_continuous())
        faults.add(p.where, fmt::format("{} has no values, which design.kind = \"list\" needs.", p.name),
                   "Write KEY = [first, second, ...].");
      lengths.insert(p.distribution.values.size());
    }
    if (lengths.size() > 1)
      faults.add(where, fmt::format("design.kind = \"list\" needs as many values of every parameter; they have {}.",
                                    fmt::join(lengths, ", ")));
  }
  if (design.kind == DesignKind::one_at_a_time) check_references(study, faults);
  if (design.kind == DesignKind::morris && design.levels.value_or(4) % 2 != 0)
    faults.add(position_of_value(*table, "levels"), "design.levels of a Morris design must be an even number.",
               "Choose 4, 6 or 8.");
  if (!study.correlations.empty() && !is_sample(design.kind))
    faults.add(where,
               fmt::format("design.kind = \"{}\" needs independent parameters, but there is a [[correlation]].", kind),
               "Use latin-hypercube, sobol-sequence or monte-carlo, whose rank-based indices need no independence.");
  if ((design.kind == DesignKind::sobol_sequence && drawn.size() > 3667) ||
      (design.kind == DesignKind::saltelli && 2 * drawn.size() > 3667))
    faults.add(where, "the Sobol sequence has 3667 dimensions.");
}

/// What makes the values of a parameter continuous: itself, or a parameter in its formula. Null: it takes given values only.
const VariedParameter* continuous_source(const Study& study, const VariedParameter& p) {
  if (p.distribution.is_continuous()) return &p;
  for (const auto i : p.formula_of)
    if (study.parameters[i].distribution.is_continuous()) return &study.parameters[i];
  return nullptr;
}

void check_choice(const Study& study, Faults& faults) {
  if (!study.choice) return;
  std::vector<std::string> names;
  const VariedParameter* found = nullptr;
  for (const auto& p : study.parameters) {
    names.push_back(p.name);
    if (p.name == study.choice->parameter) found = &p;
  }
  if (!found)
    faults.add(study.choice->where, fmt::format("choose.parameter = \"{}\" is not varied.", study.choice->parameter),
               suggestion(study.choice->parameter, names, fmt::format("Varied: {}.", fmt::join(names, ", "))));
  else if (const auto* drawn = continuous_source(study, *found);
           drawn && study.design.kind != DesignKind::grid && study.design.kind != DesignKind::one_at_a_time)
    faults.add(study.choice->where,
               fmt::format("choose.parameter = \"{}\" needs values, between which the study chooses{}.", found->name,
                           found->formula ? fmt::format("; by its formula it follows {}", drawn->name) : ""),
               fmt::format("Write {} = [first, second, ...] under [vary].", drawn->name));
}

/// Keys that an override sets: one, or those of the table that it gives.
std::vector<std::string> keys_set_by(const Setting& setting) {
  if (names_entry(setting)) return {setting.key};
  Node tree = Node::table();
  apply_setting(tree, setting);
  std::vector<std::string> names;
  for (const auto& entry : flattened(tree, {})) names.push_back(entry.name);
  return names;
}

/// Overrides of what the study varies would be without effect.
void require_effect(const std::vector<std::string>& overrides, const Study& study, Faults& faults) {
  for (const auto& assignment : overrides) {
    const Setting setting = read_setting(assignment);
    for (const auto& name : keys_set_by(setting))
      if (std::ranges::any_of(study.parameters, [&](const auto& parameter) {
            return std::ranges::any_of(parameter.keys, [&](const auto& key) { return key.name == name; });
          }))
        faults.add({"--set " + setting.key, 0, 0},
                   fmt::format("the study varies {}, so that this would be without effect.", name),
                   fmt::format("Leave it out, or take the parameter out of [vary] in {}.", study.file.string()));
  }
}

}  // namespace

std::string name_of(DesignKind kind) {
  static const char* const names[] = {"grid",     "list",   "one-at-a-time", "latin-hypercube", "sobol-sequence",
                                      "saltelli", "morris", "monte-carlo",   "search"};
  return names[static_cast<std::size_t>(kind)];
}

bool VariedParameter::is_numeric() const {
  return formula || distribution.is_continuous() ||
         std::all_of(distribution.values.begin(), distribution.values.end(),
                     [](const Node& value) { return value.is_number(); });
}

std::vector<std::size_t> Study::drawn() const {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (!parameters[i].formula) result.push_back(i);
  return result;
}

std::vector<ErasedSection> study_sections() { return {study_section().erased()}; }

Study read_study(const fs::path& file, const std::vector<std::string>& overrides, const fs::path& case_file) {
  Study study;
  study.file = file;
  study.name = file.stem().string();
  study.set = overrides;
  look_for_file(file);
  study.text = read_input_file(file);
  const Node tree = read_toml(file);
  require_kind(tree, file, FileKind::study);
  Faults faults;
  const StudyFile raw = study_section().read(tree, faults);
  faults.throw_if_any();
  study.case_file = case_file.empty() ? case_of(raw, tree, file) : case_file;
  study.base = read_case(study.case_file, overrides);
  study.cases = std::make_shared<const CaseFamily>(study.case_file);
  study.design = raw.design;
  study.on_failure = raw.on_failure;
  study.lanes_asked = raw.lanes;
  study.n_replicates = raw.replicates.n;
  study.replicate_spread = raw.replicates.spread;
  read_vary(raw.vary, study, faults);
  require_effect(overrides, study, faults);
  read_limits(raw.limits, study.limits, faults);
  // Those of the case hold in each of its drops, unless the study has others. A fit judges no drop.
  const std::vector<Limit> own_limits = study.limits;
  look_at_limits(own_limits, study.base.warnings);
  for (Limit limit : study.base.parameters.limits) {
    for (const auto text : {&Limit::max_text, &Limit::min_text})
      if (std::any_of(own_limits.begin(), own_limits.end(),
                      [&](const Limit& own) { return fits(limit.pattern, own.pattern) && !(own.*text).empty(); }))
        (limit.*text).clear();
    if (!raw.fit && !(limit.max_text.empty() && limit.min_text.empty())) study.limits.push_back(limit);
  }
  read_derived(raw.derived, study, faults);
  study.keep_results = texts_of(raw.keep.results, "keep.results", faults);
  study.keep_series = texts_of(raw.keep.series, "keep.series", faults, "/bearings/TB1/orbit");
  if (raw.choice)
    study.choice = Choice{raw.choice->parameter, raw.choice->result, raw.choice->quantile, position_of(tree, "choose")};
  read_correlations(raw.correlations, position_of(tree, "correlation"), study, faults);
  study.surrogate = raw.surrogate;
  if (raw.surrogate)
    study.surrogate_results =
        texts_of(raw.surrogate->results, "surrogate.results", faults, "bearings.TB1.peak_contact_force");
  study.minimise = raw.minimise;
  if (raw.fit) study.fit = Fit{*raw.fit, {}};
  check_names(study, tree, faults);
  faults.throw_if_any();
  for (const auto& parameter : study.parameters) {
    std::vector<std::string> keys;
    for (const auto& key : parameter.keys) keys.push_back(key.name);
    for (auto& warning : common_values_without_effect(study.base, keys, parameter.where))
      study.base.warnings.push_back(std::move(warning));
  }
  read_search(study, tree, faults);
  // The directory of a study holds what was measured; the files that the study names may be elsewhere by then.
  if (study.fit) read_measured_series(study, tree, file.parent_path(), !case_file.empty());
  check_design(study, tree, faults);
  check_choice(study, faults);
  if (study.surrogate && (study.is_search() || !study.correlations.empty() ||
                          !(is_sample(study.design.kind) || study.design.kind == DesignKind::saltelli)))
    faults.add(position_of(tree, "surrogate"), "[surrogate] needs a sample of independent parameters.",
               "Choose design.kind latin-hypercube, sobol-sequence, monte-carlo or saltelli, without [[correlation]].");
  faults.throw_if_any();
  return study;
}

}  // namespace rotordrop
