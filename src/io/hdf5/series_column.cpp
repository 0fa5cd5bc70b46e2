#include "io/hdf5/series_column.h"

#include <limits>

#include "base/errors.h"

namespace rotordrop {

using hdf5::Handle;

namespace {

Handle chunked_list(std::size_t chunk_rows, std::size_t size, int rank) {
  Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "make property list");
  const hsize_t chunk[2] = {chunk_rows, size};
  hdf5::require(H5Pset_chunk(list.id(), rank, chunk), "set chunk size");
  // Rows that were never written must not look like zeros.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  hdf5::require(H5Pset_fill_value(list.id(), H5T_NATIVE_DOUBLE, &nan), "set fill value");
  return list;
}

}  // namespace

ColumnMaker::ColumnMaker(hid_t file, std::size_t chunk_rows)
    : file_(file), chunk_rows_(chunk_rows), links_(hdf5::with_missing_groups()) {}

hid_t ColumnMaker::chunked(const SeriesColumn& column) {
  auto found = chunked_.find(column.size);
  if (found == chunked_.end())
    found = chunked_.emplace(column.size, chunked_list(chunk_rows_, column.size, column.rank())).first;
  return found->second.id();
}

SeriesColumn ColumnMaker::make(const Channel& channel, const std::string& time_path,
                               std::optional<std::size_t> n_rows) {
  SeriesColumn column;
  column.path = channel.path;
  column.size = channel.size;
  column.is_flat = channel.size == 1;
  const hsize_t now[2] = {n_rows.value_or(0), channel.size};
  const hsize_t at_most[2] = {n_rows ? *n_rows : H5S_UNLIMITED, channel.size};
  const Handle space(H5Screate_simple(column.rank(), now, at_most), H5Sclose, "make data space");
  const hid_t how = n_rows ? H5P_DEFAULT : chunked(column);
  column.dataset =
      Handle(H5Dcreate2(file_, channel.path.c_str(), H5T_IEEE_F64LE, space.id(), links_.id(), how, H5P_DEFAULT),
             H5Dclose, "cannot make dataset " + channel.path);
  attributes_.write(column.dataset.id(), "units", channel.unit);
  attributes_.write(column.dataset.id(), "long_name", channel.long_name);
  if (channel.path != time_path) attributes_.write(column.dataset.id(), "time", time_path);
  if (!channel.columns.empty()) hdf5::write_attribute(column.dataset.id(), "columns", channel.columns);
  return column;
}

void write_rows(const SeriesColumn& column, std::size_t from, std::span<const double> values) {
  const std::string what = "dataset " + column.path;
  const std::size_t n = values.size() / column.size;
  const hsize_t extent[2] = {from + n, column.size};
  hdf5::require(H5Dset_extent(column.dataset.id(), extent), what);
  const Handle in_file(H5Screate_simple(column.rank(), extent, nullptr), H5Sclose, what);
  const hsize_t start[2] = {from, 0};
  const hsize_t count[2] = {n, column.size};
  hdf5::require(H5Sselect_hyperslab(in_file.id(), H5S_SELECT_SET, start, nullptr, count, nullptr), what);
  const Handle in_memory(H5Screate_simple(column.rank(), count, nullptr), H5Sclose, what);
  hdf5::require(
      H5Dwrite(column.dataset.id(), H5T_NATIVE_DOUBLE, in_memory.id(), in_file.id(), H5P_DEFAULT, values.data()), what);
}

void write_all_rows(SeriesColumn column, std::span<const double> values) {
  if (H5Dwrite(column.dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0 &&
      column.dataset.reset())
    return;
  column.dataset.leak();  // as all of a file after a failed write: see Recorder's abandon()
  throw SolverError("dataset " + column.path + ": " + hdf5::last_error());
}

}  // namespace rotordrop
