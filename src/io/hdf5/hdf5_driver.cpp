#include "io/hdf5/hdf5_driver.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/errors.h"
#include "io/hdf5/file_bytes.h"
#include "io/hdf5/guarded_write.h"

namespace rotordrop::hdf5 {

namespace {

// Superblock of version 3, as HDF5 1.10 writes it with offsets and lengths of 8 bytes (HDF5 File Format Specification 3.0, II.A).
constexpr std::size_t superblock_size = 48, flags_at = 11, end_of_file_at = 28, check_sum_at = 44;
constexpr std::array<unsigned char, 11> superblock_begin{0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n', 3, 8, 8};
using Superblock = std::array<unsigned char, superblock_size>;

/// Length of a file whose first `end` bytes are in use: half as much again, so that it seldom changes under a reader.
haddr_t length_ahead(haddr_t end) { return std::max(haddr_t{4} << 20, end + end / 2); }

struct File {
  H5FD_t pub{};  // first: HDF5 sees this part
  int descriptor = -1;
  haddr_t eoa = 0;        ///< what HDF5 has given out
  haddr_t eof = 0;        ///< size of the file
  haddr_t announced = 0;  ///< end of file in the superblock on disk
  dev_t device = 0;
  ino_t inode = 0;
  bool is_closing = false;
  bool has_superblock = false;
  Superblock superblock{};
  /// Bytes that follow on each other, not yet written: few long writes cost a third of many short ones. They go out before anything else is
  /// written, so that a reader finds the order that HDF5 gave.
  std::vector<unsigned char> pending;
  haddr_t pending_at = 0;
  bool pending_is_metadata = false;
  std::optional<TornBlock> torn;  ///< only of a file that is read
};
constexpr std::size_t most_pending = 256 << 10;

File& as_file(H5FD_t* file) { return *reinterpret_cast<File*>(file); }
const File& as_file(const H5FD_t* file) { return *reinterpret_cast<const File*>(file); }

/// For HDF5's error stack, where last_error() looks for it.
herr_t failed(const char* call) {
  H5Epush2(H5E_DEFAULT, __FILE__, call, __LINE__, H5E_ERR_CLS, H5E_IO, H5E_WRITEERROR,
           "%s failed: errno = %d, error message = '%s'", call, errno, std::strerror(errno));
  return -1;
}

/// Metadata has to be whole whenever the process is killed; rows are read only once metadata tells of them.
bool write_now(const File& file, haddr_t address, std::span<const unsigned char> bytes, bool is_metadata) {
  const haddr_t end_of_use = std::max(file.eoa, address + bytes.size());
  return is_metadata ? write_whole(file.descriptor, address, bytes, end_of_use, file.eof)
                     : write_bytes(file.descriptor, address, bytes);
}

bool write_pending(File& file) {
  const bool is_written = write_now(file, file.pending_at, file.pending, file.pending_is_metadata);
  file.pending.clear();
  return is_written;
}

bool write_later(File& file, haddr_t address, std::span<const unsigned char> bytes, bool is_metadata) {
  const bool follows = address == file.pending_at + file.pending.size();
  if (!(follows && file.pending.size() + bytes.size() <= most_pending) && !write_pending(file)) return false;
  if (bytes.size() > most_pending) return write_now(file, address, bytes, is_metadata);
  if (file.pending.empty()) {
    file.pending.reserve(most_pending);
    file.pending_at = address;
    file.pending_is_metadata = false;
  }
  file.pending.insert(file.pending.end(), bytes.begin(), bytes.end());
  file.pending_is_metadata = file.pending_is_metadata || is_metadata;
  return true;
}

/// The superblock as readers may see it.
bool write_superblock(File& file) {
  if (!write_pending(file)) return false;
  Superblock block = file.superblock;
  block[flags_at] = 0;
  if (!file.is_closing) put_number(block, end_of_file_at, file.announced, 8);
  put_number(block, check_sum_at, lookup3(std::span(block).first(check_sum_at)), 4);
  return write_bytes(file.descriptor, 0, block);
}

/// Makes the file, and what its superblock says of its length, long enough for `end`.
bool reach(File& file, haddr_t end) {
  if (end <= file.announced || file.is_closing) return true;
  // Where the file may not become that long (a limit of the system), it need not be ahead.
  for (const haddr_t size : {length_ahead(end), end})
    if (file.eof >= size || ::ftruncate(file.descriptor, static_cast<off_t>(size)) == 0) {
      file.eof = std::max(file.eof, size);
      file.announced = size;
      return !file.has_superblock || write_superblock(file);
    }
  return false;
}

H5FD_t* open_file(const char* name, unsigned flags, hid_t, haddr_t) {
  const int descriptor =
      ::open(name,
             (flags & H5F_ACC_RDWR ? O_RDWR : O_RDONLY) | O_CLOEXEC | (flags & H5F_ACC_CREAT ? O_CREAT : 0) |
                 (flags & H5F_ACC_TRUNC ? O_TRUNC : 0) | (flags & H5F_ACC_EXCL ? O_EXCL : 0),
             0666);
  struct stat status {};
  if (descriptor < 0 || ::fstat(descriptor, &status) != 0) {
    failed("open");
    if (descriptor >= 0) ::close(descriptor);
    return nullptr;
  }
  auto* file = new File;
  file->descriptor = descriptor;
  file->eof = file->announced = static_cast<haddr_t>(status.st_size);
  file->device = status.st_dev;
  file->inode = status.st_ino;
  if (!(flags & H5F_ACC_RDWR)) file->torn = TornBlock::find(descriptor);
  return &file->pub;
}

herr_t close_file(H5FD_t* opened) {
  File* file = &as_file(opened);
  const bool is_written = write_pending(*file);
  const int status = ::close(file->descriptor);
  delete file;
  return is_written && status == 0 ? 0 : failed("close");
}

int compare(const H5FD_t* a, const H5FD_t* b) {
  const File &x = as_file(a), &y = as_file(b);
  if (x.device != y.device) return x.device < y.device ? -1 : 1;
  return x.inode == y.inode ? 0 : x.inode < y.inode ? -1 : 1;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  if (flags)
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_SUPPORTS_SWMR_IO | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t end_given_out(const H5FD_t* file, H5FD_mem_t) { return as_file(file).eoa; }
herr_t give_out(H5FD_t* file, H5FD_mem_t, haddr_t address) {
  as_file(file).eoa = address;
  return 0;
}
haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t) { return as_file(file).eof; }

herr_t handle_of(H5FD_t* file, hid_t, void** handle) {
  *handle = &as_file(file).descriptor;
  return 0;
}

herr_t read_from_file(H5FD_t* opened, H5FD_mem_t, hid_t, haddr_t address, size_t size, void* buffer) {
  File& file = as_file(opened);
  if (!write_pending(file)) return failed("write");
  const std::span wanted(static_cast<unsigned char*>(buffer), size);
  const auto n_read = read_up_to(file.descriptor, address, wanted);
  if (!n_read) return failed("read");
  std::fill(wanted.begin() + static_cast<std::ptrdiff_t>(*n_read), wanted.end(), 0);  // behind the end of the file
  if (file.torn) file.torn->mend(file.descriptor, address, wanted);
  return 0;
}

herr_t write_to_file(H5FD_t* opened, H5FD_mem_t kind, hid_t, haddr_t address, size_t size, const void* buffer) {
  File& file = as_file(opened);
  if (!reach(file, std::max(file.eoa, address + size))) return failed("write");
  const auto* bytes = static_cast<const unsigned char*>(buffer);
  if (address == 0 && size >= superblock_size && std::equal(superblock_begin.begin(), superblock_begin.end(), bytes)) {
    std::copy_n(bytes, superblock_size, file.superblock.begin());
    file.has_superblock = true;
    if (!write_superblock(file)) return failed("write");
    address += superblock_size;
    bytes += superblock_size;
    size -= superblock_size;
  }
  if (!write_later(file, address, {bytes, size}, kind != H5FD_MEM_DRAW)) return failed("write");
  file.eof = std::max(file.eof, address + size);
  return 0;
}

herr_t flush(H5FD_t* opened, hid_t, hbool_t) { return write_pending(as_file(opened)) ? 0 : failed("write"); }

herr_t truncate_at_the_end(H5FD_t* opened, hid_t, hbool_t closing) {
  File& file = as_file(opened);
  if (!write_pending(file)) return failed("write");
  if (!closing || file.eof == file.eoa) return 0;
  // The superblock first: a file that is shorter than it says cannot be opened.
  file.is_closing = true;
  put_number(file.superblock, end_of_file_at, file.eoa, 8);
  if (file.has_superblock && !write_superblock(file)) return failed("write");
  if (::ftruncate(file.descriptor, static_cast<off_t>(file.eoa)) != 0) return failed("truncate");
  file.eof = file.announced = file.eoa;
  return 0;
}

herr_t no_lock(H5FD_t*, hbool_t) { return 0; }
herr_t no_unlock(H5FD_t*) { return 0; }

hid_t driver() {
  static const hid_t id = [] {
    H5FD_class_t c{};
    c.name = "rotordrop";
    c.maxaddr = (haddr_t{1} << 63) - 1;
    c.fc_degree = H5F_CLOSE_WEAK;
    c.open = open_file;
    c.close = close_file;
    c.cmp = compare;
    c.query = query;
    c.get_eoa = end_given_out;
    c.set_eoa = give_out;
    c.get_eof = end_of_file;
    c.get_handle = handle_of;
    c.read = read_from_file;
    c.write = write_to_file;
    c.flush = flush;
    c.truncate = truncate_at_the_end;
    c.lock = no_lock;
    c.unlock = no_unlock;
    constexpr std::array<H5FD_mem_t, H5FD_MEM_NTYPES> two_lists = H5FD_FLMAP_DICHOTOMY;
    std::copy(two_lists.begin(), two_lists.end(), c.fl_map);
    return H5FDregister(&c);
  }();
  return id;
}

}  // namespace

Handle access_for_writing() {
  be_quiet();
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make property list");
  require(H5Pset_libver_bounds(access.id(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST), "set file format");
  require(H5Pset_driver(access.id(), driver(), nullptr), "set file driver");
  // Rows are written once, in order, many at a time: a chunk goes to the file at once, and those of a dataset follow on each other. For the file, not
  // for a dataset: H5Fstart_swmr_write() opens all datasets anew with the file's cache, a megabyte each (HDF5 1.10.8).
  require(H5Pset_cache(access.id(), 0, 17, 0, 1.0), "set chunk cache");
  require(H5Pset_sieve_buf_size(access.id(), 0), "set buffer");  // the driver has one
  return access;
}

void mend_while_reading(hid_t access, const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  const bool is_torn = TornBlock::find(descriptor).has_value();
  ::close(descriptor);
  if (is_torn) require(H5Pset_driver(access, driver(), nullptr), "set file driver");
}

void sync(hid_t file, std::string_view what) {
  int* descriptor = nullptr;
  require(H5Fget_vfd_handle(file, H5P_DEFAULT, reinterpret_cast<void**>(&descriptor)), what);
  // EINVAL: not a file that can be synchronised, such as on some network file systems; there is nothing better to do.
  if (::fsync(*descriptor) != 0 && errno != EINVAL && errno != ENOSYS)
    throw SolverError(std::string(what) + ": " + std::generic_category().message(errno));
}

}  // namespace rotordrop::hdf5
