#include "case/named_files.h"

#include "io/sha256.h"
#include "machine/build_machine.h"

namespace rotordrop {

std::vector<NamedFile> named_files(const Case& c) {
  std::vector<NamedFile> files;
  const auto add = [&](const std::filesystem::path& path) { files.push_back({path, sha256_of_file(path)}); };
  const auto& thermal = c.parameters.thermal;
  if (thermal.fe.mesh && thermal.has_fe)
    for (const auto& name : touchdown_names(c.parameters)) add(own_mesh_file(*thermal.fe.mesh, name));
  if (thermal.recorded && driver_of(thermal) == GrowthDriver::recorded) add(*thermal.recorded);
  return files;
}

}  // namespace rotordrop
