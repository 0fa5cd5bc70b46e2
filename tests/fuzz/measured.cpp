// Measured series: tables (CSV), and lists of them (TOML).
#include "study/compare/measured.h"
#include "input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rotordrop;
  const auto file = fuzz::file_of(data, size, ".csv");
  const auto list = std::filesystem::path(file).replace_extension(".toml");
  fuzz::allow_refusal([&] { static_cast<void>(read_measured_file(file)); });
  std::ofstream(list, std::ios::binary | std::ios::trunc) << fuzz::text_of(data, size);
  fuzz::allow_refusal([&] { static_cast<void>(read_measured_file(list)); });
  return 0;
}
