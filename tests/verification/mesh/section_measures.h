#pragma once
// Areas and lengths of meshed sections.
#include <cmath>
#include <cstddef>

#include "model/section_mesh.h"

namespace rotordrop::testing {

/// Area of a body's cells, straight-sided [m^2].
inline double body_area(const SectionMesh& mesh, std::size_t body) {
  double area = 0.;
  for (const auto& cell : mesh.cells) {
    if (cell.body != body) continue;
    const auto corner = [&](std::size_t i) { return mesh.vertices.at(cell.vertices[i]); };
    const auto a = corner(0), b = corner(1), c = corner(2), d = corner(3);
    area += 0.5 * ((c[0] - a[0]) * (d[1] - b[1]) - (c[1] - a[1]) * (d[0] - b[0]));
  }
  return area;
}

/// Length of an outline's part, along its arcs [m].
inline double boundary_length(const SectionMesh& mesh, const HeatBoundary& boundary) {
  double sum = 0.;
  for (const auto& edge : mesh.edges) {
    if (!(edge.boundary == boundary)) continue;
    const auto a = mesh.vertices.at(edge.vertices[0]), b = mesh.vertices.at(edge.vertices[1]);
    const double chord = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (edge.arc < 0) {
      sum += chord;
    } else {
      const double radius = mesh.arcs.at(static_cast<std::size_t>(edge.arc)).radius;
      sum += 2. * radius * std::asin(0.5 * chord / radius);
    }
  }
  return sum;
}

}  // namespace rotordrop::testing
