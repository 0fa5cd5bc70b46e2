#pragma once
#include <string_view>

namespace rotordrop {

/// A text without blanks at both ends; a part of it, so it must not be of a temporary that ends before.
inline std::string_view trimmed(std::string_view text, std::string_view blanks = " \t") {
  const auto first = text.find_first_not_of(blanks);
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

}  // namespace rotordrop
