#pragma once
#include <filesystem>
#include <string>

// Files that come with the program: found relative to it when it is installed, in build and source folder otherwise.
namespace rotordrop {

/// The cases and the bearing catalogue that come with the program.
std::filesystem::path params_folder();

/// A module that is loaded on demand: in the folder that ROTORDROP_MODULES names, beside the program, or in ../lib/rotordrop as installed.
/// The path need not exist.
std::filesystem::path module_file(const std::string& name);

}  // namespace rotordrop
