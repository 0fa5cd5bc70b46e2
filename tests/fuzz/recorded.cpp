// Recorded results: HDF5. Every dataset of the file is read.
#include "io/hdf5/recorded_series.h"
#include "input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rotordrop;
  const auto& file = fuzz::file_of(data, size, ".h5");
  fuzz::allow_refusal([&] {
    for (const auto& name : list_datasets(file))
      fuzz::allow_refusal([&] { static_cast<void>(read_series(file, name)); });
  });
  return 0;
}
