#include "base/parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <stdexcept>

namespace rotordrop {

// ----------------------------------------------------------------------------------------------------------------
// ranges

bool Range::contains(double value) const {
  return (lower_is_open ? value > lower : value >= lower) && (upper_is_open ? value < upper : value <= upper);
}

bool Range::is_any() const { return std::isinf(lower) && std::isinf(upper); }

Range Range::without_lower() const {
  Range range = *this;
  range.lower_is_open = true;
  return range;
}

Range Range::without_upper() const {
  Range range = *this;
  range.upper_is_open = true;
  return range;
}

Range any() { return {}; }
Range positive() { return above(0.0); }
Range at_least(double a) { return {.lower = a}; }
Range above(double a) { return {.lower = a, .lower_is_open = true}; }
Range at_most(double b) { return {.upper = b}; }
Range below(double b) { return {.upper = b, .upper_is_open = true}; }
Range between(double a, double b) { return {.lower = a, .upper = b}; }

std::string to_string(const Range& range, std::string_view unit) {
  const std::string unit_text = unit.empty() || unit == "1" ? "" : fmt::format(" {}", unit);
  const bool has_lower = !std::isinf(range.lower);
  const bool has_upper = !std::isinf(range.upper);
  if (has_lower && has_upper && !range.lower_is_open && !range.upper_is_open)
    return fmt::format("between {} and {}{}", shortest(range.lower), shortest(range.upper), unit_text);
  const std::string lower = fmt::format("{} {}", range.lower_is_open ? ">" : ">=", shortest(range.lower));
  const std::string upper = fmt::format("{} {}", range.upper_is_open ? "<" : "<=", shortest(range.upper));
  if (has_lower && has_upper) return fmt::format("{} and {}{}", lower, upper, unit_text);
  if (has_lower || has_upper) return (has_lower ? lower : upper) + unit_text;
  return "any value";
}

// ---------------------------------------------------------------------------------------------- declarations,
// described

const Declaration* SectionDeclaration::find(std::string_view key) const {
  const auto found =
      std::find_if(declarations.begin(), declarations.end(), [&](const Declaration& d) { return d.key == key; });
  return found == declarations.end() ? nullptr : &*found;
}

namespace {

using Kind = Declaration::Kind;

std::string quoted(const std::vector<std::string>& words, std::string_view separator) {
  std::vector<std::string> result;
  for (const auto& word : words) result.push_back(fmt::format("\"{}\"", word));
  return fmt::format("{}", fmt::join(result, separator));
}

/// "length in m, > 0"; "length in m and > 0" would read as one condition.
std::string quantity_text(const Declaration& d) {
  const std::string name = dimension_name(d.unit, d.quantity_kind);
  const std::string noun = d.unit == "1" ? "number" : name == d.unit ? name : fmt::format("{} in {}", name, d.unit);
  return d.range.is_any() ? noun : fmt::format("{}, {}", noun, to_string(d.range));
}

std::string count_text(const Declaration& d) {
  if (d.min_count == d.max_count) return std::to_string(d.min_count);
  return d.min_count == 0 ? "any number of" : fmt::format("at least {}", d.min_count);
}

std::vector<std::string> keys_of(const SectionDeclaration& section) {
  std::vector<std::string> keys;
  for (const Declaration& d : section.declarations) keys.push_back(d.key);
  return keys;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// Number of insertions, deletions, replacements and swaps of neighbours that turn a into b (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

std::string name_of_table(std::string_view path) {
  return path.empty() ? "at the top level" : fmt::format("in [{}]", path);
}

/// The tables of the whole input that know a key, as "[bearings.NAME]".
void find_tables_with(std::string_view key, const SectionDeclaration& section, const std::string& path,
                      std::vector<std::string>& found) {
  const std::string table = path.empty() ? "the top level" : fmt::format("[{}]", path);
  if (section.find(key) && std::find(found.begin(), found.end(), table) == found.end()) found.push_back(table);
  const ReadContext here{.path = path};
  for (const Declaration& d : section.declarations) {
    const std::string inner = here.name_of(d.key) + (d.kind == Kind::tables || d.kind == Kind::variants ? ".NAME" : "");
    if (d.nested) find_tables_with(key, *d.nested, inner, found);
    for (const VariantDeclaration& variant : d.variants) find_tables_with(key, *variant.section, inner, found);
  }
}

std::string advice_on_unknown(const std::string& word, std::vector<std::string> known, const ReadContext& here) {
  std::string advice;
  if (const std::string close = suggestion(word, known, ""); !close.empty())
    advice = close + "  ";
  else if (here.root) {
    std::vector<std::string> tables;
    find_tables_with(word, *here.root, here.root->name, tables);
    if (!tables.empty()) advice = fmt::format("It is known in {}.  ", fmt::join(tables, " and "));
  }
  std::sort(known.begin(), known.end());
  return advice + fmt::format("Known here: {}.", fmt::join(known, ", "));
}

void add_type_fault(const Node& node, const std::string& name, const std::string& needs, Faults& faults) {
  faults.add(node.where(), fmt::format("{} is {}; it must be {}.", name, kind_name(node), needs));
}

/// What a quantity must be: "a length such as "250 um" or a bare number in m".
std::string needed_quantity(const Declaration& d) {
  if (d.unit == "1") return "a number such as 0.1";
  if (takes_bare_numbers_only(d.unit)) return fmt::format("a bare number in {}", d.unit);
  return fmt::format("{} such as \"{}\" or a bare number in {}",
                     described(d.unit, d.quantity_kind).substr(0, described(d.unit, d.quantity_kind).find(" such as ")),
                     example_of(d.unit, d.quantity_kind), d.unit);
}

/// The declaration of a single quantity with another unit, for the arguments of functions and for custom readers.
Declaration as_declaration(const Quantity& q) {
  Declaration d;
  d.kind = Kind::quantity;
  d.unit = q.unit;
  d.quantity_kind = q.kind.value_or(kind_of(q.unit));
  d.range = q.range;
  d.help = q.help;
  return d;
}

Declaration started(std::string key, Kind kind, const std::string& source, const std::string& help) {
  Declaration d;
  d.key = std::move(key);
  d.kind = kind;
  d.source = source;
  d.help = help;
  return d;
}

template <class Options>
void set_quantity(Declaration& d, const Options& options) {
  d.unit = options.unit;
  d.quantity_kind = options.kind.value_or(kind_of(options.unit));
  d.range = options.range;
}

/// What a user could have written: a bare number as a number, everything else as text.
Node quantity_node(const std::string& text) {
  const auto number = bare_number(text);
  return number ? Node(*number) : Node(text);
}

template <class Texts>
Node quantity_nodes(const Texts& texts) {
  Node::Array items;
  for (const std::string& text : texts) items.push_back(quantity_node(text));
  return Node::array(std::move(items));
}

template <class Rows>
Node quantity_rows(const Rows& rows) {
  Node::Array items;
  for (const auto& row : rows) items.push_back(quantity_nodes(row));
  return Node::array(std::move(items));
}

}  // namespace

std::string type_text(const Declaration& d) {
  switch (d.kind) {
    case Kind::quantity:
      return quantity_text(d);
    case Kind::integer:
      return d.range.is_any() ? "integer" : fmt::format("integer, {}", to_string(d.range));
    case Kind::boolean:
      return "true or false";
    case Kind::text:
      return "text";
    case Kind::choice:
      return quoted(d.choices, " | ");
    case Kind::quantities:
      return fmt::format("list of {}: {}", count_text(d), quantity_text(d));
    case Kind::matrix:
      return fmt::format("2 x 2 matrix: {}", quantity_text(d));
    case Kind::function:
      return fmt::format("one value or pairs [{}, value]: {}", d.argument_unit == "s" ? "time" : d.argument_unit,
                         quantity_text(d));
    case Kind::list:
      return "array of tables";
    case Kind::table:
      return "table";
    case Kind::tables:
      return "named tables";
    case Kind::variants: {
      std::vector<std::string> tags;
      for (const VariantDeclaration& variant : d.variants) tags.push_back(variant.tag);
      return fmt::format("named tables, each with {} = {}", d.tag_key, quoted(tags, " | "));
    }
    case Kind::custom:
      return d.accepts.empty() ? d.unit : d.unit.empty() ? d.accepts : fmt::format("{}, in {}", d.accepts, d.unit);
  }
  return "";
}

std::string closest_name(std::string_view word, const std::vector<std::string>& names) {
  const std::string given = lower_case(word);
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(given.size() < 4 ? 1 : 2, given.size() / 3) + 1;
  for (const std::string& name : names) {
    const std::size_t distance = edit_distance(given, lower_case(name));
    if (distance < best_distance && distance < std::max(given.size(), name.size())) {
      best = name;
      best_distance = distance;
    }
  }
  if (!best.empty()) return best;
  // "friction" for "friction_coefficient": the only name that it begins.
  std::vector<std::string> longer;
  for (const std::string& name : names)
    if (given.size() >= 3 && lower_case(name).starts_with(given)) longer.push_back(name);
  return longer.size() == 1 ? longer.front() : "";
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known, const std::string& rest) {
  const std::string close = closest_name(word, known);
  if (close.empty()) return rest;
  return fmt::format("Did you mean \"{}\"?{}{}", close, rest.empty() ? "" : "  ", rest);
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  return suggestion(word, known, fmt::format("Known: {}.", fmt::join(known, ", ")));
}

// ---------------------------------------------------------------------------------------------------------------
// variants

bool is_variant_default(const Declaration& variants, const Node::Entry& entry) {
  return !entry.value.is_table() ||
         std::any_of(variants.variants.begin(), variants.variants.end(), [&](const VariantDeclaration& variant) {
           return variant.takes_defaults && variant.section->find(entry.key);
         });
}

Node variant_defaults(const Node& table, const VariantDeclaration& chosen) {
  Node defaults = Node::table(table.where());
  if (chosen.takes_defaults)
    for (const Node::Entry& entry : table.entries())
      if (chosen.section->find(entry.key)) defaults.set(entry.key, entry.value, entry.where);
  return defaults;
}

const VariantDeclaration* variant_of(const Declaration& variants, const Node& named_table) {
  const Node* given = named_table.find(variants.tag_key);
  std::optional<std::string> tag = variants.fallback_tag;
  if (given) tag = given->is_text() ? std::optional(given->text()) : std::nullopt;
  for (const VariantDeclaration& variant : variants.variants)
    if (variant.tag == tag) return &variant;
  return nullptr;
}

// ---------------------------------------------------------------------------------------------------------- single
// values

std::string ReadContext::name_of(std::string_view key) const {
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

std::optional<double> read_quantity(const Node& node, const Quantity& quantity, const std::string& name,
                                    Faults& faults) {
  return detail::read_quantity(node, as_declaration(quantity), name, faults);
}

std::optional<std::vector<double>> read_quantities(const Node& node, const Quantity& quantity, std::size_t min_count,
                                                   std::size_t max_count, const std::string& name, Faults& faults) {
  Declaration d = as_declaration(quantity);
  d.min_count = min_count;
  d.max_count = max_count;
  return detail::read_quantities(node, d, name, faults);
}

namespace detail {

std::optional<double> read_quantity(const Node& node, const Declaration& d, const std::string& name, Faults& faults) {
  if (!node.is_number() && !node.is_text()) {
    add_type_fault(node, name, needed_quantity(d), faults);
    return {};
  }
  const Conversion conversion = node.is_text() ? convert_to_si(node.text(), d.unit, d.quantity_kind, name)
                                               : checked_si(node.number(), d.quantity_kind, name);
  if (!conversion) {
    faults.add(node.where(), conversion.error + ".", conversion.advice);
    return {};
  }
  if (!d.range.contains(conversion.value)) {
    faults.add(node.where(),
               fmt::format("{} = {} is out of range: it must be {}.", name, to_text(node), to_string(d.range, d.unit)),
               d.help);
    return {};
  }
  return conversion.value;
}

std::optional<int> read_integer(const Node& node, const Declaration& d, const std::string& name, Faults& faults) {
  if (!node.is(Node::Kind::integer)) {
    const std::string given = node.is(Node::Kind::real) ? fmt::format("= {}", to_text(node)) : "is " + kind_name(node);
    faults.add(node.where(), fmt::format("{} {}; it must be an integer{}.", name, given,
                                         d.range.is_any() ? "" : " " + to_string(d.range)));
    return {};
  }
  const std::int64_t value = node.integer();
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max() ||
      !d.range.contains(static_cast<double>(value))) {
    const std::string allowed = d.range.is_any() ? "smaller than 2^31" : to_string(d.range);
    faults.add(node.where(), fmt::format("{} = {} is out of range: it must be {}.", name, value, allowed), d.help);
    return {};
  }
  return static_cast<int>(value);
}

std::optional<bool> read_boolean(const Node& node, const std::string& name, Faults& faults) {
  if (node.is(Node::Kind::boolean)) return node.boolean();
  add_type_fault(node, name, "true or false, without quotes", faults);
  return {};
}

std::optional<std::string> read_text(const Node& node, const Declaration& d, const std::string& name, Faults& faults) {
  const std::string needs = d.choices.empty() ? "a text in quotes" : "one of " + quoted(d.choices, ", ");
  if (!node.is_text()) {
    add_type_fault(node, name, needs, faults);
    return {};
  }
  if (!d.choices.empty() && std::find(d.choices.begin(), d.choices.end(), node.text()) == d.choices.end()) {
    const std::string close = suggestion(node.text(), d.choices, "");
    faults.add(node.where(), fmt::format("{} = \"{}\" is not known; it must be {}.", name, node.text(), needs),
               close.empty() ? d.help : close);
    return {};
  }
  return node.text();
}

std::optional<std::vector<double>> read_quantities(const Node& node, const Declaration& d, const std::string& name,
                                                   Faults& faults) {
  const std::string needs = fmt::format("a list of {} values, each {}", count_text(d), needed_quantity(d));
  if (!node.is_array()) {
    add_type_fault(node, name, needs, faults);
    return {};
  }
  if (node.items().size() < d.min_count || node.items().size() > d.max_count) {
    faults.add(node.where(), fmt::format("{} has {} entries; it must be {}.", name, node.items().size(), needs));
    return {};
  }
  std::vector<double> values;
  for (const Node& item : node.items())
    if (const auto value = read_quantity(item, d, fmt::format("{}#{}", name, &item - node.items().data() + 1), faults))
      values.push_back(*value);
  if (values.size() < node.items().size()) return {};
  return values;
}

std::optional<std::array<std::array<double, 2>, 2>> read_matrix(const Node& node, const Declaration& d,
                                                                const std::string& name, Faults& faults) {
  const auto is_pair = [](const Node& row) { return row.is_array() && row.items().size() == 2; };
  if (!is_pair(node) || !is_pair(node.items()[0]) || !is_pair(node.items()[1])) {
    faults.add(node.where(), fmt::format("{} = {} is not a 2 x 2 matrix; it must be [[a, b], [c, d]], each {}.", name,
                                         to_text(node), needed_quantity(d)));
    return {};
  }
  std::array<std::array<double, 2>, 2> matrix{};
  bool is_complete = true;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const auto value =
          read_quantity(node.items()[i].items()[j], d, fmt::format("{}#{}#{}", name, i + 1, j + 1), faults);
      is_complete = is_complete && value;
      matrix[i][j] = value.value_or(0.0);
    }
  if (!is_complete) return {};
  return matrix;
}

std::optional<std::vector<std::array<double, 2>>> read_function(const Node& node, const Declaration& d,
                                                                const std::string& name, Faults& faults) {
  if (node.is_number() || node.is_text()) {
    const auto constant = read_quantity(node, d, name, faults);
    if (!constant) return {};
    return std::vector<std::array<double, 2>>{{0.0, *constant}};
  }
  const Declaration argument = as_declaration({.unit = d.argument_unit});
  const std::string needs =
      fmt::format("{}, or a list of pairs such as [[\"{}\", \"{}\"], ...]", needed_quantity(d),
                  example_of(d.argument_unit, argument.quantity_kind), example_of(d.unit, d.quantity_kind));
  if (!node.is_array()) {
    add_type_fault(node, name, needs, faults);
    return {};
  }
  std::vector<std::array<double, 2>> points;
  for (const Node& pair : node.items()) {
    const std::string point = fmt::format("{}#{}", name, &pair - node.items().data() + 1);
    if (!pair.is_array() || pair.items().size() != 2) {
      faults.add(pair.where(), fmt::format("{} = {} is not a pair; {} must be {}.", point, to_text(pair), name, needs));
      continue;
    }
    const auto x = read_quantity(pair.items()[0], argument, point, faults);
    const auto y = read_quantity(pair.items()[1], d, point, faults);
    if (!x || !y) continue;
    if (!points.empty() && *x <= points.back()[0])
      faults.add(pair.where(),
                 fmt::format("{} begins with {}, which is not larger than in the pair before; they must rise.", point,
                             to_text(pair.items()[0])));
    points.push_back({*x, *y});
  }
  if (node.items().empty()) faults.add(node.where(), fmt::format("{} is empty; it must be {}.", name, needs));
  if (points.empty() || points.size() < node.items().size()) return {};
  return points;
}

bool is_readable_list(const Node& node, const Declaration& d, const std::string& name, Faults& faults) {
  if (!node.is_array()) {
    add_type_fault(node, name, fmt::format("an array of tables: [[{}]] or [{{...}}, ...]", name), faults);
    return false;
  }
  if (node.items().size() < d.min_count) {
    faults.add(node.where(),
               fmt::format("{} has {} entries; it must have at least {}.", name, node.items().size(), d.min_count),
               d.help);
    return false;
  }
  return true;
}

bool is_readable_map(const Node& node, const Declaration& d, const std::string& name, Faults& faults) {
  if (!node.is_table()) {
    add_type_fault(node, name, fmt::format("a table of named tables: [{}.NAME]", name), faults);
    return false;
  }
  std::size_t n_tables = 0;
  for (const Node::Entry& entry : node.entries())
    n_tables += d.kind != Kind::variants || !is_variant_default(d, entry) ? 1 : 0;
  if (n_tables < d.min_count)
    faults.add(node.where(),
               fmt::format("[{}] holds {} named tables; it must hold at least {}.", name, n_tables, d.min_count),
               fmt::format("Write one as [{}.NAME]. {}", name, d.help));
  return true;
}

bool is_readable_table(const Node& node, const std::string& path, Faults& faults) {
  if (node.is_table()) return true;
  faults.add(
      node.where(), fmt::format("{} is {}; it must be a table.", path.empty() ? "the input" : path, kind_name(node)),
      path.empty() || path.find('#') != std::string::npos ? ""
                                                          : fmt::format("Write [{}] and its keys below it.", path));
  return false;
}

void report_unknown_keys(const Node& table, const SectionDeclaration& section, const ReadContext& here,
                         Faults& faults) {
  for (const Node::Entry& entry : table.entries()) {
    if (section.find(entry.key) || (here.also_known_key && *here.also_known_key == entry.key)) continue;
    std::vector<std::string> known = keys_of(section);
    if (here.also_known_key) known.push_back(*here.also_known_key);
    faults.add(entry.where, fmt::format("unknown key \"{}\" {}.", entry.key, name_of_table(here.path)),
               advice_on_unknown(entry.key, std::move(known), here));
  }
}

void report_missing_key(const Node& table, const Declaration& d, const ReadContext& here, Faults& faults) {
  std::string needs;
  switch (d.kind) {
    case Kind::quantity:
      needs = needed_quantity(d) + (d.range.is_any() ? "" : ", " + to_string(d.range, d.unit));
      break;
    case Kind::quantities:
      needs = fmt::format("a list of {} values, each {}", count_text(d), needed_quantity(d));
      break;
    case Kind::integer:
      needs = "an " + type_text(d);
      break;
    case Kind::choice:
      needs = "one of " + quoted(d.choices, ", ");
      break;
    default:
      needs = type_text(d);
  }
  faults.add(table.where(), fmt::format("missing key \"{}\" {}.", d.key, name_of_table(here.path)),
             (needs.empty() ? "" : fmt::format("It must be {}.  ", needs)) + d.help);
}

void report_unknown_defaults(const Node& table, const Declaration& d, const ReadContext& here, Faults& faults) {
  SectionDeclaration known{.name = here.path, .help = "", .declarations = {}};
  for (const VariantDeclaration& variant : d.variants)
    if (variant.takes_defaults)
      for (const Declaration& declaration : variant.section->declarations)
        if (!known.find(declaration.key)) known.declarations.push_back(declaration);
  for (const Node::Entry& entry : table.entries())
    if (is_variant_default(d, entry) && !known.find(entry.key))
      faults.add(entry.where, fmt::format("unknown key \"{}\" {}.", entry.key, name_of_table(here.path)),
                 known.declarations.empty() ? fmt::format("[{}] holds only tables: [{}.NAME].", here.path, here.path)
                                            : advice_on_unknown(entry.key, keys_of(known), here));
}

void report_unknown_variant(const Node::Entry& entry, const Declaration& d, const ReadContext& here, Faults& faults) {
  std::vector<std::string> tags;
  for (const VariantDeclaration& variant : d.variants) tags.push_back(variant.tag);
  const std::string path = here.name_of(entry.key);
  const std::string allowed = "It must be one of " + quoted(tags, ", ") + ".";
  const Node* tag = entry.value.find(d.tag_key);
  if (!tag) {
    faults.add(entry.where, fmt::format("missing key \"{}\" {}.", d.tag_key, name_of_table(path)),
               allowed + "  " + d.help);
    return;
  }
  faults.add(tag->where(), fmt::format("{}.{} = {} is not known.", path, d.tag_key, to_text(*tag)),
             tag->is_text() ? suggestion(tag->text(), tags, allowed) : allowed);
}

namespace {

void collect_positions(const Node& node, std::vector<SourcePosition>& positions) {
  positions.push_back(node.where());
  if (node.is_array())
    for (const Node& item : node.items()) collect_positions(item, positions);
  if (node.is_table())
    for (const Node::Entry& entry : node.entries()) {
      positions.push_back(entry.where);
      collect_positions(entry.value, positions);
    }
}

std::string with_path_replaced(std::string message, const std::string& from, const std::string& to) {
  for (std::size_t at = message.find(from); at != std::string::npos; at = message.find(from, at + to.size()))
    message.replace(at, from.size(), to);
  return message;
}

}  // namespace

void add_without_repeating_defaults(const Faults& from_one_table, const Node& defaults,
                                    const std::string& path_of_table, const std::string& path_of_defaults,
                                    Faults& faults) {
  std::vector<SourcePosition> shared;
  for (const Node::Entry& entry : defaults.entries()) {
    shared.push_back(entry.where);
    collect_positions(entry.value, shared);
  }
  for (const Fault& fault : from_one_table) {
    const bool is_shared =
        fault.where.is_known() && std::find(shared.begin(), shared.end(), fault.where) != shared.end();
    faults.add(fault.where,
               is_shared ? with_path_replaced(fault.message, path_of_table, path_of_defaults) : fault.message,
               fault.advice);
  }
}

// ------------------------------------------------------------------------------------------------------ making
// declarations

namespace {

/// Reads the fallback as if a user had written it.
void check_fallback(const Declaration& d, const std::string& name, Faults& faults) {
  switch (d.kind) {
    case Kind::quantity:
      read_quantity(*d.fallback, d, name, faults);
      break;
    case Kind::integer:
      read_integer(*d.fallback, d, name, faults);
      break;
    case Kind::text:
    case Kind::choice:
      read_text(*d.fallback, d, name, faults);
      break;
    case Kind::quantities:
      read_quantities(*d.fallback, d, name, faults);
      break;
    case Kind::matrix:
      read_matrix(*d.fallback, d, name, faults);
      break;
    case Kind::function:
      read_function(*d.fallback, d, name, faults);
      break;
    case Kind::list:
      is_readable_list(*d.fallback, d, name, faults);
      break;
    case Kind::tables:
      is_readable_map(*d.fallback, d, name, faults);
      break;
    case Kind::variants:
    case Kind::boolean:
    case Kind::table:
    case Kind::custom:
      break;
  }
}

}  // namespace

void add_declaration(SectionDeclaration& section, Declaration d) {
  const std::string name = ReadContext{.path = section.name}.name_of(d.key);
  if (section.find(d.key)) throw std::logic_error(fmt::format("{} is declared twice", name));
  const bool has_quantity =
      d.kind == Kind::quantity || d.kind == Kind::quantities || d.kind == Kind::matrix || d.kind == Kind::function;
  if (has_quantity) described(d.unit, d.quantity_kind);  // throws for a unit that UDUNITS does not know
  if (d.kind == Kind::function) described(d.argument_unit, kind_of(d.argument_unit));
  Faults faults;
  if (d.fallback) check_fallback(d, name, faults);
  if (d.fallback_tag && !variant_of(d, Node::table()))
    faults.add({}, fmt::format("\"{}\" is not among the variants of {}", *d.fallback_tag, name));
  if (!faults.empty())
    throw std::logic_error(fmt::format("the default of {} is faulty: {}", name, InputError(faults).what()));
  section.declarations.push_back(std::move(d));
}

Declaration declare(std::string key, const Quantity& options, bool is_optional) {
  Declaration d = started(std::move(key), Kind::quantity, options.source, options.help);
  set_quantity(d, options);
  if (options.fallback) d.fallback = quantity_node(*options.fallback);
  d.required = !options.fallback && !is_optional;
  return d;
}

Declaration declare(std::string key, const QuantityList& options, std::optional<std::size_t> fixed_count,
                    bool is_optional) {
  Declaration d = started(std::move(key), Kind::quantities, options.source, options.help);
  set_quantity(d, options);
  d.min_count = fixed_count.value_or(options.min_count);
  d.max_count = fixed_count.value_or(d.max_count);
  if (!options.fallback.empty()) d.fallback = quantity_nodes(options.fallback);
  d.required = !d.fallback && !is_optional && d.min_count > 0;
  return d;
}

Declaration declare(std::string key, const QuantityMatrix& options, bool is_optional) {
  Declaration d = started(std::move(key), Kind::matrix, options.source, options.help);
  set_quantity(d, options);
  if (!options.fallback.empty()) d.fallback = quantity_rows(options.fallback);
  d.required = !d.fallback && !is_optional;
  return d;
}

Declaration declare(std::string key, const QuantityFunction& options, bool is_optional) {
  Declaration d = started(std::move(key), Kind::function, options.source, options.help);
  set_quantity(d, options);
  d.argument_unit = options.argument_unit;
  if (!options.fallback.empty()) d.fallback = quantity_rows(options.fallback);
  d.required = !d.fallback && !is_optional;
  return d;
}

Declaration declare(std::string key, const Integer& options, bool is_optional) {
  Declaration d = started(std::move(key), Kind::integer, options.source, options.help);
  d.range = options.range;
  if (options.fallback) d.fallback = Node(*options.fallback);
  d.required = !d.fallback && !is_optional;
  return d;
}

Declaration declare(std::string key, const Boolean& options, bool is_optional) {
  Declaration d = started(std::move(key), Kind::boolean, options.source, options.help);
  if (options.fallback) d.fallback = Node(*options.fallback);
  d.required = !d.fallback && !is_optional;
  return d;
}

Declaration declare(std::string key, const Text& options, std::vector<std::string> choices, bool is_optional) {
  const Kind kind = choices.empty() ? Kind::text : Kind::choice;
  Declaration d = started(std::move(key), kind, options.source, options.help);
  d.choices = std::move(choices);
  if (options.fallback) d.fallback = Node(*options.fallback);
  d.required = !d.fallback && !is_optional;
  return d;
}

Declaration declare(std::string key, Declaration::Kind kind, const Nested& options, ErasedSection nested) {
  Declaration d = started(std::move(key), kind, options.source, options.help.empty() ? nested->help : options.help);
  d.min_count = options.min_count;
  d.fallback = options.fallback;
  d.nested = std::move(nested);
  d.required = !d.fallback && d.min_count > 0;
  return d;
}

Declaration declare(std::string key, const Variants& options, std::string tag_key,
                    std::vector<VariantDeclaration> variants) {
  Declaration d = started(std::move(key), Kind::variants, options.source, options.help);
  d.min_count = options.min_count;
  d.tag_key = std::move(tag_key);
  d.variants = std::move(variants);
  d.fallback_tag = options.fallback;
  d.required = d.min_count > 0;
  return d;
}

Declaration declare(std::string key, const Custom& options) {
  Declaration d = started(std::move(key), Kind::custom, options.source, options.help);
  d.unit = options.unit;
  d.accepts = options.accepts;
  d.json_types = options.json_types;
  d.fallback = options.fallback;
  d.required = options.required && !options.fallback;
  return d;
}

}  // namespace detail

}  // namespace rotordrop
