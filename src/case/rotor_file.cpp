#include "case/rotor_file.h"

#include <algorithm>

#include "base/errors.h"
#include "case/program_files.h"
#include "io/text/json_reader.h"
#include "io/text/shaft_table.h"
#include "io/text/toml_reader.h"

namespace rotordrop {

Node read_geometry(const std::filesystem::path& file) {
  if (file.extension() == ".csv") return read_shaft_table(file);
  Node geometry = file.extension() == ".toml" ? read_toml(file) : read_json(file);
  const auto is_of_ross = [](const Node::Entry& entry) { return entry.key.starts_with("ShaftElement"); };
  if (geometry.is_table() && std::any_of(geometry.entries().begin(), geometry.entries().end(), is_of_ross))
    throw InputError({file.string(), 0, 0}, "this is a rotor that ROSS saved.",
                     "Make it a case, with its bearings as linear supports: /usr/bin/python3 " +
                         (params_folder().parent_path() / "examples/rotor_files.py").string() + " import " +
                         file.string() + " FOLDER");
  return geometry;
}

}  // namespace rotordrop
