#pragma once
#include <filesystem>
#include <string>

// Files that come with the program: found relative to it when it is installed, in build and source folder otherwise.
namespace rotordrop {

/// Where these files are for a process that is not the program itself, such as Python's. A folder that is empty is not looked into. Call it
/// before a case is read, from one thread.
struct ProgramFolders {
  std::filesystem::path params, modules;
};
void set_program_folders(const ProgramFolders& folders);

/// The cases and the bearing catalogue that come with the program.
std::filesystem::path params_folder();

/// A file that a user named, where one is needed. @throws InputError if it is not there while the program brings one of its name along: says where that is
void look_for_file(const std::filesystem::path& file);

/// A module that is loaded on demand: in the folder that ROTORDROP_MODULES names, in the one that was set, beside the program, or in ../lib/rotordrop as installed.
/// The path need not exist.
std::filesystem::path module_file(const std::string& name);

}  // namespace rotordrop
