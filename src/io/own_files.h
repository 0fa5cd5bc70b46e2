#pragma once
#include <filesystem>
#include <string>

namespace rotordrop {

/// Whether a result file (.h5, .json, .journal, .csv) is the program's by what stands in it: someone else's may have that name, too. A link is not.
bool is_own_results(const std::filesystem::path& file);

/// What the study is called whose journal lies in a directory; empty if that cannot be read.
std::string name_of_study(const std::filesystem::path& directory);

/// Whether a file holds nothing: no byte, or zeros at its beginning, as after a power cut.
bool is_hollow(const std::filesystem::path& file);

/// Whether a page is the program's.
bool is_own_page(const std::filesystem::path& file);
/// Writes a page, in the place of one of the program's. @throws InputError if something else is there
void write_page(const std::filesystem::path& file, const std::string& page);

/// Whether a picture is a Campbell diagram of the program.
bool is_own_diagram(const std::filesystem::path& file);

/// Whether parameters.toml is what a run writes first of all, and not a case by that name: every value of it has its origin behind it.
bool is_written_parameters(const std::filesystem::path& file);

}  // namespace rotordrop
