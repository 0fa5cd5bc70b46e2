// Shafts as tables: CSV.
#include "case/case.h"
#include "input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rotordrop;
  const auto& file = fuzz::file_of(data, size, ".csv");
  static const auto drop_case = file.parent_path() / "drop.toml";
  static const bool is_written = [] {
    std::ofstream(drop_case) << "[run]\nend_time = 1e-3\ninitial_speed = 100\n[rotor]\ngeometry = \"input.csv\"\n"
                                "[bearings.A]\ntype = \"linear\"\nnode = 1\nstiffness = [[1e7, 0.0], [0.0, 1e7]]\n";
    return true;
  }();
  if (is_written) fuzz::allow_refusal([&] { static_cast<void>(read_case(drop_case)); });
  return 0;
}
