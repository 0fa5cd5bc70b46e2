#include "base/parameters/declare.h"

#include "base/errors.h"
#include "base/parameters/table_reader.h"
#include "base/parameters/usual_magnitudes.h"
#include "base/parameters/value_reader.h"

#include <fmt/format.h>

#include <stdexcept>

namespace rotordrop {

namespace detail {

namespace {

constexpr double usual_cold = 150., usual_hot = 3000.;  // outside a bare temperature was not meant in kelvin [K]

using Kind = Declaration::Kind;

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
  d.usual = options.usual.is_any() ? usual_magnitudes(d.unit, d.quantity_kind, d.range) : options.usual;
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

/// Reads the fallback as if a user had written it.
void check_fallback(const Declaration& d, const std::string& name, Faults& faults) {
  switch (d.kind) {
    case Kind::quantity:
      if (const auto value = read_quantity(*d.fallback, d, name, faults); value && !d.usual.contains(*value))
        faults.add({}, fmt::format("{} is not {}, which is declared as usual", to_text(*d.fallback),
                                   to_string(d.usual, d.unit)));
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
  const QuantityKind argument = kind_of(d.argument_unit);
  d.usual_argument = !options.usual_argument.is_any() ? options.usual_argument
                     : argument == QuantityKind::temperature
                         ? between(usual_cold, usual_hot)
                         : usual_magnitudes(d.argument_unit, argument, at_least(0.));
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
