// Recorded results: HDF5. Every dataset of a file that HDF5 itself can read is read.
#include "input.h"
#include "io/hdf5/recorded_series.h"
#include "io/hdf5/trial_reading.h"

// HDF5 1.10.8 loses small parts of its own when it gives up a damaged file. An object that the program does not close is no leak to the
// sanitizer, for HDF5 has it in its tables; memory of the program's own is watched as elsewhere.
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5\n"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rotordrop;
  const auto& file = fuzz::file_of(data, size, ".h5");
  fuzz::allow_refusal([&] {
    hdf5::try_to_read(file, 1);
    for (const auto& name : list_datasets(file))
      fuzz::allow_refusal([&] { static_cast<void>(read_series(file, name)); });
  });
  return 0;
}
