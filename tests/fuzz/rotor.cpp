// Geometry of rotors: JSON.
#include "geometry.h"
#include "io/text/json_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rotordrop;
  fuzz::allow_refusal([&] { static_cast<void>(parse_json(fuzz::text_of(data, size), "input")); });
  fuzz::read_as_geometry(data, size, ".json");
  return 0;
}
