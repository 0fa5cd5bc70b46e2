// Geometry of rotors: JSON.
#include "case/case.h"
#include "input.h"
#include "io/text/json_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rotordrop;
  const auto& file = fuzz::file_of(data, size, ".json");
  static const auto drop_case = file.parent_path() / "drop.toml";
  static const bool is_written = [] {
    std::ofstream(drop_case) << "[run]\nend_time = 1e-3\ninitial_speed = 100\n[rotor]\ngeometry = \"input.json\"\n"
                                "[bearings.A]\ntype = \"linear\"\nnode = 1\nstiffness = [[1e7, 0.0], [0.0, 1e7]]\n";
    return true;
  }();
  fuzz::allow_refusal([&] { static_cast<void>(parse_json(fuzz::text_of(data, size), "input")); });
  if (is_written) fuzz::allow_refusal([&] { static_cast<void>(read_case(drop_case)); });
  return 0;
}
