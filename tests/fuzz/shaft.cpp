// Shafts as tables: CSV.
#include "geometry.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rotordrop::fuzz::read_as_geometry(data, size, ".csv");
  return 0;
}
