#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "case/case.h"

namespace rotordrop {

/// A file that a case only names, and on which its results depend: a mesh, the growth of an earlier run.
struct NamedFile {
  std::filesystem::path path;
  std::string digest;  ///< SHA-256 of its content
};
/// @throws InputError if one cannot be read
[[nodiscard]] std::vector<NamedFile> named_files(const Case& c);

}  // namespace rotordrop
