// Checkpoints: HDF5 and a line with a check sum, which is looked at before HDF5 sees a byte.
#include "io/checkpoint.h"
#include "input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rotordrop;
  const auto& file = fuzz::file_of(data, size, ".h5");
  fuzz::allow_refusal([&] { static_cast<void>(read_checkpoint(file)); });
  return 0;
}
