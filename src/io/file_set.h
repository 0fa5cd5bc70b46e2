#pragma once
// Private to this room.

#include <filesystem>
#include <mutex>
#include <set>

#include "io/file_identity.h"

namespace rotordrop {

/// Regular files, for all threads: a file is the same by every name and link.
class FileSet {
 public:
  /// What is not there, or is no regular file, is left out.
  void add(const std::filesystem::path& file) {
    const auto identity = identity_of(file);
    if (!identity) return;
    const std::lock_guard guard(lock_);
    files_.insert(*identity);
  }
  [[nodiscard]] bool has(const std::filesystem::path& file) {
    const auto identity = identity_of(file);
    if (!identity) return false;
    const std::lock_guard guard(lock_);
    return files_.contains(*identity);
  }

 private:
  std::mutex lock_;
  std::set<FileIdentity> files_;
};

}  // namespace rotordrop
