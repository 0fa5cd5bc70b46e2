#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "base/errors.h"
#include "base/node.h"

// What every reader of an input asks before it begins: is it a file, is it of a size that such a file may have, can its nesting be followed.
namespace rotordrop {

inline constexpr std::size_t largest_input = std::size_t{64} << 20;  ///< [bytes]
inline constexpr std::size_t deepest_input = 100;                    ///< levels of tables, arrays and dotted keys
inline constexpr std::size_t longest_table = 10000;                  ///< keys

/// The content of a regular file. Devices, pipes and directories are refused before they are opened: some never end.
/// @param named_at  where the file's name is given; unknown: the fault is at the file itself
/// @throws InputError
std::string read_input_file(const std::filesystem::path& path, const SourcePosition& named_at = {},
                            std::size_t largest = largest_input);

/// Faults of a key: control characters, which no name of a table, file or dataset may hold.
void require_printable_key(std::string_view key, const SourcePosition& where);
void require_table_size(std::size_t n_keys, const SourcePosition& where);

/// Refuses TOML whose dotted keys or brackets nest deeper than deepest_input: its parser follows them by recursion.
void require_shallow_toml(std::string_view text, const std::string& file);

}  // namespace rotordrop
