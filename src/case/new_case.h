#pragma once
#include <filesystem>

namespace rotordrop {

/// Starts a case in a new folder: drop.toml built on the reference case, ready to run. @throws InputError if it is there already
std::filesystem::path new_case(const std::filesystem::path& directory);

}  // namespace rotordrop
