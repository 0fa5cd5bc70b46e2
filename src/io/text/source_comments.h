#pragma once
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/errors.h"

namespace rotordrop {

/// A line of TOML: what stands before the "#" of its comment, and the comment without "#" and blanks around it.
std::pair<std::string_view, std::string_view> split_comment(std::string_view line);

/// Where values are from, with what their authors wrote behind them: "neisi2019.toml:14: source: (P)". Reads every file once.
class SourceComments {
 public:
  /// Of a value read by read_toml(). Text of one line: file without folders, line, and the line's comment; of a value from a file that
  /// rotordrop has written, what stands there; of `--set KEY`, that; "the program" if the place is unknown.
  std::string at(const SourcePosition& where);

 private:
  const std::string& line(const SourcePosition& where);
  std::map<std::string, std::vector<std::string>> files_;
};

/// Begins such a text in a comment of parameters.toml.
inline constexpr const char* source_mark = "from ";

}  // namespace rotordrop
