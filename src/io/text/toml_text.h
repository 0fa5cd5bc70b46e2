#pragma once

// Pieces of TOML.
#include <string>
#include <string_view>
#include <vector>

#include "base/parameters/declaration.h"

namespace rotordrop {

/// A text in quotes, with escapes.
std::string quoted_text(std::string_view text);
/// A key, in quotes if it has to be.
std::string toml_key(const std::string& key);
/// "bearings.TB1" of "bearings" and "TB1".
std::string joined_path(const std::string& path, const std::string& key);
/// Whether a key stands on one line, rather than as a table or several.
bool is_one_value(const Declaration& declaration);
/// The sections in the order of a file: one without a name holds the top level, which TOML wants before all tables.
std::vector<ErasedSection> top_level_first(std::vector<ErasedSection> sections);

}  // namespace rotordrop
