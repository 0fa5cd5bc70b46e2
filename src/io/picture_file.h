#pragma once
#include <filesystem>
#include <string>

namespace rotordrop {

/// @throws InputError if a file of that name would hold no picture that write_picture() can write (.svg, .png)
void require_picture_name(const std::filesystem::path& file);

/// Writes a picture given as SVG: as it is into a file.svg, drawn by the command rsvg-convert, two pixels for each unit, into a file.png.
/// @throws InputError if that command is not installed; SolverError if the file cannot be written
void write_picture(const std::filesystem::path& file, const std::string& svg);

}  // namespace rotordrop
