#include "io/read_files.h"

#include <atomic>

#include "io/file_set.h"

namespace rotordrop {
namespace {

std::atomic<bool> is_noting = false;

FileSet& files_read() {
  static FileSet files;
  return files;
}

}  // namespace

void protect_inputs() { is_noting = true; }

void remember_read(const std::filesystem::path& file) {
  if (is_noting) files_read().add(file);
}

bool was_read(const std::filesystem::path& file) { return files_read().has(file); }

}  // namespace rotordrop
