#include "case/modules/mesh_file.h"

#include <cstdint>

#include "base/errors.h"
#include "base/trial.h"
#include "case/modules/fe_module.h"

namespace rotordrop {
namespace {

/// A twentieth of what gmsh reads, and ten times what it takes.
constexpr ReadingRates rates{
    .bytes_per_second = 1u << 20u, .memory_per_byte = 64, .memory_besides = std::uint64_t{1} << 30u};

[[noreturn]] void refuse(const std::string& file, const std::string& what) {
  throw InputError({file, 0, 0}, what, "Give a mesh in gmsh's format 2.2 or 4.1.");
}

}  // namespace

MeshFileContent read_mesh_file(const std::string& file, unsigned patience) {
  SectionMesher& mesher = section_mesher();
  const bool is_recipe = file.ends_with(".geo");  // it takes what its mesh takes
  Trial trial(is_recipe ? Trial::Limits{} : limits_of_reading(file, patience, rates));
  trial.start([&] { static_cast<void>(mesher.read(file)); });
  switch (trial.wait()) {
    case Trial::End::crashed:
      refuse(file, "gmsh crashes on this file: it is damaged.");
    case Trial::End::out_of_time:
      refuse(file, "gmsh does not come to an end with this file: it is damaged.");
    case Trial::End::out_of_memory:
      refuse(file, "gmsh wants far more memory than a file of this size explains: it is damaged.");
    case Trial::End::done:
    case Trial::End::not_tried:
      break;
  }
  try {
    return mesher.read(file);
  } catch (const SolverError& error) {
    refuse(file, error.what());
  }
}

}  // namespace rotordrop
