#include "case/new_case.h"

#include <memory>
#include <string>
#include <vector>

#include "base/errors.h"
#include "case/case.h"
#include "case/program_files.h"
#include "case/rotor_file.h"
#include "io/checkpoint.h"
#include "io/half_made_file.h"
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

/// Files that are written into a folder; without keep() they go again, and the folder too if it was made for them.
class NewFolder {
 public:
  explicit NewFolder(fs::path directory) : directory_(std::move(directory)) {
    require_free("drop.toml");
    std::error_code error;
    is_made_ = fs::create_directories(directory_, error);
    if (error) throw InputError({directory_.string(), 0, 0}, "the folder cannot be made: " + error.message());
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  ~NewFolder() {
    files_.clear();
    std::error_code ignored;
    if (is_made_) fs::remove(directory_, ignored);  // only if it is empty
  }

  fs::path write(const fs::path& name, const std::string& text) {
    require_free(name);
    write_text_atomically(directory_ / name, text);
    files_.push_back(std::make_unique<HalfMadeFile>(directory_ / name));
    return directory_ / name;
  }
  void keep() {
    for (auto& file : files_) file->keep();
    is_made_ = false;
  }

 private:
  void require_free(const fs::path& name) const {
    if (fs::exists(directory_ / name))
      throw InputError({(directory_ / name).string(), 0, 0}, "the file already exists", "Choose another folder.");
  }

  fs::path directory_;
  bool is_made_ = false;
  std::vector<std::unique_ptr<HalfMadeFile>> files_;
};

}  // namespace

fs::path new_case(const fs::path& directory) {
  NewFolder folder(directory);
  folder.write("reference.toml", read_input_file(params_folder() / "neisi2019.toml"));
  folder.write("neisi2019-rotor.json", read_input_file(params_folder() / "neisi2019-rotor.json"));
  folder.write("schema.json", write_json_schema(case_sections()));
  const fs::path file = folder.write("drop.toml", drop_toml);
  folder.keep();
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
  NewFolder folder(directory);
  folder.write(geometry.filename(), read_input_file(geometry));
  folder.write("schema.json", write_json_schema(case_sections()));
  const fs::path file = folder.write("drop.toml", text);
  folder.keep();
  return file;
}

}  // namespace rotordrop
