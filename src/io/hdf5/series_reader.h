#pragma once
// Private to io: one dataset of numbers in an open HDF5 file.

#include <filesystem>
#include <string>
#include <vector>

#include "io/hdf5/hdf5_handle.h"

namespace rotordrop::hdf5 {

/// @throws InputError
[[noreturn]] void throw_unreadable(const std::filesystem::path& path, const std::string& what);
/// @throws DamagedFile
[[noreturn]] void throw_damaged(const std::filesystem::path& path, const std::string& what);

/// Whether there is an object by this path, in this file: links to elsewhere are not followed. @throws DamagedFile
bool has_object(hid_t file, const std::string& path);

/// Texts of an attribute. @throws InputError if the object has none of that name
std::vector<std::string> attribute_texts(hid_t object, const std::filesystem::path& path, const std::string& owner,
                                         const std::string& name);

/// One dataset of numbers in an open file. @throws InputError if there is none of that name
class SeriesReader {
 public:
  SeriesReader(hid_t file, const std::filesystem::path& file_path, const std::string& dataset);

  [[nodiscard]] hid_t id() const { return dataset_.id(); }
  [[nodiscard]] const std::vector<std::size_t>& shape() const { return shape_; }
  [[nodiscard]] std::size_t n_rows() const { return shape_.front(); }
  [[nodiscard]] std::size_t row_size() const;
  /// Rows [from, from + n). @throws DamagedFile
  [[nodiscard]] std::vector<double> rows(std::size_t from, std::size_t n) const;

 private:
  void read_block(std::size_t from, std::size_t n, double* values) const;

  std::filesystem::path file_path_;
  std::string name_;
  Handle dataset_;
  std::vector<std::size_t> shape_, chunk_;
};

}  // namespace rotordrop::hdf5
