#pragma once
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "io/hdf5/hdf5_handle.h"
#include "io/hdf5/recorder.h"

namespace rotordrop {

/// Dataset to whose end rows are added, or which has all of them from the start.
struct SeriesColumn {
  hdf5::Handle dataset;
  std::string path;
  std::size_t size = 1;  ///< values per row
  bool is_flat = true;   ///< [time], not [time, size]

  [[nodiscard]] int rank() const { return is_flat ? 1 : 2; }
};

/// Makes datasets of channels, with their attributes. Lists of properties are made once: they take a good part of HDF5's time for a dataset.
class ColumnMaker {
 public:
  /// Of series that go on. @param chunk_rows  rows that lie together in the file
  ColumnMaker(hid_t file, std::size_t chunk_rows);
  /// @param time_path  dataset of its times
  /// @param n_rows     of a series that does not go on: it lies in the file in one piece, which takes HDF5 half the time
  SeriesColumn make(const Channel& channel, const std::string& time_path, std::optional<std::size_t> n_rows = {});

 private:
  [[nodiscard]] hid_t chunked(const SeriesColumn& column);
  hid_t file_;
  std::size_t chunk_rows_;
  hdf5::Handle links_;
  hdf5::TextAttributes attributes_;
  std::map<std::size_t, hdf5::Handle> chunked_;  // by size
};

/// Writes rows behind the first `from`. @param values [n, size]
void write_rows(const SeriesColumn& column, std::size_t from, std::span<const double> values);
/// Writes all rows of a series that does not go on, and closes its dataset. @param values [n_rows, size]
void write_all_rows(SeriesColumn column, std::span<const double> values);

}  // namespace rotordrop
