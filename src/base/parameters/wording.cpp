#include "base/parameters/wording.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rotordrop {

namespace {

using Kind = Declaration::Kind;

/// "length in m, > 0"; "length in m and > 0" would read as one condition.
std::string quantity_text(const Declaration& d) {
  const std::string name = dimension_name(d.unit, d.quantity_kind);
  const std::string noun = d.unit == "1" ? "number" : name == d.unit ? name : fmt::format("{} in {}", name, d.unit);
  return noun + (d.range.is_any() ? "" : fmt::format(", {}", to_string(d.range))) +
         (d.usual.is_any() ? "" : fmt::format("; usually {}", to_string(d.usual)));
}

}  // namespace

namespace detail {

std::string quoted(const std::vector<std::string>& words, std::string_view separator) {
  std::vector<std::string> result;
  for (const auto& word : words) result.push_back(fmt::format("\"{}\"", word));
  return fmt::format("{}", fmt::join(result, separator));
}

std::string needed_quantity(const Declaration& d) {
  if (d.unit == "1") return "a number such as 0.1";
  if (takes_bare_numbers_only(d.unit)) return fmt::format("a bare number in {}", d.unit);
  return fmt::format("{} such as \"{}\" or a bare number in {}",
                     described(d.unit, d.quantity_kind).substr(0, described(d.unit, d.quantity_kind).find(" such as ")),
                     example_of(d.unit, d.quantity_kind), d.unit);
}

std::string count_text(const Declaration& d) {
  if (d.min_count == d.max_count) return std::to_string(d.min_count);
  return d.min_count == 0 ? "any number of" : fmt::format("at least {}", d.min_count);
}

void add_type_fault(const Node& node, const std::string& name, const std::string& needs, Faults& faults) {
  faults.add(node.where(), fmt::format("{} is {}; it must be {}.", name, kind_name(node), needs));
}

}  // namespace detail

using detail::count_text;
using detail::quoted;

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

}  // namespace rotordrop
