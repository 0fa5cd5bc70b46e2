#include "cli/output_files.h"

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <system_error>

#include "base/errors.h"
#include "io/own_files.h"
#include "io/read_files.h"

namespace rotordrop {

namespace fs = std::filesystem;

void require_new(const fs::path& file, bool force, const char* option) {
  if (!force && fs::exists(file))
    throw InputError({file.string()}, "the file already exists.",
                     fmt::format("Choose another with {}, or replace it with --force.", option));
}

void require_own_or_new(const fs::path& file, const char* option) {
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(file, ignored))) return;
  const bool is_own = file.extension() == ".html"  ? is_own_page(file)
                      : file.extension() == ".svg" ? is_own_diagram(file)
                                                   : is_own_results(file) || is_hollow(file);
  if (!is_own)
    throw InputError({file.string()}, "the program would replace this file, but did not write it.",
                     fmt::format("It is left as it is. Choose another name with {}.", option));
}

void require_other_file(const fs::path& output, const fs::path& input) {
  std::error_code ignored;
  if (fs::equivalent(output, input, ignored) || was_read(output))
    throw InputError({output.string()}, "this file is what the command reads; it is not replaced.",
                     "Choose another with -o FILE.");
}

void require_none_of_run(const fs::path& output, const fs::path& directory) {
  for (const char* name : {"results.h5", "summary.json", "parameters.toml"})
    require_other_file(output, directory / name);
}

void require_page_or_nothing(const fs::path& file) {
  if (!fs::exists(file) || file.extension() == ".html" || file.extension() == ".htm") return;
  std::string first_line;
  if (fs::is_regular_file(file)) std::getline(std::ifstream(file), first_line);
  if (first_line != "<!DOCTYPE html>")
    throw InputError({file.string()}, "the file already exists, and it is no HTML page.",
                     "Choose another with -o FILE.");
}

}  // namespace rotordrop
