#include "case/new_case.h"

#include "base/errors.h"
#include "case/program_files.h"
#include "case/rotor_file.h"
#include "io/checkpoint.h"
#include "io/text/input_file.h"
#include "io/text/parameter_writers.h"

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

/// @returns the case to be written
fs::path fresh_case_in(const fs::path& directory) {
  const fs::path file = directory / "drop.toml";
  if (fs::exists(file)) throw InputError({file.string(), 0, 0}, "the file already exists", "Choose another folder.");
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) throw InputError({directory.string(), 0, 0}, "the folder cannot be made: " + error.message());
  return file;
}

void copy_to(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::copy_file(from, to, error);
  if (error) throw InputError({to.string(), 0, 0}, "cannot be written: " + error.message());
}

}  // namespace

fs::path new_case(const fs::path& directory) {
  const fs::path file = fresh_case_in(directory);
  for (const auto& [from, to] :
       {std::pair{"neisi2019.toml", "reference.toml"}, std::pair{"neisi2019-rotor.json", "neisi2019-rotor.json"}})
    copy_to(params_folder() / from, directory / to);
  write_text_atomically(file, drop_toml);
  return file;
}

fs::path new_own_case(const fs::path& directory, const fs::path& shaft) {
  const std::string example = "shaft.csv";
  const fs::path own = params_folder() / "own-machine";
  std::string text = read_input_file(own / "drop.toml");
  fs::path geometry = own / example;
  if (!shaft.empty()) {
    read_geometry(shaft);
    geometry = shaft;
    const std::string named = toml_value(Node(example));
    text.replace(text.find(named), named.size(), toml_value(Node(shaft.filename().string())));
  }
  const fs::path file = fresh_case_in(directory);
  copy_to(geometry, directory / geometry.filename());
  write_text_atomically(file, text);
  return file;
}

}  // namespace rotordrop
