#pragma once
#include <string>
#include <string_view>

namespace rotordrop {

/// A mistake in a TOML text, in words that need no knowledge of TOML.
struct TomlMistake {
  std::string message;  ///< "this is not valid TOML: a text has no closing quote."
  std::string advice;   ///< the line, and how it is meant, if that can be told
};

/// @param text         the whole text
/// @param line         of the mistake, from 1, as the parser has it
/// @param description  the parser's own words, for mistakes that are not known here
TomlMistake toml_mistake(std::string_view text, int line, std::string_view description);

}  // namespace rotordrop
