#pragma once
#include <string>
#include <string_view>
#include <utility>

#include "base/node.h"

namespace rotordrop {

/// A line of TOML: what stands before the "#" of its comment, and the comment without "#" and blanks around it.
std::pair<std::string_view, std::string_view> split_comment(std::string_view line);

/// A TOML text whose lines have no comments.
std::string without_comments(std::string_view text);

/// Where the value of a key is from, as one line: file without folders, line, and what its author wrote behind it,
/// "neisi2019.toml:14: source: (P)"; of a value from a parameters.toml of rotordrop the origin that stands there; of `--set KEY`, that;
/// "the program" for a value from no input.
std::string origin_text(const Node::Entry& entry);

/// Begins such an origin in a comment of parameters.toml.
inline constexpr std::string_view origin_mark = "from ";

}  // namespace rotordrop
