#pragma once
#include <algorithm>
#include <array>
#include <filesystem>

namespace rotordrop {

/// Whether a directory holds results of any command that writes a directory of them.
inline bool holds_results(const std::filesystem::path& directory) {
  constexpr std::array files{"results.h5", "summary.json", "preload.h5", "preload.json"};
  std::error_code ignored;
  return std::any_of(files.begin(), files.end(),
                     [&](const char* file) { return std::filesystem::exists(directory / file, ignored); });
}

}  // namespace rotordrop
