#pragma once
#include <cstddef>

#include "model/section_mesh.h"

namespace rotordrop {

struct MeshQuality {
  std::size_t n_cells = 0, n_vertices = 0;
  double smallest_jacobian = 0;  ///< scaled: sine of the worst corner; 1 for rectangles, negative for inverted cells
  double mean_jacobian = 0;      ///< of the cells' worst corners
  double thinnest_cell = 0;      ///< smallest distance between midpoints of opposite sides [m]
};
MeshQuality mesh_quality(const SectionMesh& mesh);

}  // namespace rotordrop
