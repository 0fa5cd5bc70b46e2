#pragma once
#include <filesystem>

#include "base/node.h"

// Supports and thermal models of others, in shared objects (machine/parts_module.h). What is loaded stays loaded, for this and all later cases.
namespace rotordrop {

/// Loads a module, once. @throws InputError at `where` if the file is missing, is no module, belongs to another version, its parts' names are taken, or it
/// changed since it was loaded
void load_parts_module(const std::filesystem::path& file, const SourcePosition& where);

/// Loads what the environment variable ROTORDROP_PARTS names, files with : between them. @throws InputError likewise
void load_parts_of_environment();

/// Loads what a case names in run.parts, and puts the files' full paths there. A name without a folder is that of a file beside the one that names it, or
/// in the folder of the program's own modules. @throws InputError likewise
/// @param working_folder  of those that no file names; empty: that of the process
void load_parts_of_case(Node& tree, const std::filesystem::path& working_folder);

}  // namespace rotordrop
