#include "io/hdf5/hdf5_handle.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "base/errors.h"
#include "io/hdf5/hdf5_driver.h"
#include "io/hdf5/trial_reading.h"

namespace rotordrop::hdf5 {

Handle::Handle(hid_t id, Close close, std::string_view what) : id_(id), close_(close) {
  if (id < 0) throw SolverError(std::string(what) + ": " + last_error());
}

Handle& Handle::operator=(Handle&& other) noexcept {
  if (this != &other) {
    reset();
    id_ = std::exchange(other.id_, -1);
    close_ = other.close_;
  }
  return *this;
}

bool Handle::reset() noexcept {
  if (id_ < 0) return true;
  return close_(std::exchange(id_, -1)) >= 0;
}

void be_quiet() {
  [[maybe_unused]] static const herr_t before_anything_else = H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

namespace {

herr_t keep_innermost(unsigned depth, const H5E_error2_t* error, void* text) {
  if (depth == 0 && error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
  return 0;
}

}  // namespace

std::string last_error() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &text);
  // Calls into the system report "..., errno = 28, error message = 'No space left on device', buf = ...".
  constexpr std::string_view mark = "error message = '";
  if (const auto begin = text.find(mark); begin != std::string::npos) {
    const auto from = begin + mark.size();
    return text.substr(from, text.find('\'', from) - from);
  }
  return text.empty() ? "HDF5 gives no reason" : text;
}

void require(herr_t status, std::string_view what) {
  if (status < 0) throw SolverError(std::string(what) + ": " + last_error());
}

Handle open_for_reading(const std::filesystem::path& path) {
  require_readable(path);
  return open_without_trial(path);
}

Handle open_without_trial(const std::filesystem::path& path) {
  be_quiet();
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) throw InputError({path.string()}, "there is no such file.");
  if (std::filesystem::is_directory(status))
    throw InputError({path.string()}, "this is a directory, not an HDF5 file.");
  if (!std::filesystem::is_regular_file(status))
    throw InputError({path.string()}, "this is a device or a pipe, not an HDF5 file.");
  // Of a file that is being written, a part may have to be read again: within 2^20 ns = 1 ms, for the pauses double. Without a limit
  // HDF5 tries 100 times, which on a damaged file takes for ever.
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make property list");
  require(H5Pset_metadata_read_attempts(access.id(), 20), "limit attempts to read");
  mend_while_reading(access.id(), path);
  hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, access.id());
  // Files in HDF5's older format (from other programs) cannot be opened that way.
  if (id < 0) id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) throw InputError({path.string()}, "this cannot be read as an HDF5 file (" + last_error() + ").");
  return Handle(id, H5Fclose, "open file");
}

namespace {

Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make text type");
  require(H5Tset_size(type.id(), H5T_VARIABLE), "make text type");
  require(H5Tset_cset(type.id(), H5T_CSET_UTF8), "make text type");
  return type;
}

std::vector<const char*> pointers(const std::vector<std::string>& texts) {
  std::vector<const char*> result;
  result.reserve(texts.size());
  for (const auto& text : texts) result.push_back(text.c_str());
  return result;
}

Handle one_dimension(std::size_t n) {
  const hsize_t extent = n;
  return Handle(H5Screate_simple(1, &extent, nullptr), H5Sclose, "make data space");
}

Handle new_dataset(hid_t file, const std::string& path, hid_t type, hid_t space) {
  return Handle(H5Dcreate2(file, path.c_str(), type, space, with_missing_groups().id(), H5P_DEFAULT, H5P_DEFAULT),
                H5Dclose, "cannot make dataset " + path);
}

/// `read(type, buffer)` fills the buffer: one char* per text, or fixed-size slots.
template <class Read>
std::vector<std::string> texts_of(Handle type, Handle space, std::string_view what, Read read) {
  if (H5Tget_class(type.id()) != H5T_STRING) throw SolverError(std::string(what) + " is not text.");
  constexpr std::size_t most = std::size_t{64} << 20u;  // bytes, as of any input
  const auto n = static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space.id())));
  const bool is_variable = H5Tis_variable_str(type.id()) > 0;
  const std::size_t slot = is_variable ? sizeof(char*) : H5Tget_size(type.id());
  if (slot == 0 || n > most / slot) throw SolverError(std::string(what) + " tells of more text than it can hold.");
  std::vector<std::string> texts;
  texts.reserve(n);
  if (n == 0) return texts;
  if (is_variable) {
    std::vector<char*> buffer(n, nullptr);
    require(read(type.id(), buffer.data()), what);
    for (const char* text : buffer) texts.emplace_back(text == nullptr ? "" : text);
    H5Dvlen_reclaim(type.id(), space.id(), H5P_DEFAULT, buffer.data());
  } else {
    std::string buffer(n * slot, '\0');
    require(read(type.id(), buffer.data()), what);
    for (std::size_t i = 0; i < n; ++i)
      texts.emplace_back(buffer.data() + i * slot, strnlen(buffer.data() + i * slot, slot));
  }
  return texts;
}

}  // namespace

TextAttributes::TextAttributes() : type_(text_type()), scalar_(H5Screate(H5S_SCALAR), H5Sclose, "make data space") {}

void TextAttributes::write(hid_t object, const std::string& name, const std::string& text) const {
  const Handle attribute(H5Acreate2(object, name.c_str(), type_.id(), scalar_.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "cannot make attribute " + name);
  const char* pointer = text.c_str();
  require(H5Awrite(attribute.id(), type_.id(), &pointer), "cannot write attribute " + name);
}

void write_attribute(hid_t object, const std::string& name, const std::string& text) {
  TextAttributes().write(object, name, text);
}

void write_attribute(hid_t object, const std::string& name, const std::vector<std::string>& texts) {
  const Handle type = text_type();
  const Handle space = one_dimension(texts.size());
  const Handle attribute(H5Acreate2(object, name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "cannot make attribute " + name);
  require(H5Awrite(attribute.id(), type.id(), pointers(texts).data()), "cannot write attribute " + name);
}

void write_text(hid_t file, const std::string& path, const std::string& text) {
  // Of fixed length, and ASCII where it can be: Octave stops reading a file at any other text.
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make text type");
  require(H5Tset_size(type.id(), text.size() + 1), "make text type");
  const bool is_ascii = std::all_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x80; });
  require(H5Tset_cset(type.id(), is_ascii ? H5T_CSET_ASCII : H5T_CSET_UTF8), "make text type");
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "make data space");
  const Handle dataset = new_dataset(file, path, type.id(), space.id());
  require(H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()), "cannot write " + path);
}

void write_texts(hid_t file, const std::string& path, const std::vector<std::string>& texts) {
  const Handle type = text_type();
  const Handle dataset = new_dataset(file, path, type.id(), one_dimension(texts.size()).id());
  if (texts.empty()) return;
  require(H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers(texts).data()),
          "cannot write " + path);
}

void write_numbers(hid_t file, const std::string& path, const std::vector<double>& numbers) {
  const Handle dataset = new_dataset(file, path, H5T_IEEE_F64LE, one_dimension(numbers.size()).id());
  if (numbers.empty()) return;
  require(H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()),
          "cannot write " + path);
}

std::vector<std::string> read_texts(hid_t dataset, std::string_view what) {
  return texts_of(Handle(H5Dget_type(dataset), H5Tclose, what), Handle(H5Dget_space(dataset), H5Sclose, what), what,
                  [&](hid_t type, void* to) { return H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, to); });
}

std::vector<std::string> read_attribute_texts(hid_t attribute, std::string_view what) {
  return texts_of(Handle(H5Aget_type(attribute), H5Tclose, what), Handle(H5Aget_space(attribute), H5Sclose, what), what,
                  [&](hid_t type, void* to) { return H5Aread(attribute, type, to); });
}

std::vector<std::string> dataset_paths(hid_t file) {
  std::vector<std::string> paths;
  const auto keep_datasets = [](hid_t, const char* name, const H5O_info_t* info, void* list) -> herr_t {
    if (info->type == H5O_TYPE_DATASET)
      static_cast<std::vector<std::string>*>(list)->push_back(std::string("/") + name);
    return 0;
  };
  require(H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, keep_datasets, &paths, H5O_INFO_BASIC),
          "cannot list the datasets");
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string name_of(hid_t file) {
  std::string name(4096, '\0');
  const ssize_t size = H5Fget_name(file, name.data(), name.size());
  name.resize(static_cast<std::size_t>(std::clamp<ssize_t>(size, 0, static_cast<ssize_t>(name.size()) - 1)));
  return name;
}

std::vector<hsize_t> extents(hid_t dataset, std::string_view what) {
  const Handle space(H5Dget_space(dataset), H5Sclose, what);
  const int rank = H5Sget_simple_extent_ndims(space.id());
  require(rank, what);
  std::vector<hsize_t> result(static_cast<std::size_t>(rank));
  require(H5Sget_simple_extent_dims(space.id(), result.data(), nullptr), what);
  return result;
}

Handle with_missing_groups() {
  Handle list(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "make property list");
  require(H5Pset_create_intermediate_group(list.id(), 1), "make property list");
  return list;
}

}  // namespace rotordrop::hdf5
