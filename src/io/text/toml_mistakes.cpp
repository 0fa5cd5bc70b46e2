#include "io/text/toml_mistakes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <regex>
#include <vector>

#include "base/trimmed.h"
#include "io/text/comments.h"

namespace rotordrop {
namespace {

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines(1);
  for (const char c : text)
    if (c == '\n')
      lines.emplace_back();
    else if (c != '\r')
      lines.back() += c;
  return lines;
}

/// Longer lines are not searched: the library's patterns call themselves for every letter.
constexpr std::size_t longest_line = 2000;

/// What a mistake is, and the line as it is meant; empty if that is not clear.
struct Guess {
  std::string what, meant;
  std::string otherwise = {};  ///< another way in which it may be meant
};

const std::string key_pattern = R"(^\s*([A-Za-z0-9_."'-]+)\s*)";

/// Whether quotes of a line are left open, and from where on.
std::optional<std::size_t> open_quote(const std::string& line) {
  std::optional<std::size_t> open;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (!open && line[i] == '#') break;
    if (line[i] == '\\' && open && line[*open] == '"')
      ++i;
    else if (open && line[i] == line[*open])
      open.reset();
    else if (!open && (line[i] == '"' || line[i] == '\''))
      open = i;
  }
  return open;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// First line before `line` that fits, from 1; 0 if none does.
int earlier_line(const std::vector<std::string>& lines, int line, const std::regex& pattern) {
  for (int i = 0; i + 1 < line && i < static_cast<int>(lines.size()); ++i)
    if (const auto& one = lines[static_cast<std::size_t>(i)];
        one.size() <= longest_line && std::regex_search(one, pattern))
      return i + 1;
  return 0;
}

std::string escaped_for_pattern(const std::string& text) {
  return std::regex_replace(text, std::regex(R"([.^$|()\[\]{}*+?\\])"), R"(\$&)");
}

/// Mistakes of a value: `key = value`.
std::optional<Guess> about_value(const std::string& key, const std::string& value) {
  std::smatch m;
  if (value.empty()) return Guess{key + " has no value", ""};
  if (value[0] == '(' && value.back() == ')') {
    const std::string inside = value.substr(1, value.size() - 2);
    const bool is_table = inside.find('=') != std::string::npos;
    return Guess{"a list is in square brackets, a table in braces",
                 fmt::format("{} = {}{}{}", key, is_table ? '{' : '[', inside, is_table ? '}' : ']')};
  }
  // 12000; rpm   0.25 "mm"   "250" um
  for (const char* apart : {R"(([+-]?\d[\d.eE+-]*)\s*[;,]\s*([A-Za-z][A-Za-z0-9/ ]*))",
                            R"(([+-]?[\d.]+(?:[eE][+-]?\d+)?)\s*["']([^"']*)["'])",
                            R"(["']([+-]?[\d.]+(?:[eE][+-]?\d+)?)["']\s*(?!//|%)([A-Za-z%/][^"]*))"})
    if (std::regex_match(value, m, std::regex(apart)))
      return Guess{"number and unit are together in quotes", fmt::format("{} = \"{} {}\"", key, m.str(1), m.str(2))};
  if (value[0] == '{' && value.back() == '}') {
    static const std::regex without_comma(R"(("[^"]*"|[+-]?\d[\d.eE+-]*|true|false|\}|\])\s+(?=[A-Za-z_]+\s*=))");
    if (std::regex_search(value, without_comma))
      return Guess{"entries of a table in braces are separated by commas",
                   fmt::format("{} = {}", key, std::regex_replace(value, without_comma, "$1, "))};
  }
  if (value[0] == '=') {
    const auto rest = std::min(value.find_first_not_of('='), value.size());
    return Guess{"there is one equals sign",
                 fmt::format("{} = {}", key, trimmed(std::string_view(value).substr(rest)))};
  }
  if (std::regex_match(value, std::regex("(true|false|yes|no|on|off)", std::regex::icase))) {
    const char first = static_cast<char>(std::tolower(static_cast<unsigned char>(value[0])));
    const bool is_true = first == 't' || first == 'y' || (first == 'o' && value.size() == 2);
    return Guess{"yes and no are written true and false, in small letters", key + (is_true ? " = true" : " = false")};
  }
  if (std::regex_match(value, m, std::regex(R"(([+-]?[1-9]\d{0,2}),(\d{3})\s*([A-Za-z/].*)?)"))) {
    const auto written = [&](const char* between) {
      return m[3].length() > 0 ? fmt::format("{} = \"{}{}{} {}\"", key, m.str(1), between, m.str(2), m.str(3))
                               : fmt::format("{} = {}{}{}", key, m.str(1), between, m.str(2));
    };
    return Guess{"a number has no comma", written(""), "If a decimal point is meant: " + written(".")};
  }
  if (std::regex_match(value, m, std::regex(R"(([+-]?[\d.]+)\s*/\s*(\d[\d.]*))")))
    if (const double divisor = std::strtod(m.str(2).c_str(), nullptr); divisor != 0.)
      return Guess{"a number is no fraction",
                   fmt::format("{} = {}", key, std::strtod(m.str(1).c_str(), nullptr) / divisor)};
  if (std::regex_match(value, m,
                       std::regex(R"(("[^"]*"|'[^']*'|[+-]?\d[\d.eE+-]*|true|false)\s*(?:;|,|//.*|--.*|%.*))")))
    return Guess{"nothing stands behind a value but a comment, which begins with #",
                 fmt::format("{} = {}", key, m.str(1))};
  if (value[0] == '[' && std::regex_search(value, m, std::regex(R"((?:"[^"]*"|[+-]?\d[\d.]*)(\s+)(?=["\d+-]))")) &&
      m.length(1) > 0)
    return Guess{
        "entries of a list are separated by commas",
        fmt::format("{} = {}", key,
                    std::regex_replace(value, std::regex(R"(("[^"]*"|[+-]?\d[\d.]*)\s+(?=["\d+-]))"), "$1, "))};
  if (std::regex_match(value, m, std::regex(R"(([+-]?\d+),(\d+)\s*([A-Za-z/].*)?)")))
    return Guess{"a number has a decimal point, not a comma",
                 m[3].length() > 0 ? fmt::format("{} = \"{}.{} {}\"", key, m.str(1), m.str(2), m.str(3))
                                   : fmt::format("{} = {}.{}", key, m.str(1), m.str(2))};
  if (std::regex_match(value, m, std::regex(R"(([+-]?)\.(\d.*))")))
    return Guess{"a number begins with a digit", fmt::format("{} = {}0.{}", key, m.str(1), m.str(2))};
  if (std::regex_match(value, m, std::regex(R"(([+-]?\d+)\.([eE].*)?)")))
    return Guess{"a digit follows the decimal point", fmt::format("{} = {}.0{}", key, m.str(1), m.str(2))};
  if (std::regex_match(value, std::regex(R"([+-]?[\d.]+([eE][+-]?\d+)?\s*[A-Za-z%/].*)")))
    return Guess{"a value with a unit is in quotes", fmt::format("{} = \"{}\"", key, value)};
  if (std::regex_match(value, std::regex(R"([A-Za-z][A-Za-z0-9 _./-]*)")))
    return Guess{"a text is in quotes", fmt::format("{} = \"{}\"", key, value)};
  if (std::regex_match(value, std::regex(R"(\d+-[A-Za-z0-9-]+)")))
    return Guess{"a text is in quotes, also one that begins with digits", fmt::format("{} = \"{}\"", key, value)};
  if (std::regex_search(value, m, std::regex(R"(=\s*(?!(?:true|false|inf|nan)\b)([A-Za-z][A-Za-z0-9 _/-]*?)\s*[,}])")))
    return Guess{"a text is in quotes, in lists and tables, too",
                 fmt::format("{} = {}{}{}", key, value.substr(0, static_cast<std::size_t>(m.position(1))),
                             fmt::format("\"{}\"", m.str(1)),
                             value.substr(static_cast<std::size_t>(m.position(1) + m.length(1))))};
  if (value[0] == '{' && value.find('}') == std::string::npos)
    return Guess{"a table in braces is on one line, from { to }", ""};
  if (value[0] == '[' && std::count(value.begin(), value.end(), '[') > std::count(value.begin(), value.end(), ']'))
    return Guess{"a list is not closed with ]", ""};
  if (std::regex_search(value, m,
                        std::regex(R"(^[\[{](?:.*?[\[,=])?\s*([+-]?[\d.]+(?:[eE][+-]?\d+)?\s*[A-Za-z%/][^,\]}"]*))")))
    return Guess{"a value with a unit is in quotes, in lists, too",
                 fmt::format("{} = {}", key, replaced(value, m.str(1), fmt::format("\"{}\"", trimmed(m.str(1)))))};
  return {};
}

std::optional<Guess> about_line(const std::vector<std::string>& lines, int number, std::string_view description) {
  const std::string& line = lines[static_cast<std::size_t>(number - 1)];
  if (line.size() > longest_line) return {};
  const std::string bare(trimmed(split_comment(line).first));
  std::smatch m;
  for (const char* quote : {"\u201c", "\u201d", "\u201e", "\u201f", "\u00ab", "\u00bb"})
    if (line.find(quote) != std::string::npos) {
      std::string meant(trimmed(line));
      for (const char* other : {"\u201c", "\u201d", "\u201e", "\u201f", "\u00ab", "\u00bb"})
        meant = replaced(meant, other, "\"");
      return Guess{"quotes are straight (\"), not those of a word processor", meant};
    }
  if (description.find("cannot redefine existing table") != std::string_view::npos &&
      std::regex_match(bare, m, std::regex(R"(\[\s*([^\[\]]+?)\s*\])"))) {
    const int first =
        earlier_line(lines, number, std::regex("^\\s*\\[\\s*" + escaped_for_pattern(m.str(1)) + "\\s*\\]"));
    return Guess{fmt::format("the section [{}] is there twice{}", m.str(1),
                             first > 0 ? fmt::format(", first in line {}: move its keys there", first) : ""),
                 ""};
  }
  if (description.find("cannot redefine existing") != std::string_view::npos &&
      std::regex_search(bare, m, std::regex(key_pattern + "="))) {
    const int first = earlier_line(lines, number, std::regex("^\\s*" + escaped_for_pattern(m.str(1)) + "\\s*="));
    return Guess{fmt::format("{} is given twice{}", m.str(1),
                             first > 0 ? fmt::format(", first in line {}: remove one", first) : ""),
                 ""};
  }
  if (std::regex_search(line, std::regex(R"(^\s*(//|;|%|--))")))
    return Guess{"a comment begins with #",
                 fmt::format("# {}", trimmed(std::regex_replace(line, std::regex(R"(^\s*(//|;|%|--)+\s*)"), "")))};
  const bool is_of_escapes =
      description.find("escape") != std::string_view::npos || description.find("unicode") != std::string_view::npos;
  if (is_of_escapes && line.find('\\') != std::string::npos)
    return Guess{"a backslash has a meaning of its own in double quotes; in the name of a file write /",
                 replaced(std::string(trimmed(line)), "\\", "/")};
  if (std::regex_match(bare, m, std::regex(R"(\[+\s*([A-Za-z0-9_.-]+)\s*\]?)")) && !bare.ends_with("]"))
    return Guess{"the name of a section has no closing bracket", fmt::format("[{}]", m.str(1))};
  if (std::regex_match(bare, m, std::regex(R"(\[\s*([A-Za-z0-9_.-]+)\s+([A-Za-z0-9_.-]+)\s*\])")))
    return Guess{"parts of a section's name are joined by a point", fmt::format("[{}.{}]", m.str(1), m.str(2))};
  if (std::regex_match(bare, m, std::regex(R"(([A-Za-z][A-Za-z0-9_.-]*)\s*:)")))
    return Guess{"the name of a section is in brackets, and its keys follow line by line, each with an equals sign",
                 fmt::format("[{}]", m.str(1))};
  if (const auto open = open_quote(line)) {
    const std::string_view text = trimmed(std::string_view(line).substr(*open + 1));
    const bool is_simple = text.find_first_of("\"',[]{}#=") == std::string::npos;
    return Guess{"a text has no closing quote",
                 is_simple ? fmt::format("{} \"{}\"", trimmed(std::string_view(line).substr(0, *open)), text) : ""};
  }
  if (std::regex_match(bare, m,
                       std::regex(R"(([A-Za-z0-9_.\[\]-]*\*[A-Za-z0-9_.*\[\]-]*?)(?:\.(max|min))?\s*=\s*(.*))")))
    return Guess{"a name with * is in quotes", m[2].length() > 0
                                                   ? fmt::format("\"{}\" = {{ {} = {} }}", m.str(1), m.str(2), m.str(3))
                                                   : fmt::format("\"{}\" = {}", m.str(1), m.str(3))};
  if (std::regex_match(bare, m, std::regex(key_pattern + R"(:=?\s*(.*)$)")))
    return Guess{"a value follows an equals sign", fmt::format("{} = {}", m.str(1), m.str(2))};
  if (std::regex_match(bare, m, std::regex(key_pattern + R"(=\s*(.*)$)")))
    return about_value(m.str(1), std::string(trimmed(m.str(2))));
  if (std::regex_match(bare, m, std::regex(R"(([A-Za-z_]+(?:\s+[A-Za-z_]+)+)\s*=\s*(.+))"))) {
    const std::string key = std::regex_replace(m.str(1), std::regex(R"(\s+)"), "_");
    return Guess{"the name of a key has no spaces", fmt::format("{} = {}", key, m.str(2))};
  }
  if (std::regex_match(bare, m, std::regex(key_pattern + R"(([+-]?[\d"'].*)$)")))
    return Guess{"there is no equals sign between key and value", fmt::format("{} = {}", m.str(1), m.str(2))};
  if (std::regex_match(bare, std::regex(R"([A-Za-z][A-Za-z0-9_. -]*)")))
    return Guess{"a line is KEY = VALUE, the name of a section in brackets, or a comment", ""};
  return {};
}

}  // namespace

TomlMistake toml_mistake(std::string_view text, int line, std::string_view description) {
  const auto lines = lines_of(text);
  // What is left open shows only at the next line's end, or at that of the text.
  line = std::clamp(line, 1, static_cast<int>(lines.size()));
  std::optional<Guess> guess = about_line(lines, line, description);
  for (int before = line - 1; !guess && before >= 1 && before >= line - 2; --before)
    if (guess = about_line(lines, before, description); guess) line = before;
  std::string own(description);
  if (own.starts_with("Error")) own.front() = 'e';
  std::string shown(trimmed(lines[static_cast<std::size_t>(line - 1)]));
  if (shown.size() > longest_line) {
    std::size_t end = 200;
    while (end > 0 && (static_cast<unsigned char>(shown[end]) & 0xc0u) == 0x80u) --end;  // not within a letter
    shown = fmt::format("{} ... ({} characters)", shown.substr(0, end), shown.size());
  }
  if (!guess) return {fmt::format("this is not valid TOML: {}.", own), shown.empty() ? "" : "The line is: " + shown};
  return {fmt::format("this is not valid TOML: {}.", guess->what),
          (guess->meant.empty() ? "The line is: " + shown : "Write it as: " + guess->meant) +
              (guess->otherwise.empty() ? "" : "\n" + guess->otherwise)};
}

}  // namespace rotordrop
