#pragma once
#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "io/hdf5/hdf5_handle.h"
#include "io/hdf5/recorder.h"

namespace rotordrop {

/// Extendible dataset to whose end rows are added.
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
  ColumnMaker(hid_t file, std::size_t chunk_rows);
  /// @param time_path  dataset of its times
  SeriesColumn make(const Channel& channel, const std::string& time_path);

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

}  // namespace rotordrop
