#include "io/text/toml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "io/text/parameter_writers.h"

namespace rotordrop {

using Kind = Declaration::Kind;

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

namespace {

std::string toml_number(double value) {
  if (std::isnan(value)) return "nan";
  const std::string text = shortest(value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

}  // namespace

std::string joined_path(const std::string& path, const std::string& key) {
  return path.empty() ? toml_key(key) : path + "." + toml_key(key);
}

bool is_one_value(const Declaration& d) {
  return d.kind != Kind::list && d.kind != Kind::table && d.kind != Kind::tables && d.kind != Kind::variants;
}

std::vector<ErasedSection> top_level_first(std::vector<ErasedSection> sections) {
  std::stable_partition(sections.begin(), sections.end(), [](const ErasedSection& s) { return s->name.empty(); });
  return sections;
}

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

}  // namespace rotordrop
