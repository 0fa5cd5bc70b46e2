// Case files: TOML, declarations, checks of the whole machine. The seeds' rotor lies beside the input.
#include "case/case.h"
#include "input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rotordrop;
  const auto& file = fuzz::file_of(data, size, ".toml");
  static const bool has_rotor = [&] {
    namespace fs = std::filesystem;
    fs::copy_file(fs::path(ROTORDROP_SOURCE_DIR) / "params/neisi2019-rotor.json", file.parent_path() / "rotor.json",
                  fs::copy_options::overwrite_existing);
    fs::copy_file(fs::path(ROTORDROP_SOURCE_DIR) / "params/neisi2019.toml", file.parent_path() / "reference.toml",
                  fs::copy_options::overwrite_existing);
    fs::copy_file(fs::path(ROTORDROP_SOURCE_DIR) / "params/neisi2019-rotor.json",
                  file.parent_path() / "neisi2019-rotor.json", fs::copy_options::overwrite_existing);
    return true;
  }();
  if (has_rotor) fuzz::allow_refusal([&] { static_cast<void>(read_case(file)); });
  return 0;
}
