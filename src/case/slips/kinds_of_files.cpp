#include "case/slips/kinds_of_files.h"

#include <fmt/format.h>

#include "base/errors.h"

namespace rotordrop {
namespace {

std::string in_words(FileKind kind) {
  switch (kind) {
    case FileKind::study:
      return "a study";
    case FileKind::heat:
      return "a case of heat conduction alone";
    default:
      return "the case of a drop";
  }
}

std::string command_for(FileKind kind) {
  switch (kind) {
    case FileKind::study:
      return "study";
    case FileKind::heat:
      return "heat";
    default:
      return "run";
  }
}

}  // namespace

std::optional<FileKind> kind_of_file(const Node& tree) {
  for (const char* key : {"rotor", "bearings", "base"})
    if (tree.has(key)) return FileKind::drop;
  for (const char* key : {"vary", "case", "minimise", "fit"})
    if (tree.has(key)) return FileKind::study;
  if (tree.has("section") || tree.has("output_times")) return FileKind::heat;
  return std::nullopt;
}

void require_kind(const Node& tree, const std::filesystem::path& file, FileKind kind) {
  const auto found = kind_of_file(tree);
  if (!found || *found == kind) return;
  const std::string meant = kind == FileKind::study && found == FileKind::drop
                                ? ", or name it in a study by case = \"" + file.filename().string() + "\""
                                : "";
  throw InputError({file.string(), 0, 0}, fmt::format("this is {}, not {}.", in_words(*found), in_words(kind)),
                   fmt::format("Its command: rotordrop {} {}{}", command_for(*found), file.string(), meant));
}

}  // namespace rotordrop
