#pragma once

#include "base/node.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace rotordrop {

/// Reads a JSON file, such as a rotor's geometry, with the place of every key and value.
/// Throws an InputError for a file that cannot be read, a syntax error or a key that occurs twice.
Node read_json(const std::filesystem::path& path);

/// As read_json, from text; `file` is how positions call it.
Node parse_json(std::string_view text, const std::string& file);

}  // namespace rotordrop
