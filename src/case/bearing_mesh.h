#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "case/case.h"
#include "model/section_mesher.h"

namespace rotordrop {

/// The meshed section of a touchdown bearing: made from its parameters, or the user's own where thermal.fe.mesh names one.
/// @throws InputError
SectionMesh bearing_mesh(const Case& c, const std::string& bearing);

struct MeshOptions {
  std::filesystem::path file;
  std::string bearing;  ///< empty: all touchdown bearings; several of them go into FILE-NAME.msh each
  bool force = false;   ///< replace files that are there
  MeshFileFormat format = MeshFileFormat::msh_4_1;
};
/// Meshes and writes. @return lines for the screen
std::string write_bearing_meshes(const Case& c, const MeshOptions& options);

}  // namespace rotordrop
