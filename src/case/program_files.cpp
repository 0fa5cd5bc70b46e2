#include "case/program_files.h"

#include <fmt/format.h>

#include <cstdlib>

#include "base/errors.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

fs::path program_folder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

ProgramFolders& folders() {
  static ProgramFolders set;
  return set;
}

}  // namespace

void set_program_folders(const ProgramFolders& set) { folders() = set; }

fs::path params_folder() {
  if (!folders().params.empty()) return folders().params;
  const fs::path installed = program_folder() / ROTORDROP_RELATIVE_DATA / "params";
  return fs::is_directory(installed) ? installed.lexically_normal() : fs::path(ROTORDROP_PARAMS_DIRECTORY);
}

void look_for_file(const fs::path& file) {
  std::error_code ignored;
  if (fs::exists(file, ignored) || fs::exists(file.string() + ".toml", ignored)) return;
  for (fs::recursive_directory_iterator own(params_folder(), ignored), end; own != end; own.increment(ignored))
    if (own->path().filename() == file.filename() || own->path().filename() == file.filename().string() + ".toml")
      throw InputError({file.string()}, fmt::format("file \"{}\" cannot be read: there is none.", file.string()),
                       fmt::format("The program brings one of this name along: {}", own->path().string()));
}

fs::path module_file(const std::string& name) {
  if (const char* chosen = std::getenv("ROTORDROP_MODULES")) return fs::path(chosen) / name;
  if (!folders().modules.empty()) return folders().modules / name;
  const fs::path beside = program_folder() / name;
  return fs::exists(beside) ? beside : (program_folder() / ROTORDROP_RELATIVE_MODULES / name).lexically_normal();
}

}  // namespace rotordrop
