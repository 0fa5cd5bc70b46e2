#include "io/hdf5/column_file.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <system_error>

#include "base/errors.h"
#include "io/checkpoint.h"
#include "io/hdf5/hdf5_handle.h"

namespace rotordrop {
namespace {

using namespace hdf5;

/// Objects without times: the same content is the same file.
Handle without_times(hid_t kind) {
  Handle list(H5Pcreate(kind), H5Pclose, "make property list");
  require(H5Pset_obj_track_times(list.id(), false), "make property list");
  return list;
}

void make_groups(hid_t file, const std::string& path) {
  for (auto end = path.find('/', 1); end != std::string::npos; end = path.find('/', end + 1)) {
    const std::string group = path.substr(0, end);
    if (H5Lexists(file, group.c_str(), H5P_DEFAULT) > 0) continue;
    const Handle made(H5Gcreate2(file, group.c_str(), H5P_DEFAULT, without_times(H5P_GROUP_CREATE).id(), H5P_DEFAULT),
                      H5Gclose, "cannot make group " + group);
  }
}

/// How a dataset is stored: here, or in the files of a virtual one.
Handle layout_of(const TableColumn& column, hid_t space, int rank) {
  Handle list = without_times(H5P_DATASET_CREATE);
  if (column.sources.empty()) return list;
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  require(H5Pset_fill_value(list.id(), H5T_NATIVE_DOUBLE, &nothing), "make property list");
  for (const auto& source : column.sources) {
    if (source.n_rows == 0) continue;
    const hsize_t extent[2] = {source.n_rows, column.width}, start[2] = {source.first, 0},
                  stride[2] = {source.stride, 1};
    const Handle theirs(H5Screate_simple(rank, extent, nullptr), H5Sclose, "make data space");
    const Handle ours(H5Scopy(space), H5Sclose, "make data space");
    require(H5Sselect_hyperslab(ours.id(), H5S_SELECT_SET, start, stride, extent, nullptr), "make data space");
    require(H5Pset_virtual(list.id(), ours.id(), source.file.c_str(), column.path.c_str(), theirs.id()),
            "make the virtual dataset " + column.path);
  }
  return list;
}

void write_column(hid_t file, const TableColumn& column, const TextAttributes& attributes) {
  make_groups(file, column.path);
  using Kind = TableColumn::Kind;
  hsize_t extent[2] = {column.numbers.size() / column.width, column.width};
  if (column.kind == Kind::integers) extent[0] = column.integers.size();
  if (column.kind == Kind::texts) extent[0] = column.texts.size();
  const int rank = column.kind == Kind::numbers && column.width > 1 ? 2 : 1;
  const Handle space(H5Screate_simple(rank, extent, nullptr), H5Sclose, "make data space");
  Handle text(H5Tcopy(H5T_C_S1), H5Tclose, "make text type");
  std::size_t slot = 1;
  for (const auto& t : column.texts) slot = std::max(slot, t.size());
  require(H5Tset_size(text.id(), slot), "make text type");
  require(H5Tset_strpad(text.id(), H5T_STR_NULLPAD), "make text type");
  require(H5Tset_cset(text.id(), H5T_CSET_UTF8), "make text type");
  const hid_t type = column.kind == Kind::numbers    ? H5T_IEEE_F64LE
                     : column.kind == Kind::integers ? H5T_STD_I32LE
                                                     : text.id();
  const Handle dataset(H5Dcreate2(file, column.path.c_str(), type, space.id(), H5P_DEFAULT,
                                  layout_of(column, space.id(), rank).id(), H5P_DEFAULT),
                       H5Dclose, "cannot make dataset " + column.path);
  herr_t status = 0;
  if (extent[0] > 0 && column.sources.empty()) {
    if (column.kind == Kind::numbers) {
      status = H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.numbers.data());
    } else if (column.kind == Kind::integers) {
      status = H5Dwrite(dataset.id(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.integers.data());
    } else {
      std::string slots(slot * column.texts.size(), '\0');
      for (std::size_t i = 0; i < column.texts.size(); ++i)
        std::copy(column.texts[i].begin(), column.texts[i].end(),
                  slots.begin() + static_cast<std::ptrdiff_t>(i * slot));
      status = H5Dwrite(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, slots.data());
    }
  }
  require(status, "cannot write " + column.path);
  if (!column.unit.empty()) attributes.write(dataset.id(), "units", column.unit);
  if (!column.long_name.empty()) attributes.write(dataset.id(), "long_name", column.long_name);
}

}  // namespace

void write_columns(const std::filesystem::path& path,
                   const std::vector<std::pair<std::string, std::string>>& attributes,
                   const std::vector<TableColumn>& columns) {
  be_quiet();
  const auto beside = path.string() + ".writing";
  {
    Handle file(H5Fcreate(beside.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
                "cannot make " + path.string());
    const TextAttributes writer;
    for (const auto& [name, text] : attributes) writer.write(file.id(), name, text);
    for (const auto& column : columns) write_column(file.id(), column, writer);
    if (!file.reset()) throw SolverError("cannot write " + path.string() + ": " + last_error());
  }
  std::error_code error;
  if (!is_on_disk(beside)) throw SolverError("cannot bring " + path.string() + " to the disk. Is it full?");
  std::filesystem::rename(beside, path, error);
  if (error) throw SolverError("cannot write " + path.string() + ": " + error.message());
}

}  // namespace rotordrop
