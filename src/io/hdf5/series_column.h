#pragma once
#include <cstddef>
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

/// Makes the dataset of a channel, with its attributes. @param time_path  dataset of its times
SeriesColumn make_column(hid_t file, const Channel& channel, const std::string& time_path, std::size_t chunk_rows);

/// Writes rows behind the first `from`. @param values [n, size]
void write_rows(const SeriesColumn& column, std::size_t from, std::span<const double> values);

}  // namespace rotordrop
