#include "case/bearing_mesh.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <string_view>

#include "base/errors.h"
#include "case/modules/fe_module.h"
#include "case/modules/mesh_file.h"
#include "io/checkpoint.h"
#include "machine/heat/bearing_mesh_data.h"
#include "model/section_quality.h"
#include "thermal/fe_parameters.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

SectionMesh read_own_mesh(const Case& c, const std::string& bearing) {
  const std::string file = own_mesh_file(*c.parameters.thermal.fe.mesh, bearing);
  const Node* thermal = c.tree.find("thermal");
  const Node* fe = thermal ? thermal->find(fe_name) : nullptr;
  if (!fs::is_regular_file(file))
    throw InputError(
        fe ? position_of_value(*fe, "mesh") : SourcePosition{},
        fmt::format("thermal.fe.mesh: there is no file {} for bearing {}.", file, bearing),
        "NAME in thermal.fe.mesh stands for the bearing's name. `rotordrop mesh` writes one to start from.");
  return own_section_of_bearing(read_mesh_file(file), c.parameters, bearing, file);
}

/// Faults of all bearings at once, and before the mesh room is needed.
void check_sections(const Case& c, const std::vector<std::string>& names) {
  if (c.parameters.thermal.fe.mesh) return;
  Faults faults;
  for (const auto& name : names) {
    try {
      static_cast<void>(section_plan(c.parameters, c.tree, name));
    } catch (const InputError& error) {
      faults.add(error.faults());
    }
  }
  faults.throw_if_any();
}

std::string description(const std::string& bearing, const SectionMesh& mesh, const fs::path& file) {
  std::string bodies;
  for (std::size_t i = 0; i < mesh.bodies.size(); ++i) {
    const auto n = std::count_if(mesh.cells.begin(), mesh.cells.end(), [i](const auto& c) { return c.body == i; });
    bodies += fmt::format("{}{} {}", i > 0 ? ", " : "", mesh.bodies[i], n);
  }
  const auto q = mesh_quality(mesh);
  return fmt::format(
      "{}: {} cells ({}), {} vertices\n    thinnest cell {:.4g} um; scaled Jacobian at least {:.3f}, mean {:.3f}\n"
      "    written to {}\n",
      bearing, q.n_cells, bodies, q.n_vertices, q.thinnest_cell * 1e6, q.smallest_jacobian, q.mean_jacobian,
      file.string());
}

void write_mesh(const SectionMesh& mesh, const fs::path& file, MeshFileFormat format) {
  require_writable(file);
  // Gmsh tells the format by the ending. Complete or not at all: beside it first, then renamed.
  const fs::path beside = file.parent_path() / ("." + file.stem().string().substr(0, 200) + ".part.msh");
  section_mesher().write(mesh, beside.string(), format);
  // Gmsh does not say whether all of it was written.
  std::ifstream written(beside, std::ios::binary | std::ios::ate);
  constexpr std::string_view end = "$EndElements\n";
  std::string last(end.size(), '\0');
  written.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  if (!written.read(last.data(), static_cast<std::streamsize>(last.size())) || last != end || !is_on_disk(beside)) {
    std::error_code ignored;
    fs::remove(beside, ignored);
    throw SolverError("cannot write " + file.string() + ": Check free disk space and write permission.");
  }
  fs::rename(beside, file);
}

}  // namespace

SectionMesh bearing_mesh(const Case& c, const std::string& bearing) {
  if (c.parameters.thermal.fe.mesh) return read_own_mesh(c, bearing);
  return section_mesh_of(section_plan(c.parameters, c.tree, bearing));
}

std::string write_bearing_meshes(const Case& c, const MeshOptions& options) {
  const auto names = chosen_touchdowns(c, options.bearing);
  if (names.empty())
    throw InputError({c.file.string(), 0, 0}, "the case has no touchdown bearing, so there is nothing to mesh.");
  if (options.file.extension() != ".msh")
    throw InputError({options.file.string(), 0, 0}, "the name of a mesh file must end in .msh.",
                     "For example: -o bearing.msh.");
  std::vector<fs::path> files;
  for (const auto& name : names) {
    fs::path file = options.file;
    if (names.size() > 1) file.replace_filename(file.stem().string() + "-" + name + ".msh");
    if (!options.force && fs::exists(file))
      throw InputError({file.string(), 0, 0}, "the file already exists.",
                       "Choose another with -o FILE, or replace it with --force.");
    files.push_back(file);
  }
  check_sections(c, names);
  // All meshes first: a fault in one leaves no file of another.
  std::vector<SectionMesh> meshes;
  for (const auto& name : names) meshes.push_back(bearing_mesh(c, name));
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    write_mesh(meshes[i], files[i], options.format);
    text += description(names[i], meshes[i], files[i]);
  }
  return text;
}

}  // namespace rotordrop
