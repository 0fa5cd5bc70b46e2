#include "case/slips/kinds_of_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "base/errors.h"

namespace rotordrop {
namespace {

struct KindWords {
  const char *name, *command;
};
KindWords words_of(FileKind kind) {
  switch (kind) {
    case FileKind::study:
      return {"a study", "study"};
    case FileKind::heat:
      return {"a case of heat conduction alone", "heat"};
    case FileKind::drop:
      break;
  }
  return {"the case of a drop", "run"};
}

}  // namespace

std::optional<FileKind> kind_of_file(const Node& tree) {
  const auto has_any = [&](std::initializer_list<const char*> keys) {
    return std::any_of(keys.begin(), keys.end(), [&](const char* key) { return tree.has(key); });
  };
  if (has_any({"rotor"})) return FileKind::drop;
  if (has_any({"section", "output_times"})) return FileKind::heat;
  if (has_any({"bearings"})) return FileKind::drop;
  if (has_any({"vary", "case", "minimise", "fit"})) return FileKind::study;
  return std::nullopt;
}

void require_kind(const Node& tree, const std::filesystem::path& file, FileKind kind) {
  if (tree.has("ball_diameter") && tree.has("pitch_diameter"))
    throw InputError(
        {file.string(), 0, 0}, "this is a bearing of the catalogue, not a case.",
        fmt::format("Name it in the case: [bearings.NAME] with catalogue = \"{}\". A folder named bearings "
                    "beside the case is looked into, too.",
                    file.stem().string()));
  const auto found = kind_of_file(tree);
  if (!found || *found == kind) return;
  const std::string meant = kind == FileKind::study && found == FileKind::drop
                                ? ", or name it in a study by case = \"" + file.filename().string() + "\""
                                : "";
  throw InputError({file.string(), 0, 0},
                   fmt::format("this is {}, not {}.", words_of(*found).name, words_of(kind).name),
                   fmt::format("Its command: rotordrop {} {}{}", words_of(*found).command, file.string(), meant));
}

}  // namespace rotordrop
