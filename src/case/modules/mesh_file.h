#pragma once
#include <string>

#include "model/section_mesher.h"

namespace rotordrop {

/// Reads a mesh, or a recipe (.geo), by the mesh room. Gmsh (4.8) may crash on a few altered bytes: a process of its own reads first.
/// @param patience  what a mesh may take besides the time of its size [s]; a recipe takes what it takes
/// @throws InputError if gmsh refuses the file, crashes, or does not come to an end with it
MeshFileContent read_mesh_file(const std::string& file, unsigned patience = 20);

}  // namespace rotordrop
