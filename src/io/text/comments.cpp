#include "io/text/comments.h"

#include <fmt/format.h>

#include <filesystem>

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

std::string without_comments(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t begin = 0; begin < text.size();) {
    const auto end = text.find('\n', begin);
    result += split_comment(text.substr(begin, end - begin)).first;
    if (end == std::string_view::npos) break;
    result += '\n';
    begin = end + 1;
  }
  return result;
}

std::string origin_text(const Node::Entry& entry) {
  const SourcePosition& where = entry.where;
  if (!where.is_known()) return "the program";
  if (where.line == 0) return where.file.text().starts_with("--set") ? "--set" : where.file.text();
  if (entry.comment.starts_with(origin_mark)) return entry.comment.substr(origin_mark.size());
  const std::string place =
      fmt::format("{}:{}", std::filesystem::path(where.file.text()).filename().string(), where.line);
  return entry.comment.empty() ? place : fmt::format("{}: {}", place, entry.comment);
}

}  // namespace rotordrop
