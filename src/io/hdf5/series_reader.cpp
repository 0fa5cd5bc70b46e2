#include "io/hdf5/series_reader.h"

#include <algorithm>

#include "base/errors.h"
#include "io/hdf5/recorded_series.h"

namespace rotordrop::hdf5 {

namespace fs = std::filesystem;

void throw_unreadable(const fs::path& path, const std::string& what) { throw InputError({path.string()}, what); }

void throw_damaged(const fs::path& path, const std::string& what) { throw DamagedFile({path.string()}, what); }

bool has_object(hid_t file, const std::string& path) {
  if (path == "/") return true;
  // Every group on the way must exist before its content may be asked for.
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const std::string part = path.substr(0, end);
    const htri_t exists = H5Lexists(file, part.c_str(), H5P_DEFAULT);
    H5L_info_t link{};
    if (exists < 0 || (exists > 0 && H5Lget_info(file, part.c_str(), &link, H5P_DEFAULT) < 0))
      throw DamagedFile({name_of(file)}, "this file is damaged (" + last_error() + ").");
    if (exists == 0 || link.type != H5L_TYPE_HARD) return false;
    if (end == std::string::npos) return true;
  }
}

namespace {

using Extents = std::vector<std::size_t>;

double product(const Extents& extents) {
  double product = 1.;
  for (const std::size_t n : extents) product *= static_cast<double>(n);
  return product;
}

/// Of the pieces in which a dataset lies in its file; the whole of it if it is in one. No extent is 0.
Extents chunk_extents(hid_t dataset, const Extents& shape) {
  Extents extents(shape.size());
  const Handle list(H5Dget_create_plist(dataset), H5Pclose, "chunks");
  std::vector<hsize_t> chunk(shape.begin(), shape.end());
  if (H5Pget_layout(list.id()) == H5D_CHUNKED)
    require(H5Pget_chunk(list.id(), static_cast<int>(chunk.size()), chunk.data()), "chunks");
  std::transform(chunk.begin(), chunk.end(), extents.begin(),
                 [](hsize_t n) { return std::max(static_cast<std::size_t>(n), std::size_t{1}); });
  return extents;
}

}  // namespace

SeriesReader::SeriesReader(hid_t file, const fs::path& file_path, const std::string& dataset)
    : file_path_(file_path), name_(dataset) {
  if (!has_object(file, dataset)) throw_unreadable(file_path, "there is no dataset " + dataset + " in this file.");
  const hid_t id = H5Dopen2(file, dataset.c_str(), H5P_DEFAULT);
  if (id < 0) throw_unreadable(file_path, dataset + " cannot be read as a dataset (" + last_error() + ").");
  dataset_ = Handle(id, H5Dclose, dataset);
  const Handle type(H5Dget_type(id), H5Tclose, dataset);
  const H5T_class_t kind = H5Tget_class(type.id());
  const auto dimensions = extents(id, dataset);
  if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || dimensions.empty())
    throw_unreadable(file_path, dataset + " does not hold a series of numbers.");
  shape_.assign(dimensions.begin(), dimensions.end());
  chunk_ = chunk_extents(id, shape_);
  // Compressed numbers of other programs take less room than they have in memory; rows that are not written yet take none. HDF5 needs half a
  // kilobyte for each chunk that it is asked for, whether there is one or not.
  constexpr double largest_compression = 1100., not_written = 1024. * 1024. * 1024., chunks_not_written = 1e5;
  const double bytes = sizeof(double) * product(shape_), chunk_bytes = sizeof(double) * product(chunk_);
  const double n_chunks = bytes / chunk_bytes;
  if (const double held = largest_compression * static_cast<double>(H5Dget_storage_size(id));
      std::max(bytes, chunk_bytes) > held + not_written || n_chunks > held / chunk_bytes + chunks_not_written)
    throw_damaged(file_path, "this file is damaged (" + dataset + " tells of more numbers than it can hold).");
}

std::size_t SeriesReader::row_size() const {
  std::size_t size = 1;
  for (std::size_t i = 1; i < shape_.size(); ++i) size *= shape_[i];
  return size;
}

std::vector<double> SeriesReader::rows(std::size_t from, std::size_t n) const {
  std::vector<double> values(n * row_size());
  if (values.empty()) return values;
  // Many chunks at once would take more memory than what they hold.
  constexpr std::size_t chunks_at_once = 1024;
  const std::size_t block = chunk_.front() * chunks_at_once;
  for (std::size_t done = 0; done < n; done += block)
    read_block(from + done, std::min(block, n - done), values.data() + done * row_size());
  return values;
}

void SeriesReader::read_block(std::size_t from, std::size_t n, double* values) const {
  std::vector<hsize_t> start(shape_.size(), 0);
  std::vector<hsize_t> count(shape_.begin(), shape_.end());
  start[0] = from;
  count[0] = n;
  const Handle in_file(H5Dget_space(dataset_.id()), H5Sclose, name_);
  require(H5Sselect_hyperslab(in_file.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), name_);
  const Handle in_memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose, name_);
  if (H5Dread(dataset_.id(), H5T_NATIVE_DOUBLE, in_memory.id(), in_file.id(), H5P_DEFAULT, values) < 0)
    throw_damaged(file_path_, "the values of " + name_ + " cannot be read (" + last_error() + ").");
}

std::vector<std::string> attribute_texts(hid_t object, const fs::path& path, const std::string& owner,
                                         const std::string& name) {
  if (H5Aexists(object, name.c_str()) <= 0) throw_unreadable(path, owner + " has no attribute \"" + name + "\".");
  try {
    const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "attribute " + name);
    return read_attribute_texts(attribute.id(), "attribute " + name);
  } catch (const SolverError& error) {
    throw_damaged(path, "this file is damaged (" + owner + ": " + error.what() + ").");
  }
}

}  // namespace rotordrop::hdf5
