#pragma once
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "case/case.h"

namespace rotordrop {

/// Cases of one file that differ by their settings: the file, its bases and the rotor's geometry are read once.
/// Any number of threads may read from one family.
class CaseFamily {
 public:
  explicit CaseFamily(const std::filesystem::path& file);
  /// As read_case(), but without Case::resolved and, unless `has_warnings`, Case::warnings; those of what one layer of the files replaces in another
  /// are never among them.
  [[nodiscard]] Case read(const std::vector<std::string>& overrides, bool has_warnings = false) const;

 private:
  std::filesystem::path file_;
  Node tree_;  ///< of the file with its bases
  mutable std::mutex lock_;
  mutable std::map<std::filesystem::path, Node> geometries_;  ///< by their files
};

}  // namespace rotordrop
