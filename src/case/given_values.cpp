#include "case/given_values.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "case/case.h"
#include "io/text/parameter_writers.h"
#include "io/text/source_comments.h"

namespace rotordrop {
namespace {

/// One `key = value` of parameters.toml.
struct Assignment {
  std::string section, key, value, source;
  bool is_default = false;
};

std::vector<Assignment> assignments_of(const std::filesystem::path& file) {
  std::vector<Assignment> list;
  std::ifstream stream(file);
  std::string section;
  std::map<std::string, int> count;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("[[")) {
      section = line.substr(2, line.find("]]") - 2);
      section += fmt::format("[{}]", count[section]++);
    } else if (line.starts_with("[")) {
      section = line.substr(1, line.find(']') - 1);
    } else if (const auto equals = line.find(" = "); equals != std::string::npos) {
      const std::string_view code = split_comment(line).first, comment = split_comment(line).second;
      Assignment a{section, line.substr(0, equals), std::string(code.substr(equals + 3)), "", comment == "default"};
      a.value.resize(a.value.find_last_not_of(' ') + 1);
      if (comment.starts_with(source_mark)) a.source = comment.substr(std::string_view(source_mark).size());
      list.push_back(std::move(a));
    }
  }
  return list;
}

std::string shortened(const std::string& text, std::size_t length) {
  return text.size() <= length ? text : text.substr(0, length) + " … (in parameters.toml)";
}

/// "2.0 rad/s" and 2.0 of a parameter in rad/s as number and unit; a value that begins with no number as it is.
std::string normalised(std::string text, const std::string& unit) {
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (end == text.c_str()) return text;
  std::string rest(end);
  if (!rest.empty() && rest.front() != ' ') return text;
  if (rest.empty() && !unit.empty() && unit != "1") rest = " " + unit;
  return fmt::format("{:.6g}{}", number, rest);
}

using Path = std::vector<std::string>;

const Declaration* found_in(const SectionDeclaration& section, const Path& path, std::size_t at) {
  if (at >= path.size()) return nullptr;
  const Declaration* d = section.find(path[at]);
  if (!d || at + 1 == path.size()) return d;
  const bool is_named = d->kind == Declaration::Kind::tables;
  if (d->nested) return found_in(*d->nested, path, at + (is_named ? 2 : 1));
  for (const auto& variant : d->variants)
    if (const auto* found = found_in(*variant.section, path, at + 2)) return found;
  return nullptr;
}

const Declaration* declaration_of(const std::vector<ErasedSection>& sections, const std::string& name) {
  Path path;
  std::istringstream stream(name);
  for (std::string part; std::getline(stream, part, '.');) path.push_back(part.substr(0, part.find('[')));
  for (const auto& section : sections) {
    const bool is_top = section->name.empty();
    if (!is_top && section->name != path[0]) continue;
    if (const auto* found = found_in(*section, path, is_top ? 0 : 1)) return found;
  }
  return nullptr;
}

std::string materials_source(const std::vector<ErasedSection>& sections) {
  const Declaration* materials = sections.front()->find("materials");
  return materials ? materials->source : "";
}

}  // namespace

GivenValues given_values(const std::filesystem::path& parameters) {
  GivenValues values;
  const auto sections = case_sections();
  for (const auto& a : assignments_of(parameters)) {
    if (a.is_default) {
      ++values.n_defaults;
      continue;
    }
    const std::string name = a.section.empty() ? a.key : a.section + "." + a.key;
    const Declaration* d = declaration_of(sections, name);
    const std::string unit = d ? d->unit : "";
    const std::string fallback = d && d->fallback ? normalised(shortened(toml_value(*d->fallback), 40), unit) : "—";
    const std::string value = normalised(shortened(a.value, 60), unit);
    if (fallback == value) continue;
    const bool is_built_in = a.source == "the program" && a.section.starts_with("materials.");
    values.list.push_back({name, value, fallback, is_built_in ? "the program: " + materials_source(sections) : a.source,
                           d ? d->help : ""});
  }
  return values;
}

}  // namespace rotordrop
