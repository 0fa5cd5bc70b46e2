#pragma once

#include "base/node.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace rotordrop {

/// What completes a file's own tree before it is laid over its base, which is an empty table if it has none.
using CompleteLayer = std::function<void(Node& tree, const std::filesystem::path& file, const Node& base)>;

/// Reads a TOML file with the place of every key and value.
///
/// The key `base = "other.toml"` at the top names a file, relative to this one, whose values hold where this file gives
/// none: tables are merged key by key, arrays and values are replaced. Bases may have bases. The key itself is not in
/// the result. Throws an InputError for a file that cannot be read, a syntax error, or a chain of bases that returns to
/// a file.
///
/// @param complete  called for each file: puts in what its values stand for
Node read_toml(const std::filesystem::path& path, const CompleteLayer& complete = {});

/// The same of a text, as if it stood in a file of that path, which need not exist.
Node read_toml_text(std::string_view text, const std::filesystem::path& path, const CompleteLayer& complete = {});

/// Reads TOML text without looking at `base`; `file` is how positions call it.
Node parse_toml(std::string_view text, const std::string& file);

/// A parameter and the value that it is set to. Messages name the place of the value.
struct Setting {
  std::string key;  ///< "contact.friction_coefficient"
  Node value;
};
/// One as the command line gives it; positions say "--set KEY". Throws an InputError if the text is no assignment.
Setting read_setting(std::string_view assignment);
/// Tables on the way are made where absent. Throws an InputError if the key cannot be one, or goes through a value that is
/// no table.
void apply_setting(Node& tree, const Setting& setting);

/// Sets one parameter as the command line gives it: "contact.friction_coefficient=0.05", "run.initial_speed=15200 rpm".
/// The value is TOML, or otherwise plain text. Tables on the way are made where absent. Positions say "--set KEY".
/// Throws an InputError if the text is no assignment, or if the path goes through a value that is no table.
void apply_override(Node& tree, std::string_view assignment);

}  // namespace rotordrop
