#include "case/program_files.h"

#include <cstdlib>

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

fs::path module_file(const std::string& name) {
  if (const char* chosen = std::getenv("ROTORDROP_MODULES")) return fs::path(chosen) / name;
  if (!folders().modules.empty()) return folders().modules / name;
  const fs::path beside = program_folder() / name;
  return fs::exists(beside) ? beside : (program_folder() / ROTORDROP_RELATIVE_MODULES / name).lexically_normal();
}

}  // namespace rotordrop
