#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/parameters/wording.h"
#include "io/text/parameter_writers.h"
#include "io/text/toml_text.h"

// The schema of the input files.
namespace rotordrop {

namespace {

using Kind = Declaration::Kind;

using Json = nlohmann::ordered_json;

Json json_value(const Node& node) {
  switch (node.kind()) {
    case Node::Kind::null:
      return nullptr;
    case Node::Kind::boolean:
      return node.boolean();
    case Node::Kind::integer:
      return node.integer();
    case Node::Kind::real:
      return node.number();
    case Node::Kind::text:
      return node.text();
    case Node::Kind::array: {
      Json array = Json::array();
      for (const Node& item : node.items()) array.push_back(json_value(item));
      return array;
    }
    case Node::Kind::table: {
      Json object = Json::object();
      for (const Node::Entry& entry : node.entries()) object[entry.key] = json_value(entry.value);
      return object;
    }
  }
  return nullptr;
}

void add_limits(Json& schema, const Range& range) {
  if (std::isfinite(range.lower)) schema[range.lower_is_open ? "exclusiveMinimum" : "minimum"] = range.lower;
  if (std::isfinite(range.upper)) schema[range.upper_is_open ? "exclusiveMaximum" : "maximum"] = range.upper;
}

/// A number in SI or a text with a unit. The limits hold for numbers; texts are checked when the program reads them.
Json quantity_schema(const std::string& unit, const Range& range) {
  Json schema;
  schema["type"] = takes_bare_numbers_only(unit) ? Json("number") : Json::array({"number", "string"});
  add_limits(schema, range);
  return schema;
}

Json array_schema(Json items, std::size_t min_count, std::size_t max_count) {
  Json schema{{"type", "array"}, {"items", std::move(items)}};
  if (min_count > 0) schema["minItems"] = min_count;
  if (max_count < std::numeric_limits<std::size_t>::max()) schema["maxItems"] = max_count;
  return schema;
}

Json section_schema(const SectionDeclaration& section);

// No kind requires its tag: a case's base may have it.
Json variants_schema(const Declaration& d) {
  Json alternatives = Json::array();
  Json defaults = Json::object();
  for (const VariantDeclaration& variant : d.variants) {
    Json schema = section_schema(*variant.section);
    Json properties{{d.tag_key, {{"const", variant.tag}}}};
    properties.update(schema["properties"]);
    if (variant.takes_defaults) defaults.update(schema["properties"]);
    properties[d.tag_key]["const"] = variant.tag;
    schema["properties"] = std::move(properties);
    alternatives.push_back(std::move(schema));
  }
  return {{"type", "object"},
          {"properties", std::move(defaults)},
          {"additionalProperties", {{"anyOf", std::move(alternatives)}}}};
}

Json shape_schema(const Declaration& d) {
  switch (d.kind) {
    case Kind::quantity:
      return quantity_schema(d.unit, d.range);
    case Kind::integer: {
      Json schema{{"type", "integer"}};
      add_limits(schema, d.range);
      return schema;
    }
    case Kind::boolean:
      return {{"type", "boolean"}};
    case Kind::text:
      return {{"type", "string"}};
    case Kind::choice:
      return {{"type", "string"}, {"enum", d.choices}};
    case Kind::quantities:
      return array_schema(quantity_schema(d.unit, d.range), d.min_count, d.max_count);
    case Kind::matrix:
      return array_schema(array_schema(quantity_schema(d.unit, d.range), 2, 2), 2, 2);
    case Kind::function: {
      Json pair{{"type", "array"},
                {"prefixItems", {quantity_schema(d.argument_unit, any()), quantity_schema(d.unit, d.range)}}};
      pair["minItems"] = 2;
      pair["maxItems"] = 2;
      return {{"anyOf", {quantity_schema(d.unit, d.range), array_schema(std::move(pair), 1, d.max_count)}}};
    }
    case Kind::list:
      return array_schema(section_schema(*d.nested), d.min_count, d.max_count);
    case Kind::table:
      return section_schema(*d.nested);
    case Kind::tables:
      return {{"type", "object"}, {"additionalProperties", section_schema(*d.nested)}};
    case Kind::variants:
      return variants_schema(d);
    case Kind::custom:
      if (d.json_types.empty()) return Json::object();
      return {{"type", d.json_types.size() == 1 ? Json(d.json_types.front()) : Json(d.json_types)}};
  }
  return Json::object();
}

Json declaration_schema(const Declaration& d) {
  std::string description = d.help;
  if (const std::string type = type_text(d); is_one_value(d) && !type.empty())
    description += fmt::format("{}[{}]", description.empty() ? "" : "  ", type);
  if (is_one_value(d) && d.required) description += "  Required.";
  if (!d.source.empty()) description += "  Source: " + d.source;
  Json schema = Json::object();
  if (!description.empty()) schema["description"] = description;
  schema.update(shape_schema(d));
  if (d.fallback) schema["default"] = json_value(*d.fallback);
  return schema;
}

Json section_schema(const SectionDeclaration& section) {
  Json properties = Json::object();
  for (const Declaration& d : section.declarations) properties[d.key] = declaration_schema(d);
  Json schema = Json::object();
  if (!section.help.empty()) schema["description"] = section.help;
  schema["type"] = "object";
  schema["properties"] = std::move(properties);
  schema["additionalProperties"] = false;
  return schema;
}

}  // namespace

std::string write_json_schema(const std::vector<ErasedSection>& sections) {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "rotordrop parameters"},
              {"type", "object"}};
  Json properties{
      {"base",
       {{"description", "Another file, relative to this one, whose values hold where this file gives none."},
        {"type", "string"}}}};
  for (const ErasedSection& section : top_level_first(sections)) {
    Json one = section_schema(*section);
    if (section->name.empty())
      properties.update(one["properties"]);
    else
      properties[section->name] = std::move(one);
  }
  schema["properties"] = std::move(properties);
  schema["additionalProperties"] = false;
  return schema.dump(2) + "\n";
}

}  // namespace rotordrop
