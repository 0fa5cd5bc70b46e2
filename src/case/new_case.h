#pragma once
#include <filesystem>

namespace rotordrop {

/// Starts a case in a new folder: drop.toml built on the reference case, ready to run, and the schema of its keys for editors. Nothing is left of it
/// if a file cannot be written. @throws InputError if one of them is there already
std::filesystem::path new_case(const std::filesystem::path& directory);

/// A folder with a case of a machine of one's own instead: a shaft as a table, bearings of the catalogue on ribbons, limits.
/// @param shaft  a file to be copied and named as the rotor's geometry (a table, JSON or TOML); empty: an example
/// @returns the case @throws InputError if the case exists, or the shaft cannot be read
std::filesystem::path new_own_case(const std::filesystem::path& directory, const std::filesystem::path& shaft);

}  // namespace rotordrop
