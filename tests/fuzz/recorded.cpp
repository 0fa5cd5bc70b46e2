// Recorded results: HDF5. Every dataset of a file that HDF5 itself can read is read.
#include "input.h"
#include "io/hdf5/recorded_series.h"
#include "io/hdf5/trial_reading.h"

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
