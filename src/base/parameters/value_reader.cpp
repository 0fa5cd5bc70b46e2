#include "base/parameters/value_reader.h"

#include "base/parameters/other_units.h"
#include "base/parameters/suggestion.h"
#include "base/parameters/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>

namespace rotordrop {

namespace {

/// The declaration of a single quantity with another unit, for the arguments of functions and for custom readers.
Declaration as_declaration(const Quantity& q) {
  Declaration d;
  d.kind = Declaration::Kind::quantity;
  d.unit = q.unit;
  d.quantity_kind = q.kind.value_or(kind_of(q.unit));
  d.range = q.range;
  d.help = q.help;
  return d;
}

}  // namespace

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
    faults.add(
        node.where(),
        fmt::format("{} = {} is out of range: it must be {}.", name, to_text(node), to_string(d.range, d.unit)),
        (node.is_number() ? other_unit_meant(d, conversion.value, d.usual.is_any() ? d.range : d.usual) : "") + d.help);
    return {};
  }
  return conversion.value;
}

std::optional<int> read_integer(const Node& node, const Declaration& d, const std::string& name, Faults& faults) {
  if (!node.is(Node::Kind::integer)) {
    const bool is_real = node.is(Node::Kind::real),
               is_whole = is_real && std::fabs(node.number()) < 1e9 && node.number() == std::trunc(node.number());
    std::string given = is_real ? "= " + to_text(node) : "is " + kind_name(node);
    if (is_whole && given.find_first_of(".e") == std::string::npos) given += ".0";  // else nobody sees what is wrong
    faults.add(
        node.where(),
        fmt::format("{} {}; it must be an integer{}.", name, given, d.range.is_any() ? "" : " " + to_string(d.range)),
        is_whole ? fmt::format("Write {:.0f}, without a decimal point.", node.number()) : "");
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
  std::string word = node.is_text() ? node.text() : node.is_number() ? to_text(node) : "";
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const bool is_yes = word == "yes" || word == "on" || word == "true" || word == "1";
  const bool is_no = word == "no" || word == "off" || word == "false" || word == "0";
  faults.add(node.where(), fmt::format("{} is {}; it must be true or false, without quotes.", name, kind_name(node)),
             is_yes || is_no ? fmt::format("Write {}.", is_yes) : "");
  return {};
}

std::optional<std::string> read_text(const Node& node, const Declaration& d, const std::string& name, Faults& faults) {
  const auto needs = [&] { return d.choices.empty() ? "a text in quotes" : "one of " + quoted(d.choices, ", "); };
  if (!node.is_text()) {
    add_type_fault(node, name, needs(), faults);
    return {};
  }
  if (!d.choices.empty() && std::find(d.choices.begin(), d.choices.end(), node.text()) == d.choices.end()) {
    const std::string close = suggestion(node.text(), d.choices, "");
    faults.add(node.where(), fmt::format("{} = \"{}\" is not known; it must be {}.", name, node.text(), needs()),
               close.empty() ? d.help : close);
    return {};
  }
  return node.text();
}

std::optional<std::vector<double>> read_quantities(const Node& node, const Declaration& d, const std::string& name,
                                                   Faults& faults) {
  const auto needs = [&] { return fmt::format("a list of {} values, each {}", count_text(d), needed_quantity(d)); };
  if (!node.is_array()) {
    add_type_fault(node, name, needs(), faults);
    return {};
  }
  if (node.items().size() < d.min_count || node.items().size() > d.max_count) {
    faults.add(node.where(), fmt::format("{} has {} entries; it must be {}.", name, node.items().size(), needs()));
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
  const auto needs = [&] {
    return fmt::format("{}, or a list of pairs such as [[\"{}\", \"{}\"], ...]", needed_quantity(d),
                       example_of(d.argument_unit, argument.quantity_kind), example_of(d.unit, d.quantity_kind));
  };
  if (!node.is_array()) {
    add_type_fault(node, name, needs(), faults);
    return {};
  }
  std::vector<std::array<double, 2>> points;
  for (const Node& pair : node.items()) {
    const std::string point = fmt::format("{}#{}", name, &pair - node.items().data() + 1);
    if (!pair.is_array() || pair.items().size() != 2) {
      faults.add(pair.where(),
                 fmt::format("{} = {} is not a pair; {} must be {}.", point, to_text(pair), name, needs()));
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
  if (node.items().empty()) faults.add(node.where(), fmt::format("{} is empty; it must be {}.", name, needs()));
  if (points.empty() || points.size() < node.items().size()) return {};
  return points;
}

}  // namespace detail

}  // namespace rotordrop
