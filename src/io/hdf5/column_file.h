#pragma once
// Tables in HDF5: one dataset per column, written at once.

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace rotordrop {

/// One column of a table: numbers, integers or texts, of any length.
struct TableColumn {
  std::string path;             ///< "/results/bearings.TB1.peak_contact_force"
  std::string unit, long_name;  ///< attributes `units` and `long_name`; an empty one is left out
  std::vector<double> numbers = {};
  std::vector<std::int64_t> integers = {};
  std::vector<std::string> texts = {};  ///< in slots of fixed length, which MATLAB and Octave read
  std::size_t width = 1;                ///< of `numbers`: values per row
  enum class Kind { numbers, integers, texts } kind = Kind::numbers;

  /// Rows that another file holds under the same path: `n_rows` of them, which are the rows first, first + stride, ... here.
  struct Source {
    std::filesystem::path file;  ///< seen from the folder of this one
    std::size_t first = 0, stride = 1, n_rows = 0;
  };
  /// Of numbers: where there are any, `numbers` tell the number of rows alone, and the dataset is a virtual one. Rows of files that are not there are NaN.
  std::vector<Source> sources = {};
};

/// Writes an HDF5 file with these columns. The same input gives the same bytes. The file appears under its name complete, or not at all.
/// @param attributes  of the root
/// @throws SolverError if it cannot be written
void write_columns(const std::filesystem::path& file,
                   const std::vector<std::pair<std::string, std::string>>& attributes,
                   const std::vector<TableColumn>& columns);

}  // namespace rotordrop
