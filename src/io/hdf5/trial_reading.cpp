#include "io/hdf5/trial_reading.h"

#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>

#include "base/errors.h"
#include "base/trial.h"
#include "io/file_set.h"
#include "io/hdf5/series_reader.h"

namespace rotordrop::hdf5 {
namespace {

/// Far slower than any disk.
constexpr ReadingRates rates{.bytes_per_second = 2u << 20u};

/// Attributes of an object, as the readers of this room take them.
void read_attributes(hid_t object) {
  const auto read = [](hid_t owner, const char* name, const H5A_info_t*, void*) -> herr_t {
    try {
      const Handle attribute(H5Aopen(owner, name, H5P_DEFAULT), H5Aclose, name);
      static_cast<void>(read_attribute_texts(attribute.id(), name));
    } catch (const std::exception&) {
    }
    return 0;
  };
  H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, read, nullptr);
}

/// Where links cannot be read, HDF5 1.10.8 frees memory that was never set (H5G__link_release_table): whether that crashes is luck, of which this process
/// may have another than the one that asks. So it counts as a crash.
std::vector<std::string> listed(hid_t file) {
  try {
    return dataset_paths(file);
  } catch (const std::exception&) {
    std::abort();
  }
}

/// What a file refuses by another error is no crash: the readers tell it better.
void read_everything(const std::filesystem::path& path) {
  try {
    const Handle file = open_without_trial(path);
    read_attributes(file.id());
    for (const auto& name : listed(file.id())) {
      try {
        const Handle dataset(H5Dopen2(file.id(), name.c_str(), H5P_DEFAULT), H5Dclose, name);
        read_attributes(dataset.id());
        const Handle type(H5Dget_type(dataset.id()), H5Tclose, name);
        if (H5Tget_class(type.id()) == H5T_STRING) {
          static_cast<void>(read_texts(dataset.id(), name));
        } else {
          const SeriesReader reader(file.id(), path, name);
          constexpr std::size_t block = 4096;
          for (std::size_t row = 0; row < reader.n_rows(); row += block)
            static_cast<void>(reader.rows(row, std::min(block, reader.n_rows() - row)));
        }
      } catch (const std::exception&) {
      }
    }
  } catch (const std::exception&) {
  }
}

struct TrialOfFile {
  const std::filesystem::path& path;
  Trial trial;
};

/// Called by HDF5, which has one lock for all threads: it is this thread's now, and the child's. A child that is forked amid the call of
/// another thread would wait for it for ever.
herr_t fork_and_read(hid_t, const char*, void* data) {
  auto& file = *static_cast<TrialOfFile*>(data);
  file.trial.start([&file] { read_everything(file.path); });
  return 1;  // one call is enough
}

/// Files that need no trial.
FileSet& known_files() {
  static FileSet known;
  return known;
}

}  // namespace

void try_to_read(const std::filesystem::path& path, unsigned patience) {
  be_quiet();
  TrialOfFile file{path, Trial(limits_of_reading(path, patience, rates))};
  H5Piterate(H5P_FILE_ACCESS, nullptr, fork_and_read, &file);
  switch (file.trial.wait()) {
    case Trial::End::out_of_time:
      throw_damaged(path, "this file is damaged (HDF5 does not come to an end with it).");
    case Trial::End::crashed:
    case Trial::End::out_of_memory:
      throw_damaged(path, "this file is damaged (HDF5 cannot read it and crashes).");
    case Trial::End::done:
    case Trial::End::not_tried:
      return;  // without a process more the file is read as it is
  }
}

void require_readable(const std::filesystem::path& path) {
  struct stat status {};
  // What is not there, or is no file, opening tells; a pipe would wait for its writer.
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode) || known_files().has(path)) return;
  try_to_read(path);
  known_files().add(path);
}

void know_readable(const std::filesystem::path& path) { known_files().add(path); }

}  // namespace rotordrop::hdf5
