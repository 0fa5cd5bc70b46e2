#include "io/text/source_comments.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "base/trimmed.h"

namespace rotordrop {

std::pair<std::string_view, std::string_view> split_comment(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote == '"' && c == '\\')
      ++i;
    else if (quote != 0)
      quote = c == quote ? '\0' : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == '#')
      return {line.substr(0, i), trimmed(line.substr(i + 1), " \t\r")};
  }
  return {line, ""};
}

const std::string& SourceComments::line(const SourcePosition& where) {
  static const std::string none;
  const auto [entry, is_new] = files_.try_emplace(where.file);
  auto& lines = entry->second;
  if (is_new) {
    std::ifstream file(where.file);
    for (std::string text; std::getline(file, text);) lines.push_back(text);
  }
  const auto number = static_cast<std::size_t>(where.line);
  return number >= 1 && number <= lines.size() ? lines[number - 1] : none;
}

std::string SourceComments::at(const SourcePosition& where) {
  if (!where.is_known()) return "the program";
  if (where.line == 0) return where.file.starts_with("--set") ? "--set" : where.file;
  const std::filesystem::path file = where.file;
  const std::string place = fmt::format("{}:{}", file.filename().string(), where.line);
  if (file.extension() != ".toml") return place;
  const auto [code, comment] = split_comment(line(where));
  if (comment.starts_with(source_mark)) return std::string(comment.substr(std::string_view(source_mark).size()));
  return comment.empty() ? place : fmt::format("{}: {}", place, comment);
}

}  // namespace rotordrop
