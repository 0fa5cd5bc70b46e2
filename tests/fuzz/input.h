#pragma once
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "base/errors.h"

// What the targets share. An input may be refused by the program's own errors; anything else that leaves a target is a fault.
namespace rotordrop::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A file with the input in it, in memory if the system has such a place; the same one each time.
inline const std::filesystem::path& file_of(const std::uint8_t* data, std::size_t size, const std::string& ending) {
  namespace fs = std::filesystem;
  static const fs::path file = [&] {
    const fs::path memory = "/dev/shm", folder = (fs::is_directory(memory) ? memory : fs::temp_directory_path()) /
                                                 ("rotordrop-fuzz-" + std::to_string(::getpid()));
    fs::create_directories(folder);
    return folder / ("input" + ending);
  }();
  std::ofstream(file, std::ios::binary | std::ios::trunc) << text_of(data, size);
  return file;
}

/// Calls; errors of the program are answers.
template <class Call>
void allow_refusal(const Call& call) {
  try {
    call();
  } catch (const InputError&) {
  } catch (const SolverError&) {
  }
}

}  // namespace rotordrop::fuzz
