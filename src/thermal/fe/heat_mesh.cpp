#include "thermal/fe/heat_mesh.h"

#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "base/errors.h"
#include "base/rotation.h"
#include "thermal/fe/grid_lines.h"

namespace rotordrop {
namespace {

using std::numbers::pi;
using VertexPair = std::pair<unsigned int, unsigned int>;
VertexPair sorted_pair(unsigned int a, unsigned int b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

HeatMesh::HeatMesh(const SectionMesh& section, unsigned int degree)
    : section_(section), mapping_(section.arcs.empty() ? 1 : std::max(2U, degree)), fe_(degree), dofs_(triangulation_) {
  std::vector<dealii::Point<2>> vertices;
  for (const auto& v : section_.vertices) vertices.emplace_back(v[0], v[1]);
  std::vector<dealii::CellData<2>> cells;
  for (const auto& c : section_.cells) {
    dealii::CellData<2> cell;
    cell.vertices = {c.vertices[0], c.vertices[1], c.vertices[3], c.vertices[2]};
    cell.material_id = static_cast<dealii::types::material_id>(c.body);
    cells.push_back(cell);
  }
  dealii::GridTools::consistently_order_cells(cells);
  triangulation_.create_triangulation(vertices, cells, dealii::SubCellData());

  std::map<VertexPair, std::size_t> edge_of;
  for (std::size_t i = 0; i < section_.edges.size(); ++i)
    edge_of[sorted_pair(section_.edges[i].vertices[0], section_.edges[i].vertices[1])] = i;
  for (std::size_t a = 0; a < section_.arcs.size(); ++a) {
    const auto& arc = section_.arcs[a];
    triangulation_.set_manifold(static_cast<dealii::types::manifold_id>(a + 1),
                                dealii::SphericalManifold<2>(dealii::Point<2>(arc.x, arc.r)));
  }
  for (const auto& cell : triangulation_.active_cell_iterators())
    for (const unsigned int f : cell->face_indices()) {
      const auto found = edge_of.find(sorted_pair(cell->face(f)->vertex_index(0), cell->face(f)->vertex_index(1)));
      if (found == edge_of.end()) continue;
      if (const int arc = section_.edges[found->second].arc; arc >= 0)
        bend_from(cell, f, static_cast<std::size_t>(arc));
    }
  require_upright_cells();

  dofs_.distribute_dofs(fe_);
  faces_.resize(section_.edges.size());
  // A coarse mesh keeps the order in which its cells were given.
  for (const auto& cell : dofs_.active_cell_iterators()) {
    cells_.push_back(cell);
    for (const unsigned int f : cell->face_indices()) {
      const auto found = edge_of.find(sorted_pair(cell->face(f)->vertex_index(0), cell->face(f)->vertex_index(1)));
      if (found != edge_of.end()) faces_[found->second] = {cell, f, found->second};
    }
  }
}

void HeatMesh::bend_from(CoarseCell cell, unsigned int f, std::size_t arc) {
  struct Layer {
    CoarseCell cell;
    unsigned int face;  ///< on the arc's side
    double thickness, bulge;
  };
  // From the arc inwards, to the other side of the body or to another arc.
  std::vector<Layer> layers;
  for (;;) {
    const unsigned int across = f ^ 1U;
    const auto face = cell->face(f), opposite = cell->face(across);
    const double length = face->measure();
    layers.push_back(
        {cell, f, face->center().distance(opposite->center()), length * length / (8. * section_.arcs[arc].radius)});
    if (opposite->at_boundary() || opposite->manifold_id() != dealii::numbers::flat_manifold_id) break;
    const auto neighbour = cell->neighbor(across);
    f = static_cast<unsigned int>(cell->neighbor_of_neighbor(across));
    cell = neighbour;
  }
  // The thickest layer, or one to which the bulge is nothing, gets from curved to straight.
  const auto last = std::max_element(layers.begin(), layers.end(),
                                     [](const Layer& a, const Layer& b) { return a.thickness < b.thickness; });
  for (auto layer = layers.begin();; ++layer) {
    layer->cell->face(layer->face)->set_manifold_id(static_cast<dealii::types::manifold_id>(arc + 1));
    if (layer == last || layer->bulge < 0.05 * layer->thickness) return;
  }
}

void HeatMesh::require_upright_cells() const {
  const dealii::QGauss<2> quadrature(fe_.degree + 1);
  dealii::FEValues<2> fe(mapping_, fe_, quadrature, dealii::update_jacobians);
  for (const auto& cell : triangulation_.active_cell_iterators()) {
    fe.reinit(cell);
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      if (!(fe.jacobian(q).determinant() > 0.))
        throw SolverError(
            fmt::format("the mesh of the section has a cell of {} that its curved side turns inside out, at x = {:.4g} "
                        "mm, r = {:.4g} mm.",
                        section_.bodies.at(cell->material_id()), cell->center()[0] * 1e3, cell->center()[1] * 1e3));
  }
}

std::vector<HeatMesh::Face> HeatMesh::faces_of(const HeatBoundary& boundary) const {
  std::vector<Face> found;
  for (const auto& face : faces_)
    if (section_.edges[face.edge].boundary == boundary) found.push_back(face);
  return found;
}

std::vector<std::pair<HeatMesh::Face, HeatMesh::Face>> HeatMesh::pairs_of(const HeatBoundary& first,
                                                                          const HeatBoundary& second) const {
  std::vector<std::pair<Face, Face>> pairs;
  const auto others = faces_of(second);
  for (const auto& a : faces_of(first))
    for (const auto& b : others) {
      const auto face_a = a.cell->face(a.number), face_b = b.cell->face(b.number);
      if (face_a->center().distance(face_b->center()) < 1e-3 * face_a->measure() &&
          std::fabs(face_a->measure() - face_b->measure()) < 1e-3 * face_a->measure())
        pairs.emplace_back(a, b);
    }
  return pairs;
}

double HeatMesh::area(const Face& face) const {
  const auto& edge = section_.edges[face.edge];
  const auto &a = section_.vertices[edge.vertices[0]], &b = section_.vertices[edge.vertices[1]];
  if (edge.arc < 0) return pi * (a[1] + b[1]) * std::hypot(b[0] - a[0], b[1] - a[1]);
  const auto& arc = section_.arcs[static_cast<std::size_t>(edge.arc)];
  // r = arc.r + radius sin(phi): the integral of 2 pi r over the arc's length.
  const double phi_a = std::atan2(a[1] - arc.r, a[0] - arc.x);
  const double turn = shorter_way(std::atan2(b[1] - arc.r, b[0] - arc.x) - phi_a);
  return 2. * pi * arc.radius * std::fabs(arc.r * turn + arc.radius * (std::cos(phi_a) - std::cos(phi_a + turn)));
}

HeatMesh::Place HeatMesh::locate(std::size_t body, double x, double r) const {
  const dealii::Point<2> wanted(x, r);
  Place best;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& cell : cells_) {
    if (cell->material_id() != body ||
        cell->bounding_box().get_boundary_points().first.distance(wanted) > 4. * cell->diameter())
      continue;
    try {
      const auto on_unit = mapping_.transform_real_to_unit_cell(cell, wanted);
      const double outside = std::max({-on_unit[0], on_unit[0] - 1., -on_unit[1], on_unit[1] - 1., 0.});
      if (outside < nearest) {
        nearest = outside;
        best = {cell, on_unit};
      }
      if (outside == 0.) break;
    } catch (const dealii::Mapping<2>::ExcTransformationFailed&) {
      continue;  // far from this cell
    }
  }
  if (nearest > 1e-3)
    throw SolverError(fmt::format("there is no cell of body {} at x = {:.6g} m, r = {:.6g} m.", body, x, r));
  return best;
}

SectionMesh mesh_of_rectangles(const HeatConductionProblem& problem) {
  SectionMesh mesh;
  const Grid grid = make_grid(problem);
  const auto inside = [](const std::vector<double>& lines, const std::array<double, 2>& extent) {
    std::vector<double> found;  // lines of the body, the last one included
    const double slack = 1e-9 * (lines.back() - lines.front());
    for (const double line : lines)
      if (line >= extent[0] - slack && line <= extent[1] + slack) found.push_back(line);
    // Exactly the body's own dimensions, so that areas are.
    found.front() = extent[0];
    found.back() = extent[1];
    return found;
  };
  for (unsigned int b = 0; b < problem.bodies.size(); ++b) {
    const auto& body = problem.bodies[b];
    mesh.bodies.push_back(body.name);
    const auto x = inside(grid.x, body.x), r = inside(grid.r, body.r);
    const auto first = static_cast<unsigned int>(mesh.vertices.size());
    const auto n_x = static_cast<unsigned int>(x.size()), n_r = static_cast<unsigned int>(r.size());
    const auto vertex = [&](unsigned int i, unsigned int j) { return first + j * n_x + i; };
    for (const double r_j : r)
      for (const double x_i : x) mesh.vertices.push_back({x_i, r_j});
    for (unsigned int j = 0; j + 1 < n_r; ++j)
      for (unsigned int i = 0; i + 1 < n_x; ++i)
        mesh.cells.push_back({{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)}, b});
    for (unsigned int i = 0; i + 1 < n_x; ++i) {
      mesh.edges.push_back({{vertex(i, 0), vertex(i + 1, 0)}, {b, HeatSide::inner, 0}, -1});
      mesh.edges.push_back({{vertex(i, n_r - 1), vertex(i + 1, n_r - 1)}, {b, HeatSide::outer, 0}, -1});
    }
    for (unsigned int j = 0; j + 1 < n_r; ++j) {
      mesh.edges.push_back({{vertex(0, j), vertex(0, j + 1)}, {b, HeatSide::left, 0}, -1});
      mesh.edges.push_back({{vertex(n_x - 1, j), vertex(n_x - 1, j + 1)}, {b, HeatSide::right, 0}, -1});
    }
  }
  return mesh;
}

}  // namespace rotordrop
