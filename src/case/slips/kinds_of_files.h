#pragma once
#include <filesystem>
#include <optional>

#include "base/node.h"

namespace rotordrop {

/// Files of parameters are of three kinds, each with commands of its own.
enum class FileKind { drop, study, heat };

/// By the tables that only one kind has. @param tree  with its bases
[[nodiscard]] std::optional<FileKind> kind_of_file(const Node& tree);

/// @throws InputError if the file is of another kind: what it is, and the command that takes it
void require_kind(const Node& tree, const std::filesystem::path& file, FileKind kind);

}  // namespace rotordrop
