#include "study/many/vary_reader.h"

#include "base/parameters/suggestion.h"
#include "base/parameters/value_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>

namespace rotordrop {
namespace {

const std::vector<std::string> words{"keys",  "values", "weights",   "range", "scale",  "distribution", "lower",
                                     "upper", "mean",   "deviation", "mode",  "levels", "reference",    "formula"};

/// Words of continuous distributions.
struct DistributionWords {
  Distribution::Kind kind;
  std::vector<std::string> words;
};
const DistributionWords distributions[] = {
    {Distribution::Kind::uniform, {"lower", "upper"}},
    {Distribution::Kind::log_uniform, {"lower", "upper"}},
    {Distribution::Kind::normal, {"mean", "deviation"}},
    {Distribution::Kind::truncated_normal, {"mean", "deviation", "lower", "upper"}},
    {Distribution::Kind::triangular, {"lower", "mode", "upper"}}};

/// The name nearest to "lognormal" is "normal", which is not meant.
std::string advice_on_distribution(const std::string& word, const std::vector<std::string>& names) {
  const std::string known = fmt::format("Known: {}.", fmt::join(names, ", "));
  std::string letters;
  for (const char c : word)
    if (std::isalpha(static_cast<unsigned char>(c))) letters += static_cast<char>(std::tolower(c));
  if (letters.find("lognorm") == std::string::npos) return suggestion(word, names, known);
  return known +
         "\nA lognormal distribution is given by its quantiles as values = [...], all equally probable: "
         "exp(m + s z) with z = -1.28, -0.52, 0, 0.52, 1.28 is one of five. Between two ends \"log-uniform\" may do.";
}

/// Reads the table of one parameter.
class ParameterReader {
 public:
  ParameterReader(VariedParameter& parameter, Faults& faults) : p_(parameter), faults_(faults) {}

  void read(const Node& node) {
    if (node.is_array()) return read_values(node);
    if (!node.is_table()) {
      if (const auto value = converted(node)) p_.distribution.values.push_back(*value);
      return;
    }
    for (const auto& entry : node.entries())
      if (std::find(words.begin(), words.end(), entry.key) == words.end()) {
        faults_.add(entry.where, fmt::format("unknown key \"{}\" in vary.{}.", entry.key, p_.name),
                    suggestion(entry.key, words, fmt::format("Known here: {}.", fmt::join(words, ", "))));
      }
    if (const Node* levels = node.find("levels")) {
      if (!levels->is(Node::Kind::integer) || levels->integer() < 1 || levels->integer() > 100000)
        fault(*levels, "levels must be an integer from 1 to 100000.");
      else
        p_.levels = static_cast<std::size_t>(levels->integer());
    }
    if (const Node* reference = node.find("reference")) p_.reference = converted(*reference);
    const int n_forms = node.has("values") + node.has("range") + node.has("formula") +
                        (node.has("distribution") && !node.has("values"));
    if (n_forms != 1)
      return fault(
          node, "give either values, a range, a distribution or a formula.",
          "For example { range = [0.1, 0.3] }, or { distribution = \"normal\", mean = 0.2, deviation = 0.02 }.");
    refuse_foreign_words(node);
    if (const Node* values = node.find("values")) {
      if (const Node* kind = node.find("distribution"); kind && (!kind->is_text() || kind->text() != "discrete"))
        fault(*kind, "only distribution = \"discrete\" has values.");
      read_values(*values);
      return read_weights(node);
    }
    if (const Node* formula = node.find("formula")) return read_formula(*formula);
    if (!takes_numbers(node)) return;
    if (const Node* range = node.find("range"))
      read_range(*range, node);
    else
      read_distribution(node);
  }

 private:
  void fault(const Node& at, const std::string& message, const std::string& advice = "") {
    faults_.add(at.where(), fmt::format("vary.{}: {}", p_.name, message), advice);
  }

  /// A value as the case takes it: quantities in SI, everything else as it stands.
  std::optional<Node> converted(const Node& node) {
    const auto& key = p_.keys.front();
    if (key.is_quantity()) {
      const auto value = read_quantity(node, {.unit = key.unit, .kind = key.quantity}, "vary." + p_.name, faults_);
      return value ? std::optional(Node(*value, node.where())) : std::nullopt;
    }
    if (node.is_table() || node.is_array() || node.is(Node::Kind::null)) {
      fault(node, fmt::format("{} is not a single value.", to_text(node)));
      return {};
    }
    if (key.declaration.kind == Declaration::Kind::integer && !node.is(Node::Kind::integer)) {
      fault(node, fmt::format("{} is not an integer.", to_text(node)));
      return {};
    }
    return node;
  }

  void read_values(const Node& list) {
    if (!list.is_array() || list.items().empty())
      return fault(list, "its list of values is empty.", "Give at least one value, or a range = [from, to].");
    for (const auto& item : list.items())
      if (const auto value = converted(item)) p_.distribution.values.push_back(*value);
  }

  /// Known words that mean nothing in this form, such as a mean beside a range.
  void refuse_foreign_words(const Node& table) {
    std::string form = "a range";
    std::vector<std::string> own{"range", "scale", "levels", "reference"};
    if (table.has("values")) {
      form = "a list of values";
      own = {"values", "weights", "distribution", "reference"};
    } else if (table.has("formula")) {
      form = "a formula";
      own = {"formula"};
    } else if (const Node* kind = table.find("distribution")) {
      const auto found = std::find_if(std::begin(distributions), std::end(distributions), [&](const auto& d) {
        return kind->is_text() && kind->text() == name_of(d.kind);
      });
      if (found == std::end(distributions)) return;  // told where it is read
      form = fmt::format("a distribution \"{}\"", kind->text());
      own = {"distribution", "levels", "reference"};
      own.insert(own.end(), found->words.begin(), found->words.end());
    }
    own.emplace_back("keys");
    const bool is_normal = form == "a distribution \"normal\"";  // its ends have a message of their own
    for (const auto& entry : table.entries())
      if (std::find(words.begin(), words.end(), entry.key) != words.end() &&
          std::find(own.begin(), own.end(), entry.key) == own.end() &&
          !(is_normal && (entry.key == "lower" || entry.key == "upper")))
        faults_.add(entry.where, fmt::format("vary.{}: {} means nothing beside {}.", p_.name, entry.key, form),
                    fmt::format("Words of {}: {}.", form, fmt::join(own, ", ")));
  }

  void read_weights(const Node& table) {
    const Node* weights = table.find("weights");
    if (!weights) return;
    auto& d = p_.distribution;
    const std::size_t n = d.values.size();
    const auto read = read_quantities(*weights, {.range = at_least(0)}, n, n, "vary." + p_.name + ".weights", faults_);
    if (!read) return;
    const double sum = std::accumulate(read->begin(), read->end(), 0.);
    if (!(sum > 0.)) return fault(*weights, "the weights sum to zero.");
    for (const double weight : *read) d.weights.push_back(weight / sum);
  }

  void read_formula(const Node& node) {
    if (!node.is_text()) return fault(node, "formula must be a text.", "For example \"2 * contact.air_gap\".");
    try {
      p_.formula.emplace(node.text());
    } catch (const std::invalid_argument& error) {
      fault(node, fmt::format("{} in \"{}\".", error.what(), node.text()));
    }
  }

  bool takes_numbers(const Node& node) {
    const auto& key = p_.keys.front();
    const bool is_free = key.declaration.kind == Declaration::Kind::custom;
    if (key.is_quantity() || is_free) return true;
    fault(node, "this parameter takes no continuous numbers.", "Give it values = [...].");
    return false;
  }

  std::optional<double> number(const Node& node, const std::string& name, const Range& range = {}) {
    const auto& key = p_.keys.front();
    const bool is_width = name == "deviation" && key.quantity == QuantityKind::temperature;
    return read_quantity(node,
                         {.unit = key.unit.empty() ? "1" : key.unit,
                          .kind = is_width ? QuantityKind::temperature_difference : key.quantity,
                          .range = range},
                         "vary." + p_.name + "." + name, faults_);
  }
  std::optional<double> number(const Node& table, const char* name, const Range& range = {}) {
    const Node* node = table.find(name);
    if (node) return number(*node, std::string(name), range);
    fault(table, fmt::format("this distribution needs {}.", name));
    return {};
  }

  void read_range(const Node& range, const Node& table) {
    auto& d = p_.distribution;
    if (!range.is_array() || range.items().size() != 2) return fault(range, "range must be [from, to].");
    const auto lower = number(range.items()[0], std::string("range")),
               upper = number(range.items()[1], std::string("range"));
    const Node* scale = table.find("scale");
    if (scale && (!scale->is_text() || (scale->text() != "log" && scale->text() != "linear")))
      return fault(*scale, "scale must be \"linear\" or \"log\".");
    d.kind = scale && scale->text() == "log" ? Distribution::Kind::log_uniform : Distribution::Kind::uniform;
    if (lower && upper) take_ends(range, *lower, *upper);
  }

  void take_ends(const Node& at, double lower, double upper) {
    auto& d = p_.distribution;
    d.lower = lower;
    d.upper = upper;
    if (!(lower < upper))
      fault(at,
            fmt::format("its range is empty: from {:.6g} to {:.6g}{}.", lower, upper,
                        p_.unit().empty() || p_.unit() == "1" ? "" : " " + p_.unit()),
            "The first number must be smaller than the second one. For one value write KEY = [value].");
    if (d.kind == Distribution::Kind::log_uniform && lower <= 0.) fault(at, "a logarithmic range must be above zero.");
  }

  void read_distribution(const Node& table) {
    const Node& kind = *table.find("distribution");
    auto& d = p_.distribution;
    using K = Distribution::Kind;
    std::vector<std::string> names;
    for (const auto& one : distributions) {
      names.push_back(name_of(one.kind));
      if (kind.is_text() && kind.text() == names.back()) d.kind = one.kind;
    }
    if (d.kind == K::values) {
      names.emplace_back("discrete");
      return fault(kind, fmt::format("there is no distribution {}.", to_text(kind)),
                   advice_on_distribution(kind.is_text() ? kind.text() : "", names));
    }
    std::optional<double> lower, upper;
    if (d.kind != K::normal) {
      lower = number(table, "lower");
      upper = number(table, "upper");
      if (lower && upper) take_ends(table, *lower, *upper);
    } else if (table.has("lower") || table.has("upper")) {
      fault(table, "a normal distribution has no ends.", "With lower and upper it is \"truncated-normal\".");
    }
    if (d.kind == K::normal || d.kind == K::truncated_normal) {
      d.mean = number(table, "mean").value_or(0.);
      d.deviation = number(table, "deviation", positive()).value_or(1.);
      if (d.kind == K::truncated_normal && lower && upper && *lower < *upper) check_truncation(table);
    }
    if (d.kind == K::triangular) {
      d.mode = number(table, "mode").value_or(0.);
      if (lower && upper && !(*lower <= d.mode && d.mode <= *upper))
        fault(table, "mode must lie between lower and upper.");
    }
  }

  void check_truncation(const Node& table) {
    const auto& d = p_.distribution;
    const double nearest = std::clamp(d.mean, d.lower, d.upper);
    if (std::abs(nearest - d.mean) > 8. * d.deviation)
      fault(table,
            "lower and upper lie more than 8 deviations away from the mean: nothing of the distribution is left.");
  }

  VariedParameter& p_;
  Faults& faults_;
};

/// A word in the table of a key of the case that means nothing there, such as min: {} if the name is nothing of the kind.
std::optional<Fault> unknown_word(const std::string& name, const Study& study, const SourcePosition& where) {
  const auto dot = name.rfind('.');
  if (dot == std::string::npos) return {};
  const std::string key = name.substr(0, dot), word = name.substr(dot + 1);
  try {
    declared_key(key, study.base.tree, where);
  } catch (const InputError&) {
    return {};
  }
  return Fault{where, fmt::format("unknown key \"{}\" in vary.{}.", word, key),
               suggestion(word, words,
                          fmt::format("Write {} = {{ range = [from, to] }}, [values], or a distribution with its "
                                      "numbers. Known here: {}.",
                                      key, fmt::join(words, ", ")))};
}

void read_keys(const NamedNode& entry, const Study& study, VariedParameter& parameter, Faults& faults) {
  std::vector<std::pair<std::string, SourcePosition>> names;
  const Node* keys = entry.value->find("keys");
  if (!keys)
    names.emplace_back(entry.name, entry.where);
  else if (keys->is_array())
    for (const auto& key : keys->items()) {
      if (key.is_text())
        names.emplace_back(key.text(), key.where());
      else
        faults.add(key.where(), fmt::format("vary.{}.keys: {} is not a text.", entry.name, to_text(key)));
    }
  if (keys && names.empty())
    faults.add(keys->where(), fmt::format("vary.{}.keys must be a list of keys of the case.", entry.name));
  for (const auto& [name, where] : names) {
    try {
      parameter.keys.push_back(declared_key(name, study.base.tree, where));
    } catch (const InputError& error) {
      const auto word = unknown_word(name, study, where);
      word ? faults.add(*word) : faults.add(error.faults());
    }
  }
  for (const auto& key : parameter.keys)
    if (key.unit != parameter.keys.front().unit)
      faults.add(entry.where,
                 fmt::format("vary.{}: {} is in {}, but {} in {}.", entry.name, key.name,
                             key.unit.empty() ? "no unit" : key.unit, parameter.keys.front().name,
                             parameter.unit().empty() ? "no unit" : parameter.unit()),
                 "One value can be set only into keys of one unit.");
}

void resolve_formulas(Study& study, Faults& faults) {
  for (auto& parameter : study.parameters) {
    if (!parameter.formula) continue;
    for (const auto& name : parameter.formula->names()) {
      std::vector<std::string> known;
      std::optional<std::size_t> found;
      for (std::size_t i = 0; i < study.parameters.size(); ++i) {
        const auto& other = study.parameters[i];
        if (other.formula) continue;
        known.push_back(other.name);
        if (other.name == name) found = i;
      }
      if (found && study.parameters[*found].is_numeric()) {
        parameter.formula_of.push_back(*found);
        continue;
      }
      const std::string advice = advice_on_quotes(*parameter.formula, known);
      faults.add(parameter.where,
                 fmt::format("vary.{}: its formula uses \"{}\", which is not a drawn parameter with numbers.",
                             parameter.name, name),
                 !advice.empty() ? advice : suggestion(name, known, fmt::format("Drawn: {}.", fmt::join(known, ", "))));
    }
  }
}

void find_double_keys(const Study& study, Faults& faults) {
  std::vector<std::string> seen;
  for (const auto& parameter : study.parameters)
    for (const auto& key : parameter.keys) {
      if (std::find(seen.begin(), seen.end(), key.name) != seen.end())
        faults.add(parameter.where, fmt::format("vary.{}: {} is varied twice.", parameter.name, key.name));
      seen.push_back(key.name);
    }
}

}  // namespace

void read_vary(const Node& table, Study& study, Faults& faults) {
  if (!table.is_table()) {
    faults.add(table.where(), "vary must be a table.", "Write [vary] and below it KEY = [values].");
    return;
  }
  for (const auto& entry : flattened(table, words)) {
    VariedParameter parameter;
    parameter.name = entry.name;
    parameter.where = entry.where;
    const std::size_t before = faults.size();
    read_keys(entry, study, parameter, faults);
    if (faults.size() > before || parameter.keys.empty()) continue;
    ParameterReader(parameter, faults).read(*entry.value);
    study.parameters.push_back(std::move(parameter));
  }
  resolve_formulas(study, faults);
  find_double_keys(study, faults);
}

}  // namespace rotordrop
