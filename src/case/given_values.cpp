#include "case/given_values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/errors.h"
#include "base/units.h"
#include "case/case.h"
#include "io/sha256.h"
#include "io/text/toml_reader.h"

namespace rotordrop {
namespace {

/// @param length  in bytes, at most; a letter of several bytes (UTF-8) is not cut
std::string shortened(const std::string& text, std::size_t length) {
  if (text.size() <= length) return text;
  const auto is_inside_letter = [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u; };
  while (length > 0 && is_inside_letter(text[length])) --length;
  return text.substr(0, length) + " … (in parameters.toml)";
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

/// Of a quantity, in SI; NaN of anything else.
double number_of(const Node& value, const std::string& unit) {
  if (value.is_number()) return value.number();
  if (!value.is_text() || unit.empty()) return std::nan("");
  const auto read = convert_to_si(value.text(), unit, kind_of(unit));
  return read ? read.value : std::nan("");
}

bool is_default(const Node& value, const Node& fallback, const std::string& unit) {
  const double a = number_of(value, unit), b = number_of(fallback, unit);
  return std::fabs(a - b) <= 1e-12 * std::fabs(b);
}

std::string in_si(const std::string& text) {
  return resolved_in_si(case_sections(), parse_toml(text, "parameters.toml"));
}

using NamedValues = std::map<std::string, std::string>;

void collect(const Node& table, const std::string& path, NamedValues& to) {
  for (const auto& entry : table.entries())
    if (const std::string name = path + (path.empty() ? "" : ".") + entry.key; entry.value.is_table())
      collect(entry.value, name, to);
    else
      to[name] = shortened(to_text(entry.value), 40);
}

}  // namespace

std::string differing_parameters(const std::string& before, const std::string& now) {
  NamedValues old_values, new_values;
  try {
    collect(parse_toml(in_si(before), "parameters.toml"), "", old_values);
    collect(parse_toml(in_si(now), "parameters.toml"), "", new_values);
  } catch (const InputError&) {
    return {};
  }
  NamedValues all = old_values;
  all.insert(new_values.begin(), new_values.end());
  constexpr std::size_t most_shown = 5;
  std::vector<std::string> differing;
  for (const auto& [name, value] : all) {
    const auto a = old_values.find(name), b = new_values.find(name);
    const std::string then = a == old_values.end() ? "none" : a->second,
                      here = b == new_values.end() ? "none" : b->second;
    if (then != here) differing.push_back(fmt::format("{} ({}, now {})", name, then, here));
  }
  const std::size_t n = differing.size();
  differing.resize(std::min(n, most_shown));
  return fmt::format("{}{}", fmt::join(differing, ", "),
                     n > most_shown ? fmt::format(" and {} more", n - most_shown) : "");
}

std::string digest_of_parameters(const std::string& text) {
  try {
    return sha256_of_toml(in_si(text));
  } catch (const InputError&) {
    return sha256_of_toml(text);
  }
}

std::string given_values_json(const ResolvedParameters& parameters) {
  auto values = nlohmann::ordered_json::array();
  for (const auto& p : parameters.given) {
    const std::string fallback = p.fallback ? normalised(shortened(toml_value(*p.fallback), 40), p.unit) : "—";
    const std::string value = normalised(shortened(toml_value(p.value), 60), p.unit);
    if (fallback != value && !(p.fallback && is_default(p.value, *p.fallback, p.unit)))
      values.push_back({p.name, value, fallback, p.origin, p.help});
  }
  // ASCII: Octave stops reading a result file at any other text.
  return nlohmann::ordered_json{{"values", values}, {"n_defaults", parameters.n_defaults}}.dump(
      -1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace rotordrop
