#include "case/usual_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

#include "base/parameters/declaration.h"
#include "base/parameters/other_units.h"
#include "base/trimmed.h"
#include "base/units.h"

namespace rotordrop {
namespace {

/// What a bare number that is unusual may be: the same number in another unit, if that is usual.
std::string slip(const Declaration& d, double value) {
  std::string text = fmt::format("A bare number is in {}", d.unit);
  if (const auto units = units_in_mind(d.unit); !units.empty() && d.unit != "K")
    if (const auto one = convert_to_si("1 " + units.front(), d.unit, d.quantity_kind, d.key))
      text += fmt::format(": {:.6g} {} is {:.5g} {}", value, d.unit, value / one.value, units.front());
  const std::string meant = other_unit_meant(d, value, d.usual);
  return text + "." + (meant.empty() ? "" : " ") + std::string(trimmed(meant));
}

/// The usual range in the unit in which a value was written, and that unit; in SI where that is not a factor away.
std::pair<Range, std::string> in_unit_of(const std::string& text, const Declaration& d, double value) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const std::string unit(trimmed(end));
  if (number == 0. || unit.empty() || d.quantity_kind == QuantityKind::temperature) return {d.usual, d.unit};
  Range range = d.usual;
  for (double* bound : {&range.lower, &range.upper}) *bound = std::stod(fmt::format("{:.6g}", *bound * number / value));
  return {range, unit};
}

class Look {
 public:
  explicit Look(std::vector<Fault>& warnings) : warnings_(warnings) {}

  void at(const SectionDeclaration& section, const Node& table, const std::string& path) {
    if (!table.is_table()) return;
    for (const Declaration& d : section.declarations)
      if (const Node* given = table.find(d.key)) at(d, *given, path.empty() ? d.key : path + "." + d.key);
  }

  void at_number(const Declaration& d, const Node& given, const std::string& name) {
    if (d.usual.is_any()) return;
    const bool is_bare = given.is_number();
    double value = 0.;
    if (is_bare)
      value = given.number();
    else if (const auto read =
                 given.is_text() ? convert_to_si(given.text(), d.unit, d.quantity_kind, name) : Conversion{})
      value = read.value;
    else
      return;
    if (d.usual.contains(value)) return;
    // "90000 rpm" is meant so; the rotor's surface tells whether it can be.
    constexpr double speed_of_rotors = 1000.;  // [rad/s]
    if (!is_bare && d.quantity_kind == QuantityKind::angular_speed && d.usual.upper >= speed_of_rotors) return;
    const std::string unit = is_bare && d.unit != "1" ? " " + d.unit : "";
    const auto [usual, usual_unit] = is_bare ? std::pair(d.usual, d.unit) : in_unit_of(given.text(), d, value);
    Fault warning{given.where(),
                  fmt::format("{}{}{} is unusual: it is most often {}.", name.empty() ? "" : name + " = ",
                              to_text(given), unit, to_string(usual, usual_unit)),
                  is_bare && d.unit != "1" ? slip(d, value) : std::string("Check the number and its unit.")};
    if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end())
      warnings_.push_back(std::move(warning));
  }

 private:
  void at(const Declaration& d, const Node& given, const std::string& name) {
    using Kind = Declaration::Kind;
    switch (d.kind) {
      case Kind::quantity:
      case Kind::integer:
        at_number(d, given, name);
        break;
      case Kind::quantities:
      case Kind::matrix:
        at_list(d, given, name);
        break;
      case Kind::function:
        at_function(d, given, name);
        break;
      case Kind::table:
        at(*d.nested, given, name);
        break;
      case Kind::list:
        if (given.is_array())
          for (std::size_t i = 0; i < given.items().size(); ++i)
            at(*d.nested, given.items()[i], fmt::format("{}#{}", name, i + 1));
        break;
      case Kind::tables:
        if (given.is_table())
          for (const auto& entry : given.entries()) at(*d.nested, entry.value, name + "." + entry.key);
        break;
      case Kind::variants:
        at_variants(d, given, name);
        break;
      default:
        break;
    }
  }

  void at_variants(const Declaration& d, const Node& given, const std::string& name) {
    if (!given.is_table()) return;
    for (const auto& variant : d.variants)
      if (variant.takes_defaults) at(*variant.section, variant_defaults(given, variant), name);
    for (const auto& entry : given.entries())
      if (!is_variant_default(d, entry) && entry.value.is_table())
        if (const VariantDeclaration* chosen = variant_of(d, entry.value))
          at(*chosen->section, entry.value, name + "." + entry.key);
  }

  void at_list(const Declaration& d, const Node& given, const std::string& name) {
    if (!given.is_array()) return;
    for (const Node& item : given.items())
      if (item.is_array())
        at_list(d, item, name);
      else
        at_number(d, item, name);
  }

  /// Pairs [argument, value]; one value alone is a constant.
  void at_function(const Declaration& d, const Node& given, const std::string& name) {
    if (!given.is_array()) return at_number(d, given, name);
    Declaration argument = d;
    argument.unit = d.argument_unit;
    argument.quantity_kind = kind_of(d.argument_unit);
    argument.range = any();
    argument.usual = d.usual_argument.is_any() ? d.usual_argument : or_zero(d.usual_argument);
    for (const Node& pair : given.items())
      if (pair.is_array() && pair.items().size() == 2) {
        at_number(argument, pair.items()[0], name + ", argument");
        at_number(d, pair.items()[1], name);
      }
  }

  std::vector<Fault>& warnings_;
};

}  // namespace

void look_for_unusual_values(const SectionDeclaration& section, const Node& tree, std::vector<Fault>& warnings) {
  Look(warnings).at(section, tree, section.name);
}

std::vector<Fault> look_at_option(const std::string& option, const std::string& text, const std::string& unit,
                                  QuantityKind kind, const Range& usual) {
  Declaration d;
  d.key = option;
  d.kind = Declaration::Kind::quantity;
  d.unit = unit;
  d.quantity_kind = kind;
  d.range = any();
  d.usual = usual;
  const SourcePosition where{option, 0, 0};
  const auto number = bare_number(trimmed(text));
  std::vector<Fault> warnings;
  Look(warnings).at_number(d, number ? Node(*number, where) : Node(text, where), "");
  return warnings;
}

void look_for_common_keys_without_effect(const Node& tree, std::vector<Fault>& warnings) {
  const Node* bearings = tree.find("bearings");
  if (!bearings || !bearings->is_table()) return;
  std::vector<const Node*> touchdowns;
  for (const auto& entry : bearings->entries())
    if (const Node* type = entry.value.is_table() ? entry.value.find("type") : nullptr;
        type && type->is_text() && type->text() == "touchdown")
      touchdowns.push_back(&entry.value);
  if (touchdowns.empty()) return;
  // A catalogue's name is copied to the bearings that have none: it then stands at the same place.
  const auto is_everywhere = [&](const Node::Entry& common) {
    return std::all_of(touchdowns.begin(), touchdowns.end(), [&](const Node* b) {
      const Node* own = b->find(common.key);
      return own && !(own->where() == common.value.where());
    });
  };
  for (const auto& entry : bearings->entries())
    if (!entry.value.is_table() && is_everywhere(entry))
      warnings.push_back(
          {entry.value.where(),
           fmt::format("bearings.{} has no effect: every touchdown bearing has a value of its own.", entry.key),
           "Values of a bearing, and of its catalogue entry, go before those of [bearings]."});
}

}  // namespace rotordrop
