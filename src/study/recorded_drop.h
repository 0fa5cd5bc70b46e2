#pragma once
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/memory_series.h"
#include "case/case.h"
#include "io/file_identity.h"
#include "io/hdf5/recorded_series.h"
#include "study/time_series.h"

namespace rotordrop {

/// A finished drop: parameters, and series as they are asked for, from its directory or from memory.
class RecordedDrop {
 public:
  /// Reads DIR/parameters.toml and opens DIR/results.h5. @throws InputError
  explicit RecordedDrop(const std::filesystem::path& directory);
  /// With the case at hand. @throws InputError
  RecordedDrop(const std::filesystem::path& directory, const Case& drop_case);
  /// Without a look at files. @param directory  what the drop is called in reports; may be empty
  RecordedDrop(const Case& drop_case, MemorySeries series, std::filesystem::path directory = {});

  [[nodiscard]] const std::filesystem::path& directory() const { return directory_; }
  [[nodiscard]] const CaseParameters& parameters() const { return parameters_; }
  [[nodiscard]] const std::string& case_name() const { return case_name_; }
  /// As of driver_of(): whose growth the drop felt.
  [[nodiscard]] std::string driver() const;
  /// Touchdown bearings with their parameters.
  [[nodiscard]] std::vector<std::pair<std::string, TouchdownParameters>> bearings() const;

  [[nodiscard]] bool has(const std::string& dataset) const;
  [[nodiscard]] bool has(const ThermalKind& model) const;
  /// Thermal models with temperatures of a touchdown bearing, in the order of thermal_kinds().
  [[nodiscard]] std::vector<const ThermalKind*> models() const;
  /// Paths of all datasets of numbers, in alphabetical order.
  [[nodiscard]] const std::vector<std::string>& datasets() const { return datasets_; }
  /// What the drop's file tells in words: "/parameters", "/given", "/inputs"; none: it does not, or the drop is in memory.
  [[nodiscard]] std::optional<std::string> text(const std::string& dataset) const;
  /// A dataset as it is, numbers that are none included.
  struct Table {
    std::vector<double> values;  ///< row after row
    std::size_t n_columns = 1;
    SeriesMeaning meaning;
  };
  [[nodiscard]] const Table& table(const std::string& dataset) const;
  /// Unit, meaning and columns of a dataset, from memory or from its file.
  [[nodiscard]] SeriesMeaning meaning(const std::string& dataset) const;
  /// One column of a dataset. @throws InputError if it is not there, has no rows, or a value that is no number
  [[nodiscard]] TimeSeries series(const std::string& dataset, std::size_t column = 0) const;

  /// Growth of one of growth_surfaces, from a dataset with one column for each; zero for a surface that results of an earlier version lack.
  [[nodiscard]] TimeSeries growth(const std::string& dataset, std::size_t surface) const;

  // Paths of a model's series, as the coupling of the finite elements makes them.
  /// Volume mean of a body or temperature of a node, "inner_ring", "ball"; of a model that meshes sections also a surface, "bore", with columns mean, lowest, highest.
  [[nodiscard]] std::string node_path(const ThermalKind& model, const std::string& bearing,
                                      const std::string& node) const;
  /// Columns in the order of growth_surfaces.
  [[nodiscard]] std::string growth_path(const ThermalKind& model, const std::string& bearing) const;
  /// Series of a bearing in pascal whose names speak of pressure.
  [[nodiscard]] std::vector<std::string> pressure_paths(const std::string& bearing) const;

 private:
  void open();
  /// What read(file, dataset) gives. @throws InputError if another file has taken the place of the one that was opened
  template <class Read>
  auto from_same_file(const Read& read, const std::string& dataset) const;
  [[nodiscard]] std::optional<Table> table_in_memory(const std::string& dataset) const;
  std::filesystem::path directory_, file_;
  std::optional<FileIdentity> identity_;  ///< of the file
  CaseParameters parameters_;
  std::string case_name_;
  std::vector<std::string> datasets_, texts_;  ///< sorted
  bool is_windowed_ = false;
  std::deque<MemorySeries::Group> memory_;       ///< of a drop in memory
  mutable std::map<std::string, Table> tables_;  ///< asked for so far
};

}  // namespace rotordrop
