#include "io/checkpoint.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/errors.h"
#include "io/hdf5/hdf5_handle.h"
#include "io/sha256.h"

// A checkpoint is an HDF5 file (any HDF5 tool shows what is in it) followed by a line with a check sum of all bytes before it,
// which HDF5 ignores. It is verified before HDF5 sees the bytes: the library does not survive every damaged file.

namespace rotordrop {

namespace fs = std::filesystem;
using hdf5::Handle;

namespace {

class FileDescriptor {
 public:
  explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  [[nodiscard]] int get() const { return descriptor_; }
  [[nodiscard]] int release() { return std::exchange(descriptor_, -1); }

 private:
  int descriptor_;
};

[[noreturn]] void throw_not_allowed(const fs::path& path, int error) {
  throw InputError({path.string()}, "the file cannot be written: " + std::generic_category().message(error) + ".",
                   "Choose another place with -o, or change the permissions.");
}

[[noreturn]] void throw_not_written(const fs::path& path, int error) {
  // What the name or the place forbids is for the user to change; everything else is the machine's.
  constexpr std::array by_name{ENAMETOOLONG, ELOOP, EACCES, EPERM, EROFS, ENOTDIR, EISDIR, EINVAL};
  if (std::find(by_name.begin(), by_name.end(), error) != by_name.end()) throw_not_allowed(path, error);
  throw SolverError("cannot write " + path.string() + ": " + std::generic_category().message(error) + ".");
}

/// @param name  of the file for messages
void write_all(const fs::path& path, const fs::path& name, std::string_view bytes) {
  FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file.get() < 0) throw_not_written(name, errno);
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw_not_written(name, written < 0 ? errno : ENOSPC);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::fsync(file.get()) != 0 && errno != EINVAL) throw_not_written(name, errno);
  if (::close(file.release()) != 0) throw_not_written(name, errno);  // network file systems report a full disk here
}

void sync_directory(const fs::path& directory) {
  // Makes the new name itself survive a power cut. Not every file system can; then there is nothing better to do.
  const FileDescriptor opened(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.get() >= 0) ::fsync(opened.get());
}

/// A fixed name: what a killed writer left is overwritten by the next. Short enough for any name that the file itself may have.
fs::path name_while_writing(const fs::path& path) {
  return path.parent_path() / (path.filename().string().substr(0, 200) + ".writing");
}

/// Where nothing was before, a missing place is the user's, as in /proc.
[[noreturn]] void throw_not_made(const fs::path& path, int error) {
  if (error == ENOENT) throw_not_allowed(path, error);
  throw_not_written(path, error);
}

}  // namespace

void require_writable(const fs::path& path) {
  std::error_code error;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
  if (error) throw_not_made(path, error.value());
  struct ::stat unused {};
  if (::lstat(path.c_str(), &unused) != 0 && errno != ENOENT) throw_not_written(path, errno);
  const fs::path beside = name_while_writing(path);
  const FileDescriptor file(::open(beside.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
  if (file.get() < 0) throw_not_made(path, errno);
  ::unlink(beside.c_str());
}

void write_text_atomically(const fs::path& path, std::string_view text) {
  const fs::path beside = name_while_writing(path);
  try {
    write_all(beside, path, text);
    if (std::rename(beside.c_str(), path.c_str()) != 0) throw_not_written(path, errno);
  } catch (...) {
    ::unlink(beside.c_str());
    throw;
  }
  sync_directory(path.has_parent_path() ? path.parent_path() : fs::path("."));
}

bool is_on_disk(const fs::path& path) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  return file.get() >= 0 && (::fsync(file.get()) == 0 || errno == EINVAL);
}

namespace {

constexpr std::string_view check_sum_mark = "\nrotordrop check sum ";
constexpr std::size_t trailer_size = check_sum_mark.size() + check_sum_digits + 1;

Handle in_memory() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make property list");
  hdf5::require(H5Pset_fapl_core(access.id(), std::size_t{1} << 20, false), "keep file in memory");
  return access;
}

std::string file_image(const Checkpoint& checkpoint) {
  Handle file(H5Fcreate("checkpoint", H5F_ACC_TRUNC, H5P_DEFAULT, in_memory().id()), H5Fclose,
              "cannot make checkpoint");
  hdf5::write_attribute(file.id(), "format", "rotordrop checkpoint 1");
  hdf5::write_attribute(file.id(), "parameter_digest", checkpoint.parameter_digest);
  hdf5::write_numbers(file.id(), "/time", {checkpoint.time});
  hdf5::write_numbers(file.id(), "/state", checkpoint.state);
  hdf5::write_texts(file.id(), "/entry_names", checkpoint.entry_names);
  for (const auto& [name, values] : checkpoint.extras) hdf5::write_numbers(file.id(), "/extras/" + name, values);
  hdf5::require(H5Fflush(file.id(), H5F_SCOPE_GLOBAL), "cannot make checkpoint");
  const ssize_t size = H5Fget_file_image(file.id(), nullptr, 0);
  if (size <= 0) throw SolverError("cannot make checkpoint: " + hdf5::last_error());
  std::string image(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file.id(), image.data(), image.size()) != size)
    throw SolverError("cannot make checkpoint: " + hdf5::last_error());
  return image;
}

/// @param at_most  how many there can be
std::vector<double> numbers(hid_t file, const std::string& path, hsize_t at_most) {
  const Handle dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, path);
  std::vector<double> values;
  hsize_t size = 1;
  for (const hsize_t extent : hdf5::extents(dataset.id(), path)) {
    if (extent > at_most || size * extent > at_most) throw SolverError(path + " is larger than the file");
    size *= extent;
  }
  values.resize(size);
  if (size > 0)
    hdf5::require(H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path);
  return values;
}

Checkpoint from_image(std::string& image) {
  const Handle access = in_memory();
  hdf5::require(H5Pset_file_image(access.id(), image.data(), image.size()), "file image");
  const Handle file(H5Fopen("checkpoint", H5F_ACC_RDONLY, access.id()), H5Fclose, "open");
  const hsize_t at_most = image.size() / sizeof(double);
  Checkpoint checkpoint;
  checkpoint.time = numbers(file.id(), "/time", at_most).at(0);
  checkpoint.state = numbers(file.id(), "/state", at_most);
  {
    const Handle names(H5Dopen2(file.id(), "/entry_names", H5P_DEFAULT), H5Dclose, "/entry_names");
    checkpoint.entry_names = hdf5::read_texts(names.id(), "/entry_names");
    const Handle digest(H5Aopen(file.id(), "parameter_digest", H5P_DEFAULT), H5Aclose, "parameter_digest");
    checkpoint.parameter_digest = hdf5::read_attribute_texts(digest.id(), "parameter_digest").at(0);
  }
  if (checkpoint.state.size() != checkpoint.entry_names.size()) throw SolverError("names and values differ in number");
  const std::string folder = "/extras/";
  for (const auto& path : hdf5::dataset_paths(file.id()))
    if (path.starts_with(folder)) checkpoint.extras[path.substr(folder.size())] = numbers(file.id(), path, at_most);
  return checkpoint;
}

/// Number of "checkpoint-000123.h5", or nothing.
std::optional<std::uint64_t> number_of(const fs::path& path) {
  const std::string name = path.filename().string();
  constexpr std::string_view head = "checkpoint-";
  constexpr std::string_view tail = ".h5";
  if (!name.starts_with(head) || !name.ends_with(tail)) return std::nullopt;
  const std::string digits = name.substr(head.size(), name.size() - head.size() - tail.size());
  const bool is_number = !digits.empty() && digits.size() <= 18 &&
                         std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!is_number) return std::nullopt;
  return std::stoull(digits);
}

/// Newest first.
std::vector<std::pair<std::uint64_t, fs::path>> checkpoints_in(const fs::path& directory) {
  std::vector<std::pair<std::uint64_t, fs::path>> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(directory, ignored))
    if (const auto number = number_of(entry.path())) found.emplace_back(*number, entry.path());
  std::sort(found.rbegin(), found.rend());
  return found;
}

fs::path checkpoint_path(const fs::path& directory, std::uint64_t number) {
  std::string digits = std::to_string(number);
  if (digits.size() < 6) digits.insert(0, 6 - digits.size(), '0');
  return directory / ("checkpoint-" + digits + ".h5");
}

std::string named(const std::set<std::string>& names) {
  constexpr std::size_t at_most = 5;
  std::string text;
  std::size_t n = 0;
  for (const auto& name : names) {
    if (n == at_most) return text + " and " + std::to_string(names.size() - at_most) + " more";
    text += (n++ == 0 ? "\"" : ", \"") + name + "\"";
  }
  return text;
}

std::set<std::string> only_in_first(const std::vector<std::string>& first, const std::vector<std::string>& second) {
  const std::set<std::string> known(second.begin(), second.end());
  std::set<std::string> result;
  for (const auto& name : first)
    if (!known.contains(name)) result.insert(name);
  return result;
}

std::string difference(const std::vector<std::string>& stored, const std::vector<std::string>& present) {
  std::string text = "its state has " + std::to_string(stored.size()) + " entries, that of this case " +
                     std::to_string(present.size()) + ".";
  const auto only_stored = only_in_first(stored, present);
  const auto only_present = only_in_first(present, stored);
  if (!only_stored.empty()) text += "\nOnly in the checkpoint: " + named(only_stored) + ".";
  if (!only_present.empty()) text += "\nOnly in this case: " + named(only_present) + ".";
  if (only_stored.empty() && only_present.empty()) {
    const auto [a, b] = std::mismatch(stored.begin(), stored.end(), present.begin(), present.end());
    text += "\nThe order differs from entry " + std::to_string(a - stored.begin()) + " on: \"" +
            (a == stored.end() ? "(end)" : *a) + "\" in the checkpoint, \"" + (b == present.end() ? "(end)" : *b) +
            "\" in this case.";
  }
  return text;
}

}  // namespace

fs::path write_checkpoint(const fs::path& directory, const Checkpoint& checkpoint, std::size_t keep) {
  if (keep == 0) throw std::invalid_argument("write_checkpoint: keep is 0");
  if (checkpoint.state.size() != checkpoint.entry_names.size())
    throw std::invalid_argument("write_checkpoint: " + std::to_string(checkpoint.state.size()) + " states, " +
                                std::to_string(checkpoint.entry_names.size()) + " names");
  hdf5::be_quiet();
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) throw SolverError("cannot make the directory " + directory.string() + ": " + error.message() + ".");

  auto older = checkpoints_in(directory);
  const fs::path path = checkpoint_path(directory, older.empty() ? 1 : older.front().first + 1);
  std::string bytes = file_image(checkpoint);
  const std::string sum = check_sum(bytes);
  bytes.append(check_sum_mark).append(sum).append("\n");
  write_text_atomically(path, bytes);

  for (std::size_t i = keep - 1; i < older.size(); ++i) fs::remove(older[i].second, error);
  return path;
}

Checkpoint read_checkpoint(const fs::path& path) {
  hdf5::be_quiet();
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError({path.string()}, "there is no such checkpoint, or it cannot be opened.");
  std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const std::size_t size = bytes.size() < trailer_size ? 0 : bytes.size() - trailer_size;
  const std::string_view trailer = std::string_view(bytes).substr(size);
  if (!trailer.starts_with(check_sum_mark))
    throw InputError({path.string()}, "this is not a rotordrop checkpoint, or it is truncated.");
  if (trailer.substr(check_sum_mark.size(), check_sum_digits) != check_sum(std::string_view(bytes).substr(0, size)))
    throw InputError({path.string()}, "this checkpoint is damaged: its checksum does not match its content.");
  bytes.resize(size);
  try {
    return from_image(bytes);
  } catch (const std::exception& error) {
    throw InputError({path.string()},
                     std::string("this checkpoint was written by another version (") + error.what() + ").");
  }
}

void require_same_case(const fs::path& path, const Checkpoint& checkpoint, const std::string& parameter_digest,
                       const std::vector<std::string>& entry_names, const std::function<std::string()>& differs) {
  Faults faults;
  if (checkpoint.entry_names != entry_names)
    faults.add({path.string()},
               "this checkpoint belongs to another machine: " + difference(checkpoint.entry_names, entry_names));
  if (checkpoint.parameter_digest != parameter_digest) {
    const std::string differing = differs ? differs() : "";
    if (differing.empty())
      faults.add({path.string()},
                 "this checkpoint was written with other parameters (digest " + checkpoint.parameter_digest +
                     "; this case has " + parameter_digest + ").",
                 "Compare the parameters saved beside the results with those of this case, or start afresh. A mesh, a "
                 "recording or a module of parts that the case names must be what it was, too.");
    else
      faults.add({path.string()}, "this checkpoint was written with other parameters: " + differing + ".",
                 "Set them back and go on, or start afresh in another directory: a run ends with what it began with, "
                 "limits and title included.");
  }
  faults.throw_if_any();
}

bool holds_checkpoint(const fs::path& directory) { return !checkpoints_in(directory).empty(); }

FoundCheckpoint newest_valid_checkpoint(const fs::path& directory, const fs::path& older_than) {
  FoundCheckpoint found;
  const auto limit = number_of(older_than);
  for (const auto& [number, path] : checkpoints_in(directory)) {
    if (limit && number >= *limit) continue;
    try {
      found.checkpoint = read_checkpoint(path);
      found.path = path;
      return found;
    } catch (const InputError& error) {
      const auto& fault = error.faults().front();
      found.skipped.push_back(fault.where.file.text() + ": " + fault.message);
    }
  }
  return found;
}

}  // namespace rotordrop
