#pragma once
// What recorder.cpp and checkpoint.cpp share about the HDF5 C API. Include it in .cpp files only: hdf5.h stays inside this room.

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <hdf5.h>

namespace rotordrop::hdf5 {

/// Owns one HDF5 identifier and closes it with the function that belongs to its kind.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Handle() = default;
  /// @throws SolverError "WHAT: reason" if `id` says that the call which made it failed
  Handle(hid_t id, Close close, std::string_view what);
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { reset(); }

  [[nodiscard]] hid_t id() const { return id_; }
  [[nodiscard]] bool is_open() const { return id_ >= 0; }
  /// Closes now; false if HDF5 could not (a file that cannot be written, for example).
  bool reset() noexcept;
  /// Forgets the object without closing it.
  void leak() noexcept { id_ = -1; }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// Stops HDF5 from printing its errors, in the calling thread, and from closing files at the program's end: after a failed write
/// that crashes (1.10.8). Every public function of the room that uses HDF5 calls it first.
void be_quiet();

/// Why the last call failed, in words: the system's reason if there is one, else HDF5's innermost sentence.
[[nodiscard]] std::string last_error();

/// @throws SolverError "WHAT: reason" if `status` is negative
void require(herr_t status, std::string_view what);

/// Opens for reading: also a file that a run is writing (SWMR), or that a killed run left behind.
/// @throws InputError if there is no such file or it cannot be read as HDF5; DamagedFile if HDF5 would crash on it
[[nodiscard]] Handle open_for_reading(const std::filesystem::path& path);
/// The same without require_readable().
[[nodiscard]] Handle open_without_trial(const std::filesystem::path& path);

/// Attaches texts to many files, groups or datasets: their type and extent are made once, which takes a fifth of HDF5's time for one.
class TextAttributes {
 public:
  TextAttributes();
  void write(hid_t object, const std::string& name, const std::string& text) const;

 private:
  Handle type_, scalar_;
};
/// Attaches text to a file, group or dataset.
void write_attribute(hid_t object, const std::string& name, const std::string& text);
void write_attribute(hid_t object, const std::string& name, const std::vector<std::string>& texts);

/// Writes a scalar text dataset; groups on the way to `path` are made.
void write_text(hid_t file, const std::string& path, const std::string& text);
/// Writes a list of texts [n].
void write_texts(hid_t file, const std::string& path, const std::vector<std::string>& texts);
/// Writes numbers [n].
void write_numbers(hid_t file, const std::string& path, const std::vector<double>& numbers);

/// Texts of a dataset or attribute of strings, of any rank, fixed or variable length.
[[nodiscard]] std::vector<std::string> read_texts(hid_t dataset, std::string_view what);
[[nodiscard]] std::vector<std::string> read_attribute_texts(hid_t attribute, std::string_view what);

/// Absolute paths of all datasets, in alphabetical order.
[[nodiscard]] std::vector<std::string> dataset_paths(hid_t file);

/// Name of an open file.
[[nodiscard]] std::string name_of(hid_t file);

/// Extents of a dataset.
[[nodiscard]] std::vector<hsize_t> extents(hid_t dataset, std::string_view what);

/// Property list that makes the groups on the way to a new object.
[[nodiscard]] Handle with_missing_groups();

}  // namespace rotordrop::hdf5
