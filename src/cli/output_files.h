#pragma once
#include <filesystem>

namespace rotordrop {

/// A file that the user names is replaced with --force only. @throws InputError if it is there
/// @param option  that names another, for the message
void require_new(const std::filesystem::path& file, bool force, const char* option = "-o FILE");

/// By its usual name the program's own file is written again; someone else's is not. @throws InputError if it is there and someone else's
/// @param option  that names another, for the message
void require_own_or_new(const std::filesystem::path& file, const char* option = "-o FILE");

/// Not even --force writes over what a command reads. @throws InputError if both are one file
void require_other_file(const std::filesystem::path& output, const std::filesystem::path& input);

/// The same of the files that a run's directory is read from.
void require_none_of_run(const std::filesystem::path& output, const std::filesystem::path& directory);

/// What `--force` may replace by a report. @throws InputError if the file is there and is something else
void require_page_or_nothing(const std::filesystem::path& file);

}  // namespace rotordrop
