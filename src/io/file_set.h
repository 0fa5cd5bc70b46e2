#pragma once
// Private to this room.

#include <sys/stat.h>

#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

namespace rotordrop {

/// Regular files by device and number, for all threads: a file is the same by every name and link.
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
  using Identity = std::pair<dev_t, ino_t>;

  static std::optional<Identity> identity_of(const std::filesystem::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
    return Identity{status.st_dev, status.st_ino};
  }

  std::mutex lock_;
  std::set<Identity> files_;
};

}  // namespace rotordrop
