#include "io/read_files.h"

#include <sys/stat.h>

#include <mutex>
#include <optional>
#include <set>
#include <utility>

namespace rotordrop {
namespace {

using Identity = std::pair<dev_t, ino_t>;

std::optional<Identity> identity_of(const std::filesystem::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return Identity{status.st_dev, status.st_ino};
}

struct Files {
  std::mutex lock;
  bool is_noting = false;
  std::set<Identity> read;
};
Files& files() {
  static Files all;
  return all;
}

}  // namespace

void protect_inputs() {
  const std::lock_guard guard(files().lock);
  files().is_noting = true;
}

void remember_read(const std::filesystem::path& file) {
  const auto identity = identity_of(file);
  if (!identity) return;
  const std::lock_guard guard(files().lock);
  if (files().is_noting) files().read.insert(*identity);
}

bool was_read(const std::filesystem::path& file) {
  const auto identity = identity_of(file);
  if (!identity) return false;
  const std::lock_guard guard(files().lock);
  return files().read.contains(*identity);
}

}  // namespace rotordrop
