#include "io/text/parameter_keys.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/trimmed.h"
#include "io/text/toml_reader.h"

namespace rotordrop {
namespace {

using Kind = Declaration::Kind;

void add_keys(const SectionDeclaration& section, const std::string& path, std::vector<ParameterKey>& keys) {
  for (const Declaration& d : section.declarations) {
    const std::string here = path.empty() ? d.key : path + "." + d.key;
    if (d.kind == Kind::table) {
      add_keys(*d.nested, here, keys);
    } else if (d.kind == Kind::tables) {
      add_keys(*d.nested, here + ".NAME", keys);
    } else if (d.kind == Kind::variants) {
      for (const auto& variant : d.variants)
        if (variant.takes_defaults) add_keys(*variant.section, here, keys);
      for (const auto& variant : d.variants) add_keys(*variant.section, here + ".NAME", keys);
    } else {
      keys.push_back({here, &d});
    }
  }
}

constexpr std::string_view blanks = " \t\n";

bool is_toml(const std::string& text) {
  try {
    const Node tree = parse_toml("value = " + text, "");
    return tree.entries().size() == 1;
  } catch (const InputError&) {
    return false;
  }
}

/// With ordinary quotes for typographic ones, which word processors and web pages put in their place.
std::string with_plain_quotes(std::string text) {
  for (const auto* quote : {"\u201c", "\u201d", "\u201e", "\u00ab", "\u00bb"})
    for (auto at = text.find(quote); at != std::string::npos; at = text.find(quote))
      text.replace(at, std::string_view(quote).size(), "\"");
  for (const auto* quote : {"\u2018", "\u2019", "\u201a"})
    for (auto at = text.find(quote); at != std::string::npos; at = text.find(quote))
      text.replace(at, std::string_view(quote).size(), "'");
  return text;
}

std::string without_outer_quotes(std::string text) {
  text = std::string(trimmed(text, blanks));
  while (!text.empty() && (text.front() == '"' || text.front() == '\'')) text.erase(0, 1);
  while (!text.empty() && (text.back() == '"' || text.back() == '\'')) text.pop_back();
  return std::string(trimmed(text, blanks));
}

/// "0,05 mm" as "0.05 mm".
std::string with_decimal_point(std::string text) {
  const auto comma = text.find_first_not_of("+-0123456789");
  if (comma == std::string::npos || comma == 0 || text[comma] != ',' || comma + 1 == text.size() ||
      !std::isdigit(static_cast<unsigned char>(text[comma + 1])))
    return text;
  const auto end = text.find_first_not_of("0123456789", comma + 1);
  if (end != std::string::npos && text[end] != ' ') return text;
  const bool is_thousands = std::min(end, text.size()) == comma + 4 && comma <= 4 && text[comma - 1] != '0';
  return is_thousands ? text.erase(comma, 1) : text.replace(comma, 1, ".");
}

/// The pieces between commas that stand in no bracket.
std::vector<std::string> items_of(std::string_view text) {
  std::vector<std::string> items(1);
  int depth = 0;
  for (const char c : text) {
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (c == ',' && depth == 0)
      items.emplace_back();
    else
      items.back() += c;
  }
  for (auto& item : items) item = std::string(trimmed(item, blanks));
  if (items.size() > 1 && items.back().empty()) items.pop_back();
  return items;
}

/// A list whose texts are quoted: [1 um, 2] becomes ["1 um", 2].
std::string mended_list(const std::string& text) {
  const bool is_closed = text.back() == ']';
  std::string list;
  for (const auto& item : items_of(std::string_view(text).substr(1, text.size() - (is_closed ? 2 : 1)))) {
    const std::string inner = item.starts_with("[") ? mended_list(item)
                              : is_toml(item)       ? item
                                                    : "\"" + without_outer_quotes(item) + "\"";
    list += (list.empty() ? "" : ", ") + inner;
  }
  return "[" + list + "]";
}

const Declaration* declaration_of(const std::vector<ParameterKey>& keys, const std::string& key) {
  // What stands for NAME is the second word.
  const auto first = key.find('.');
  const auto second = first == std::string::npos ? first : key.find('.', first + 1);
  const std::string named = second == std::string::npos ? "" : key.substr(0, first) + ".NAME" + key.substr(second);
  for (const auto& candidate : keys)
    if (candidate.path == key || (!named.empty() && candidate.path == named)) return candidate.declaration;
  return nullptr;
}

bool takes_list(const Declaration& d) {
  if (d.kind == Kind::quantities || d.kind == Kind::list) return true;
  return d.kind == Kind::custom && d.json_types == std::vector<std::string>{"array"};
}

/// run.gravity: one value downwards, or a list of three.
bool may_take_list(const Declaration& d) {
  return d.kind == Kind::custom && std::find(d.json_types.begin(), d.json_types.end(), "array") != d.json_types.end();
}

bool is_key(std::string_view word) {
  return word.find('.') != std::string_view::npos && std::isalpha(static_cast<unsigned char>(word.front())) &&
         std::all_of(word.begin(), word.end(),
                     [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '.' || c == '"'; });
}

}  // namespace

std::vector<ParameterKey> parameter_keys(const std::vector<ErasedSection>& sections) {
  std::vector<ParameterKey> keys;
  for (const auto& section : sections) add_keys(*section, section->name, keys);
  // Variants of one table share some keys.
  std::vector<ParameterKey> unique;
  for (const auto& key : keys)
    if (std::none_of(unique.begin(), unique.end(), [&](const auto& other) { return other.path == key.path; }))
      unique.push_back(key);
  return unique;
}

std::string shell_quoted(const std::string& word) {
  if (!word.empty() && word.find_first_of(" \t\n'\"\\$&|;<>()*?[]{}!#~`") == std::string::npos) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string right_form(const std::vector<ErasedSection>& sections, const std::string& key, std::string_view value) {
  const auto keys = parameter_keys(sections);
  const Declaration* d = declaration_of(keys, key);
  std::string text = with_plain_quotes(std::string(trimmed(value, blanks)));
  while (text.starts_with("=")) text = std::string(trimmed(std::string_view(text).substr(1), blanks));
  if (text.starts_with("[") && !is_toml(text))
    text = mended_list(text);
  else if (!text.starts_with("[") && !text.starts_with("{") && d && takes_list(*d)) {
    if (d->kind == Kind::quantities && d->min_count > 1 && text.find(',') == std::string::npos)
      return "";  // one value is not several
    text = mended_list("[" + text + "]");
  } else if (d && may_take_list(*d) && !text.starts_with("[") && items_of(text).size() > 2) {
    text = mended_list("[" + text + "]");
  } else if (!text.starts_with("[") && !text.starts_with("{")) {
    text = without_outer_quotes(text);
    const bool is_number = !text.empty() && text.find_first_not_of("0123456789.+-eE") == std::string::npos;
    text = d && d->kind == Kind::text && is_number ? "\"" + text + "\"" : with_decimal_point(text);
  }
  return "--set " + shell_quoted(key + "=" + text);
}

std::vector<std::string> assignments_in(std::string_view text) {
  const std::string whole(trimmed(text, blanks));
  std::vector<std::string> parts;
  std::size_t begin = 0;
  bool is_quoted = false;
  int depth = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const char c = whole[i];
    if (c == '"' || c == '\'') is_quoted = !is_quoted;
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (is_quoted || depth > 0 || (c != ' ' && c != ',' && c != ';')) continue;
    const auto word = whole.find_first_not_of(" ,;", i);
    if (word == std::string::npos) break;
    const auto end = whole.find_first_of(" ,;=", word);
    if (end == std::string::npos) continue;
    const auto equals = whole.find_first_not_of(' ', end);
    if (equals == std::string::npos || whole[equals] != '=' || equals + 1 == whole.size() ||
        !is_key(std::string_view(whole).substr(word, end - word)))
      continue;
    if (whole.find('=', begin) > i) continue;  // what stands before is no assignment
    parts.emplace_back(trimmed(std::string_view(whole).substr(begin, i - begin), blanks));
    begin = word;
    i = equals;
  }
  parts.emplace_back(trimmed(std::string_view(whole).substr(begin), blanks));
  return parts;
}

}  // namespace rotordrop
