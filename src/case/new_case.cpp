#include "case/new_case.h"

#include "base/errors.h"
#include "case/program_files.h"
#include "io/checkpoint.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

constexpr const char* drop_toml = R"(#:schema ./schema.json
# A rotor drop. Change what differs from the reference case; `rotordrop defaults` lists every parameter.
base = "reference.toml"

[run]
initial_speed = "15200 rpm"
end_time = "0.3 s"

[contact]
friction_coefficient = 0.1
air_gap = "250 um"

# Your own rotor: a file with the same layout as neisi2019-rotor.json.
# [rotor]
# geometry = "my-rotor.json"

# A bearing by its catalogue name; values given here override the catalogue's.
# [bearings.TB1]
# catalogue = "6014"
)";

}  // namespace

fs::path new_case(const fs::path& directory) {
  const fs::path file = directory / "drop.toml";
  if (fs::exists(file)) throw InputError({file.string(), 0, 0}, "the file already exists", "Choose another folder.");
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) throw InputError({directory.string(), 0, 0}, "the folder cannot be made: " + error.message());
  const fs::path params = params_folder();
  for (const auto& [from, to] :
       {std::pair{"neisi2019.toml", "reference.toml"}, std::pair{"neisi2019-rotor.json", "neisi2019-rotor.json"}}) {
    fs::copy_file(params / from, directory / to, error);
    if (error) throw InputError({(directory / to).string(), 0, 0}, "cannot be written: " + error.message());
  }
  write_text_atomically(file, drop_toml);
  return file;
}

}  // namespace rotordrop
