#include "case/modules/mesh_file.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include "base/errors.h"
#include "base/trial.h"
#include "case/modules/fe_module.h"

namespace rotordrop {
namespace {

/// A twentieth of what gmsh reads.
constexpr std::uintmax_t bytes_per_second = 1u << 20u;
/// Gmsh takes about five for each byte of a file.
constexpr std::uintmax_t memory_per_byte = 64, memory_besides = 1u << 30u;

Trial::Limits limits_of(const std::string& file, unsigned patience) {
  if (file.ends_with(".geo")) return {};  // it takes what its mesh takes
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) return {};
  return {.seconds = patience + static_cast<unsigned>(std::min(size / bytes_per_second, std::uintmax_t{100'000})),
          .memory = memory_besides + memory_per_byte * size};
}

[[noreturn]] void refuse(const std::string& file, const std::string& what) {
  throw InputError({file, 0, 0}, what, "Give a mesh in gmsh's format 2.2 or 4.1.");
}

}  // namespace

MeshFileContent read_mesh_file(const std::string& file, unsigned patience) {
  SectionMesher& mesher = section_mesher();
  Trial trial(limits_of(file, patience));
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
