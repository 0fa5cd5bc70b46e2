#include "model/section_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rotordrop {
namespace {

using Point = std::array<double, 2>;

Point difference(const Point& a, const Point& b) { return {b[0] - a[0], b[1] - a[1]}; }
Point middle(const Point& a, const Point& b) { return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}; }
double cross(const Point& a, const Point& b) { return a[0] * b[1] - a[1] * b[0]; }
double length(const Point& a) { return std::hypot(a[0], a[1]); }

std::array<Point, 4> corners(const SectionMesh& mesh, const SectionMesh::Cell& cell) {
  std::array<Point, 4> p;
  std::transform(cell.vertices.begin(), cell.vertices.end(), p.begin(), [&](auto v) { return mesh.vertices.at(v); });
  return p;
}

}  // namespace

MeshQuality mesh_quality(const SectionMesh& mesh) {
  MeshQuality q;
  q.n_cells = mesh.cells.size();
  q.n_vertices = mesh.vertices.size();
  if (mesh.empty()) return q;
  q.smallest_jacobian = q.thinnest_cell = std::numeric_limits<double>::infinity();
  for (const auto& cell : mesh.cells) {
    const auto p = corners(mesh, cell);
    double worst = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 4; ++i) {
      const Point next = difference(p[i], p[(i + 1) % 4]), last = difference(p[i], p[(i + 3) % 4]);
      worst = std::min(worst, cross(next, last) / (length(next) * length(last)));
    }
    q.smallest_jacobian = std::min(q.smallest_jacobian, worst);
    q.mean_jacobian += worst / static_cast<double>(q.n_cells);
    for (std::size_t i = 0; i < 2; ++i)
      q.thinnest_cell =
          std::min(q.thinnest_cell, length(difference(middle(p[i], p[i + 1]), middle(p[i + 2], p[(i + 3) % 4]))));
  }
  return q;
}

}  // namespace rotordrop
