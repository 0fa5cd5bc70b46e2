#pragma once
#include <filesystem>

namespace rotordrop {

/// Whether a shared object (ELF, 64 bit) is shorter than its own tables say, as after an interrupted copy: whoever loads it may be ended by a signal.
/// Of other files: false.
bool is_cut_off(const std::filesystem::path& file);

}  // namespace rotordrop
