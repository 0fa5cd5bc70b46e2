#pragma once
#include <filesystem>

namespace rotordrop {

/// From now on remember_read() notes files. For programs that do one thing and end: in others, such as Python, what was read long ago may be
/// written again.
void protect_inputs();

/// Notes a file that this process has read as an input: nothing that it writes may replace it.
void remember_read(const std::filesystem::path& file);

/// Whether this file is one of them, be it by another name or a link.
[[nodiscard]] bool was_read(const std::filesystem::path& file);

}  // namespace rotordrop
