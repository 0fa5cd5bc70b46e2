#include "study/many/search/search_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/parameters/suggestion.h"
#include "base/units.h"
#include "study/many/answers/statistics.h"
#include "study/many/search/fit_evaluation.h"
#include "study/many/search/search_space.h"

namespace rotordrop {
namespace {

bool has_range(const VariedParameter& p) {
  return p.distribution.kind == Distribution::Kind::uniform || p.distribution.kind == Distribution::Kind::log_uniform;
}

/// Parameters that [minimise] names, or all with a range.
std::vector<std::size_t> searched_parameters(const Study& study, const Node& over, Faults& faults) {
  const auto drawn = study.drawn();
  std::vector<std::size_t> found;
  if (over.is(Node::Kind::null)) {
    for (std::size_t j = 0; j < drawn.size(); ++j)
      if (has_range(study.parameters[drawn[j]])) found.push_back(j);
    return found;
  }
  if (!over.is_array() || over.items().empty()) {
    faults.add(over.where(), "minimise.over must be a list of names of [vary].", "For example over = [\"damping\"].");
    return found;
  }
  std::vector<std::string> names;
  for (const auto j : drawn) names.push_back(study.parameters[j].name);
  for (const auto& item : over.items()) {
    const std::string name = item.is_text() ? item.text() : to_text(item);
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) {
      faults.add(item.where(), fmt::format("minimise.over: \"{}\" is not varied.", name), suggestion(name, names));
      continue;
    }
    const auto j = static_cast<std::size_t>(at - names.begin());
    if (!has_range(study.parameters[drawn[j]]))
      faults.add(item.where(), fmt::format("minimise.over: {} has no range in which it could be searched.", name),
                 "Write { range = [from, to] }, with scale = \"log\" for a range of decades; between given values "
                 "[choose] compares.");
    if (std::find(found.begin(), found.end(), j) != found.end())
      faults.add(item.where(), fmt::format("minimise.over names {} twice.", name));
    found.push_back(j);
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// A reference that is written beside a range is where the first search starts.
void check_references(const Study& study, Faults& faults) {
  const auto drawn = study.drawn();
  for (const auto j : study.searched) {
    const auto& p = study.parameters[drawn[j]];
    if (!p.reference || !p.reference->is_number() || !has_range(p)) continue;
    const auto& d = p.distribution;
    if (!is_in_range(d, p.reference->number()))
      faults.add(p.reference->where(),
                 fmt::format("vary.{}: the search starts at reference = {}, but the range is {} to {}{}.", p.name,
                             shortest(p.reference->number()), shortest(d.lower), shortest(d.upper),
                             p.unit().empty() || p.unit() == "1" ? "" : " " + p.unit()),
                 "Choose a reference in the range, or leave it out: the search then starts at the case's value.");
  }
}

/// Of a method that always starts in the middle of the ranges.
void check_without_start(Study& study, const Node& tree, Faults& faults) {
  const std::string method = name_of(study.minimise->method);
  if (study.minimise->searches > 1)
    faults.add(
        position_of_value(*tree.find("minimise"), "searches"),
        fmt::format("minimise.searches = {}: the searches of method = \"{}\" would all be the same, from the middle "
                    "of the ranges.",
                    study.minimise->searches, method),
        "Remove searches and give more evaluations, or choose a method that starts at several places.");
  const auto drawn = study.drawn();
  for (const auto j : study.searched)
    if (const auto& p = study.parameters[drawn[j]]; p.reference)
      study.base.warnings.push_back(
          {p.reference->where(),
           fmt::format(
               "vary.{}: the reference has no effect, since minimise.method = \"{}\" starts in the middle of the "
               "ranges.",
               p.name, method),
           "Remove it, or choose a method that starts there."});
}

void read_fit(Study& study, const Node& tree, Faults& faults) {
  const SourcePosition where = position_of(tree, "fit");
  const auto& keys = study.fit->keys;
  study.searched = searched_parameters(study, Node(), faults);
  check_references(study, faults);
  if (study.searched.empty() || study.searched.size() < study.drawn().size())
    faults.add(where, "[fit] needs a range for every parameter of [vary] that has no formula.",
               "Write KEY = { range = [from, to] }; what is known belongs into the case.");
  if (keys.measured.empty())
    faults.add(where, "[fit] has nothing measured.", "Add a table [[fit.measured]] with file and series.");
  for (const auto& m : keys.measured)
    if (m.deviation.has_value() != keys.measured.front().deviation.has_value())
      faults.add(where, "measured.deviation is given for some series only.",
                 "Give it for all, or for none: then what differs at the end tells the noise.");
  for (const auto& [is_there, name] :
       {std::pair{study.minimise.has_value(), "[minimise]"}, std::pair{study.choice.has_value(), "[choose]"},
        std::pair{!study.limits.empty(), "[limits]"}})
    if (is_there) faults.add(where, fmt::format("a study has either [fit] or {}.", name), "Remove one of them.");
  if (study.n_replicates > 1)
    faults.add(where, "[fit] takes no replicates: it compares one drop with the measured one.", "Remove [replicates].");
  if (study.design.size)
    faults.add(position_of_value(*tree.find("design"), "size"),
               "[fit] has no sample, so design.size has no meaning here.", "Remove size.");
  if (keys.evaluations < static_cast<int>(study.searched.size()) + 4)
    faults.add(
        position_of_value(*tree.find("fit"), "evaluations"),
        fmt::format("fit.evaluations = {} is too few for {} parameters.", keys.evaluations, study.searched.size()),
        "The first step takes one for the start, one for each parameter and three for the step.");
  faults.throw_if_any();
}

/// Without the noise's deviation a series is divided by the spread of its values, which must then have one.
void check_spread(const Measured& m, const SourcePosition& where) {
  if (m.deviation || varies(m.data.values)) return;
  throw InputError(where,
                   fmt::format("the {} values of {} in {} that are compared do not vary, so that they do not tell what "
                               "a difference from them weighs.",
                               m.data.values.size(), m.name, m.keys.file),
                   "Give deviation, the standard deviation of the noise, for all series, or leave this one out.");
}

}  // namespace

void read_measured_series(Study& study, const Node& tree, const std::filesystem::path& folder, bool is_of_study) {
  Fit& fit = *study.fit;
  const Node* tables = tree.find("fit") ? tree.find("fit")->find("measured") : nullptr;
  if (!tables) return;
  for (std::size_t k = 0; k < fit.keys.measured.size(); ++k) {
    if (!is_of_study)
      fit.measured.push_back(read_measured(fit.keys.measured[k], folder, tables->items()[k].where()));
    else
      fit.measured.push_back(described(fit.keys.measured[k]));
  }
  if (is_of_study) read_measured_of(folder, fit.measured);
  // Drops may end at different times, but their differences must be of the same instants: those until the latest end of the case.
  const double end = study.base.parameters.run.latest_end();
  for (std::size_t k = 0; k < fit.measured.size(); ++k) {
    if (fit.measured[k].data.empty()) continue;
    leave_out_after(fit.measured[k], end, tables->items()[k].where());
    if (!is_of_study) check_spread(fit.measured[k], tables->items()[k].where());
    if (const auto text = left_out_text(fit.measured[k], end); !text.empty())
      study.base.warnings.push_back({tables->items()[k].where(), text, "Set until, or let the drop run on."});
  }
}

std::size_t Study::evaluations_of_search() const {
  // Those of a fit end with one at the values found, and two for the derivatives by each parameter.
  return static_cast<std::size_t>(fit ? fit->keys.evaluations : minimise->evaluations) +
         (fit ? 1 + 2 * searched.size() : 0);
}
std::size_t Study::n_searches() const {
  return static_cast<std::size_t>(fit ? fit->keys.searches : minimise->searches);
}

void read_search(Study& study, const Node& tree, Faults& faults) {
  if (!study.is_search()) return;
  if (study.fit) return read_fit(study, tree, faults);
  const SourcePosition where = position_of(tree, "minimise");
  study.searched = searched_parameters(study, study.minimise->over, faults);
  check_references(study, faults);
  if (study.searched.empty())
    faults.add(where, "[minimise] has nothing to search: no parameter of [vary] has a range.",
               "Write KEY = { range = [from, to] }.");
  if (study.choice) faults.add(where, "a study has either [minimise] or [choose].", "Remove one of them.");
  if (!study.limits.empty() && !takes_limits(study.minimise->method))
    faults.add(position_of_value(*tree.find("minimise"), "method"),
               fmt::format("minimise.method = \"{}\" takes no limits.", name_of(study.minimise->method)),
               "Choose cobyla or isres, or remove [limits], here and in the case.");
  if (study.minimise->method == MinimiseMethod::bobyqa && study.searched.size() == 1)
    faults.add(position_of_value(*tree.find("minimise"), "method"),
               "minimise.method = \"bobyqa\" needs two parameters at least.", "Choose cobyla or subplex.");
  if (!takes_start(study.minimise->method)) check_without_start(study, tree, faults);
  const auto kind = study.design.kind;
  if (study.searched.size() == study.drawn().size() && study.design.size)
    faults.add(position_of_value(*tree.find("design"), "size"),
               "design.size has no meaning here: [minimise] searches all parameters, so none is sampled.",
               "Remove size, or name in minimise.over those that are searched.");
  if (study.searched.size() < study.drawn().size() && kind != DesignKind::grid && kind != DesignKind::latin_hypercube &&
      kind != DesignKind::sobol_sequence && kind != DesignKind::monte_carlo)
    faults.add(position_of_value(tree, "design"),
               fmt::format("design.kind = \"{}\" is no sample of the parameters that are not searched.", name_of(kind)),
               "Choose latin-hypercube, sobol-sequence, monte-carlo or grid.");
  for (const auto& c : study.correlations)
    for (const auto j : {c.first, c.second})
      if (std::find(study.searched.begin(), study.searched.end(), j) != study.searched.end())
        faults.add(position_of(tree, "correlation"),
                   fmt::format("{} is searched, so it cannot be correlated with another parameter.",
                               study.parameters[study.drawn()[j]].name));
  faults.throw_if_any();
}

}  // namespace rotordrop
