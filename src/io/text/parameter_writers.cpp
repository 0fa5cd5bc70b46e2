#include "io/text/parameter_writers.h"

#include "base/parameters/declaration.h"
#include "base/parameters/wording.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rotordrop {

namespace {

using Kind = Declaration::Kind;

// ------------------------------------------------------------------------------------------------------------ pieces
// of TOML

std::string quoted_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result += std::string("\\") + c;
    else if (c == '\n')
      result += "\\n";
    else if (c == '\t')
      result += "\\t";
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
      result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    else
      result += c;
  }
  return result + "\"";
}

std::string toml_key(const std::string& key) {
  const bool is_bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return is_bare ? key : quoted_text(key);
}

std::string toml_number(double value) {
  if (std::isnan(value)) return "nan";
  const std::string text = shortest(value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string joined_path(const std::string& path, const std::string& key) {
  return path.empty() ? toml_key(key) : path + "." + toml_key(key);
}

bool is_one_value(const Declaration& d) {
  return d.kind != Kind::list && d.kind != Kind::table && d.kind != Kind::tables && d.kind != Kind::variants;
}

/// A section without a name holds the top level, which TOML wants before all tables.
std::vector<ErasedSection> top_level_first(std::vector<ErasedSection> sections) {
  std::stable_partition(sections.begin(), sections.end(), [](const ErasedSection& s) { return s->name.empty(); });
  return sections;
}

// --------------------------------------------------------------------------------------------------------- annotated
// defaults

/// Comments begin with "# ", keys and tables that are only shown begin with "#".
class DefaultsWriter {
 public:
  void section(const SectionDeclaration& section, const std::string& path, bool is_shown_only) {
    for (const Declaration& d : section.declarations)
      if (is_one_value(d) || d.fallback) value(d, is_shown_only);
    for (const Declaration& d : section.declarations) tables(d, joined_path(path, d.key), is_shown_only);
  }
  void header(const std::string& header, const std::string& help, bool is_shown_only) {
    comment(help);
    text_ += fmt::format("{}{}\n\n", is_shown_only ? "#" : "", header);
  }
  const std::string& text() const { return text_; }

 private:
  void value(const Declaration& d, bool is_shown_only) {
    comment(fmt::format("{}{}[{}]", d.help, d.help.empty() ? "" : "  ", type_text(d)));
    if (!d.source.empty()) comment("source: " + d.source);
    if (d.fallback)
      text_ += fmt::format("{}{} = {}\n\n", is_shown_only ? "#" : "", toml_key(d.key), toml_value(*d.fallback));
    else
      text_ += fmt::format("#{} = {}  # {}\n\n", toml_key(d.key), example(d), d.required ? "required" : "optional");
  }
  void tables(const Declaration& d, const std::string& path, bool is_shown_only) {
    if (d.kind == Kind::table) {
      header(fmt::format("[{}]{}", path, d.required ? "" : "  # optional table"), d.help, is_shown_only || !d.required);
      section(*d.nested, path, is_shown_only || !d.required);
    } else if (d.kind == Kind::list) {
      header(fmt::format("[[{}]]  # {}", path, times(d)), d.help, true);
      section(*d.nested, path, true);
    } else if (d.kind == Kind::tables) {
      header(fmt::format("[{}.NAME]  # {}", path, times(d)), d.help, true);
      section(*d.nested, path + ".NAME", true);
    } else if (d.kind == Kind::variants) {
      comment(d.help);
      for (const VariantDeclaration& variant : d.variants) {
        header(fmt::format("[{}.NAME]  # {}", path, times(d)), variant.section->help, true);
        if (variant.takes_defaults)
          comment(fmt::format("Keys set in [{}] itself apply to every such table that does not set them.", path));
        const bool is_fallback = d.fallback_tag == variant.tag;
        text_ += fmt::format("#{} = {}{}\n\n", toml_key(d.tag_key), quoted_text(variant.tag),
                             is_fallback ? "" : "  # required");
        section(*variant.section, path + ".NAME", true);
      }
    }
  }
  static std::string times(const Declaration& d) {
    return d.min_count == 0 ? "any number of these" : fmt::format("at least {} of these", d.min_count);
  }
  static std::string example(const Declaration& d) {
    const auto one = [&] {
      const std::string text = example_of(d.unit, d.quantity_kind);
      return bare_number(text) ? text : quoted_text(text);
    };
    switch (d.kind) {
      case Kind::quantity:
        return one();
      case Kind::integer:
        return std::isfinite(d.range.lower) ? fmt::format("{}", std::ceil(d.range.lower)) : "1";
      case Kind::boolean:
        return "true";
      case Kind::choice:
        return quoted_text(d.choices.front());
      case Kind::quantities: {
        std::string items;
        for (std::size_t i = 0; i < std::max<std::size_t>(d.min_count, 1); ++i) items += (i == 0 ? "" : ", ") + one();
        return "[" + items + "]";
      }
      case Kind::matrix:
        return fmt::format("[[{0}, {0}], [{0}, {0}]]", one());
      case Kind::function:
        return fmt::format("[[0.0, {}]]", one());
      default:
        return "\"\"";
    }
  }
  /// Breaks lines at 120 columns.
  void comment(const std::string& text) {
    std::string line = "#";
    std::size_t start = 0;
    while (start < text.size()) {
      const std::size_t end = std::min(text.find_first_of(" \n", start), text.size());
      if (line.size() + 1 + end - start > 120) {
        text_ += line + "\n";
        line = "#";
      }
      if (end == start && line == "#") {  // no double space at the start of a line
        start = end + 1;
        continue;
      }
      line += " " + text.substr(start, end - start);
      start = end + 1;
    }
    if (line != "#") text_ += line + "\n";
  }

  std::string text_;
};

// ----------------------------------------------------------------------------------------------------- resolved
// parameters

class ResolvedWriter {
 public:
  explicit ResolvedWriter(std::function<std::string(const SourcePosition&)> source_of)
      : source_of_(std::move(source_of)) {}
  /// @param shared  for a named table of variants: the values that come from its parent table
  void section(const SectionDeclaration& section, const Node& table, const std::string& path,
               const Node& shared = Node(), const std::string& path_of_shared = "") {
    for (const Declaration& d : section.declarations) {
      const Node* given = table.find(d.key);
      const Node* from_parent = shared.find(d.key);
      if (is_one_value(d) || is_empty_list(d, given ? given : from_parent))
        value(d, given, from_parent, position_of(given ? table : shared, d.key), path_of_shared);
    }
    for (const Declaration& d : section.declarations) {
      const Node* given = table.find(d.key);
      const Node* from_parent = shared.find(d.key);
      if (given && from_parent)
        tables(d, merged(*from_parent, *given), joined_path(path, d.key), "");
      else if (given)
        tables(d, *given, joined_path(path, d.key), "");
      else if (from_parent)
        tables(d, *from_parent, joined_path(path, d.key), fmt::format("  # from [{}]", path_of_shared));
      else if (d.fallback || (d.kind == Kind::table && d.required))
        tables(d, d.fallback ? *d.fallback : Node::table(), joined_path(path, d.key), "  # default");
    }
  }
  void header(const std::string& header) { text_ += (text_.empty() ? "" : "\n") + header + "\n"; }
  const std::string& text() const { return text_; }

 private:
  static bool is_empty_list(const Declaration& d, const Node* given) {
    return d.kind == Kind::list && given && given->is_array() && given->items().empty();
  }
  void value(const Declaration& d, const Node* given, const Node* from_parent, const SourcePosition& where,
             const std::string& path_of_shared) {
    const auto source = [&](const char* prefix) { return source_of_ ? prefix + source_of_(where) : ""; };
    if (given)
      text_ += fmt::format("{} = {}{}\n", toml_key(d.key), toml_value(*given), source("  # from "));
    else if (from_parent)
      text_ += fmt::format("{} = {}  # from [{}]{}\n", toml_key(d.key), toml_value(*from_parent), path_of_shared,
                           source(", "));
    else if (d.fallback)
      text_ += fmt::format("{} = {}  # default\n", toml_key(d.key), toml_value(*d.fallback));
  }
  void tables(const Declaration& d, const Node& node, const std::string& path, const std::string& mark) {
    if (d.kind == Kind::table) {
      header(fmt::format("[{}]{}", path, mark));
      section(*d.nested, node, path);
    } else if (d.kind == Kind::list && node.is_array()) {
      for (const Node& item : node.items()) {
        header(fmt::format("[[{}]]{}", path, mark));
        section(*d.nested, item, path);
      }
    } else if (d.kind == Kind::tables && node.is_table()) {
      if (node.entries().empty())  // given as empty: that is not the default
        header(fmt::format("[{}]{}", path, mark));
      for (const Node::Entry& entry : node.entries()) {
        header(fmt::format("[{}]{}", joined_path(path, entry.key), mark));
        section(*d.nested, entry.value, joined_path(path, entry.key));
      }
    } else if (d.kind == Kind::variants && node.is_table()) {
      for (const Node::Entry& entry : node.entries())
        if (const VariantDeclaration* chosen = variant_of(d, entry.value); chosen && !is_variant_default(d, entry)) {
          header(fmt::format("[{}]", joined_path(path, entry.key)));
          const std::string tag_mark = entry.value.has(d.tag_key) ? "" : "  # default";
          text_ += fmt::format("{} = {}{}\n", toml_key(d.tag_key), quoted_text(chosen->tag), tag_mark);
          section(without_tag(*chosen->section, d.tag_key), entry.value, joined_path(path, entry.key),
                  variant_defaults(node, *chosen), path);
        }
    }
  }
  /// A section may declare the key that selects it, too; it is written once.
  static SectionDeclaration without_tag(SectionDeclaration section, const std::string& tag_key) {
    std::erase_if(section.declarations, [&](const Declaration& d) { return d.key == tag_key; });
    return section;
  }

  const std::function<std::string(const SourcePosition&)> source_of_;
  std::string text_;
};

// ------------------------------------------------------------------------------------------------------------------
// schema

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

std::string toml_value(const Node& node) {
  const auto joined = [](const auto& range, const auto& text_of) {
    std::string result;
    for (const auto& item : range) result += (result.empty() ? "" : ", ") + text_of(item);
    return result;
  };
  switch (node.kind()) {
    case Node::Kind::null:
      throw std::invalid_argument("TOML has no null");
    case Node::Kind::boolean:
      return node.boolean() ? "true" : "false";
    case Node::Kind::integer:
      return fmt::format("{}", node.integer());
    case Node::Kind::real:
      return toml_number(node.number());
    case Node::Kind::text:
      return quoted_text(node.text());
    case Node::Kind::array:
      return "[" + joined(node.items(), toml_value) + "]";
    case Node::Kind::table:
      if (node.entries().empty()) return "{}";
      return "{ " +
             joined(node.entries(),
                    [](const Node::Entry& e) { return toml_key(e.key) + " = " + toml_value(e.value); }) +
             " }";
  }
  return "";
}

std::string write_defaults(const std::vector<ErasedSection>& sections) {
  DefaultsWriter writer;
  for (const ErasedSection& section : top_level_first(sections)) {
    const std::string path = section->name.empty() ? "" : toml_key(section->name);
    if (!path.empty()) writer.header(fmt::format("[{}]", path), section->help, false);
    writer.section(*section, path, false);
  }
  return writer.text();
}

std::string write_resolved(const std::vector<ErasedSection>& sections, const Node& tree,
                           const std::function<std::string(const SourcePosition&)>& source_of) {
  ResolvedWriter writer(source_of);
  for (const ErasedSection& section : top_level_first(sections)) {
    if (section->name.empty()) {
      writer.section(*section, tree, "");
      continue;
    }
    const std::string path = toml_key(section->name);
    writer.header(fmt::format("[{}]", path));
    const Node* given = tree.find(section->name);
    writer.section(*section, given ? *given : Node::table(), path);
  }
  return writer.text();
}

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
