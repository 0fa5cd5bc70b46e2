#pragma once
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/tria.h>

#include <utility>
#include <vector>

#include "model/heat_conduction.h"

namespace rotordrop {

/// Cells, unknowns and named boundaries of a section. Edges that are pieces of an arc are curved.
class HeatMesh {
 public:
  using Cell = dealii::DoFHandler<2>::active_cell_iterator;
  /// A cell's side on the outline.
  struct Face {
    Cell cell;
    unsigned int number = 0;
    std::size_t edge = 0;
  };
  /// @param degree of the elements
  HeatMesh(const SectionMesh& section, unsigned int degree);

  [[nodiscard]] const dealii::FE_Q<2>& element() const { return fe_; }
  [[nodiscard]] const dealii::MappingQ<2>& mapping() const { return mapping_; }
  [[nodiscard]] const dealii::DoFHandler<2>& dofs() const { return dofs_; }
  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
  [[nodiscard]] const SectionMesh& section() const { return section_; }
  [[nodiscard]] bool is_curved() const { return !section_.arcs.empty(); }

  [[nodiscard]] std::vector<Face> faces_of(const HeatBoundary& boundary) const;
  /// Faces of two boundaries that lie on each other.
  [[nodiscard]] std::vector<std::pair<Face, Face>> pairs_of(const HeatBoundary& first,
                                                            const HeatBoundary& second) const;
  /// Area of the surface that a face sweeps [m2], exact: a frustum or a piece of a torus.
  [[nodiscard]] double area(const Face& face) const;

  struct Place {
    Cell cell;
    dealii::Point<2> on_unit_cell;
  };
  /// The cell of a body that holds a point, or the one nearest to it. @throws SolverError if the body has none
  [[nodiscard]] Place locate(std::size_t body, double x, double r) const;

 private:
  using CoarseCell = dealii::Triangulation<2>::active_cell_iterator;
  /// Bends a side of a cell along its arc, and the sides that follow it inwards for as long as cells are so thin that it matters.
  void bend_from(CoarseCell cell, unsigned int face, std::size_t arc);
  void require_upright_cells() const;

  const SectionMesh section_;
  dealii::Triangulation<2> triangulation_;
  dealii::MappingQ<2> mapping_;
  dealii::FE_Q<2> fe_;
  dealii::DoFHandler<2> dofs_;
  std::vector<Cell> cells_;
  std::vector<Face> faces_;  ///< of the outline, in the order of the section's edges
};

/// Rectangles as a mesh: bodies' cells between the common grid lines.
SectionMesh mesh_of_rectangles(const HeatConductionProblem& problem);

}  // namespace rotordrop
