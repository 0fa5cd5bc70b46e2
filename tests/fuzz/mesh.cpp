// Meshes of a bearing as gmsh writes them: read, and taken as the section of the reference case's first bearing.
#include "case/case.h"
#include "case/modules/mesh_file.h"
#include "input.h"
#include "machine/heat/bearing_mesh_data.h"

// What gmsh loses of a file that it gives up is not counted; memory of the program's own is watched as elsewhere.
extern "C" const char* __lsan_default_suppressions() { return "leak:libgmsh\n"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rotordrop;
  static const Case drop_case = read_case(std::string(ROTORDROP_SOURCE_DIR) + "/params/neisi2019.toml");
  const auto& file = fuzz::file_of(data, size, ".msh");
  fuzz::allow_refusal([&] {
    const auto content = read_mesh_file(file.string(), 1);
    static_cast<void>(own_section_of_bearing(content, drop_case.parameters, "TB1", file.string()));
  });
  return 0;
}
