// Studies: TOML, declarations, checks of every point. The case lies beside the input.
#include "study/many/study_file.h"
#include "input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rotordrop;
  const auto& file = fuzz::file_of(data, size, ".toml");
  static const bool has_case = [&] {
    namespace fs = std::filesystem;
    for (const char* name : {"neisi2019-rotor.json", "neisi2019.toml", "neisi2019-settling.toml"})
      fs::copy_file(fs::path(ROTORDROP_SOURCE_DIR) / "params" / name, file.parent_path() / name,
                    fs::copy_options::overwrite_existing);
    std::ofstream(file.parent_path() / "measured.csv") << "time [ms],/bearings/TB1/orbit[0] [um]\n0,1\n1,2\n2,3\n";
    return true;
  }();
  if (has_case) fuzz::allow_refusal([&] { static_cast<void>(read_study(file)); });
  return 0;
}
