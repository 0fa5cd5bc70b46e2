#pragma once
// What is read of result files.

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/errors.h"

namespace rotordrop {

/// A file that holds less than it should, or something else: cut off, overwritten, not synchronised before a power cut.
class DamagedFile : public InputError {
 public:
  using InputError::InputError;
};

/// Numbers of one dataset, row after row.
struct Series {
  std::vector<double> values;
  std::vector<std::size_t> shape;  ///< [n_rows] or [n_rows, n]
};

/// What a dataset says about itself; empty where it says nothing.
struct SeriesMeaning {
  std::string unit, long_name;
  std::string time_path;  ///< dataset of its times
  std::vector<std::string> columns;
};

/// Readers; they work on finished, live and abandoned files alike. In a live file a channel may have a few rows more than its times.
/// @throws InputError if there is no such file, dataset or attribute, or it is of another kind
[[nodiscard]] Series read_series(const std::filesystem::path& path, const std::string& dataset);
[[nodiscard]] std::string read_text(const std::filesystem::path& path, const std::string& dataset);
/// @param object  "/" for the file's own attributes, else a dataset or group
[[nodiscard]] std::string read_attribute(const std::filesystem::path& path, const std::string& object,
                                         const std::string& name);
/// As read_attribute, for lists such as `columns`.
[[nodiscard]] std::vector<std::string> read_attribute_list(const std::filesystem::path& path, const std::string& object,
                                                           const std::string& name);
/// Numbers and what they mean, in one look at the file.
[[nodiscard]] std::pair<Series, SeriesMeaning> read_series_with_meaning(const std::filesystem::path& path,
                                                                        const std::string& dataset);
[[nodiscard]] SeriesMeaning read_meaning(const std::filesystem::path& path, const std::string& dataset);
/// Paths of all datasets, in alphabetical order.
[[nodiscard]] std::vector<std::string> list_datasets(const std::filesystem::path& path);

}  // namespace rotordrop
