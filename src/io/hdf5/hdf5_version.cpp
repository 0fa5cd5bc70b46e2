#include "io/hdf5/hdf5_version.h"

#include <fmt/format.h>
#include <hdf5.h>

#include "io/hdf5/hdf5_handle.h"

namespace rotordrop {

std::string hdf5_version() {
  hdf5::be_quiet();  // before anything else wakes the library, which would then close files at exit
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

}  // namespace rotordrop
