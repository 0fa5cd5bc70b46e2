#pragma once
#include <filesystem>

namespace rotordrop {

/// Notes a file that this process has read as an input: nothing that it writes may replace it.
void remember_read(const std::filesystem::path& file);

/// Whether this file is one of them, be it by another name or a link.
[[nodiscard]] bool was_read(const std::filesystem::path& file);

}  // namespace rotordrop
