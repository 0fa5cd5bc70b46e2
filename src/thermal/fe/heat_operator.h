#pragma once
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_cartesian.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <functional>
#include <vector>

#include "model/heat_conduction.h"
#include "thermal/fe/grid_lines.h"

namespace rotordrop {

/// The problem in space: with test functions v and weight 2 pi r,
///   d/dt integral rho H(T) v = F(T, t)(v)
///   F(T, t)(v) = - integral k grad T . grad v - interfaces g (T_1 - T_2)(v_1 - v_2) - convections loss(T) v + fluxes q v + source v,
/// H the integral of c from the initial temperature. Bodies do not share unknowns. What is linear in T is kept as matrices, which act on
/// temperature differences, so that the absolute temperature costs no digits.
class HeatOperator {
 public:
  using Vector = dealii::Vector<double>;
  using Matrix = dealii::SparseMatrix<double>;

  explicit HeatOperator(const HeatConductionProblem& problem);

  [[nodiscard]] unsigned int size() const { return dofs_.n_dofs(); }
  [[nodiscard]] std::size_t n_cells() const { return triangulation_.n_active_cells(); }
  [[nodiscard]] const dealii::SparsityPattern& pattern() const { return pattern_; }
  /// No property depends on temperature, no convection is a power law: one Jacobian for all.
  [[nodiscard]] bool is_linear() const { return curved_cells_.empty() && power_faces_.empty(); }
  void initial_temperature(Vector& T) const;

  /// Fluxes keep, until the next call, the values that hold right after this time [s].
  void hold_fluxes_of(double time);
  /// out(v) = integral rho (H(T) - H(T_before)) v  [J]
  void enthalpy_difference(const Vector& T, const Vector& T_before, Vector& out) const;
  /// out(v) = F(T, t)(v)  [W]
  void heat_flow(const Vector& T, double t, Vector& out) const;
  /// out = d(enthalpy)/dT - scaled_step dF/dT
  void jacobian(const Vector& T, double scaled_step, Matrix& out) const;

  /// Held fluxes times their areas, the areas taken from the bodies' dimensions [W]; functions of place and time by quadrature.
  [[nodiscard]] double input_power(double t) const;
  [[nodiscard]] double lost_power(const Vector& T) const;                        ///< [W]
  [[nodiscard]] double stored_energy(const Vector& T, const Vector& T_0) const;  ///< [J], by quadrature of H

  [[nodiscard]] double temperature(const Vector& T, std::size_t body, double x, double r) const;
  [[nodiscard]] double mean_temperature(const Vector& T, const HeatBoundary& boundary) const;
  [[nodiscard]] double difference(const Vector& T, const std::function<double(std::size_t, double, double)>& f) const;

  /// Rise of a half space [K] under the largest held flux after this time [s], as long as it has not felt the body's other side: a scale.
  [[nodiscard]] double expected_rise(double duration) const;
  /// Time [s] in which heat crosses the thinnest cell, node to node.
  [[nodiscard]] double shortest_time() const;

 private:
  using Cell = dealii::DoFHandler<2>::active_cell_iterator;
  struct Face {
    Cell cell;
    unsigned int number = 0;
  };
  /// Of a cell with temperature-dependent properties, what its integrals need.
  struct CurvedCell {
    const HeatBody* body = nullptr;
    std::vector<unsigned int> dofs;
    std::vector<double> weights;  ///< 2 pi r times the quadrature's weight [n_points]
    double per_x = 0, per_r = 0;  ///< 1/size [1/m]
  };
  /// The same of a face with convection.
  struct FilmFace {
    const HeatConvection* law = nullptr;
    std::vector<unsigned int> dofs;                           ///< of the shape functions that do not vanish there
    std::vector<double> weights;                              ///< [n_points]
    const std::vector<std::vector<double>>* shape = nullptr;  ///< [n_points][n_dofs]
  };
  struct FluxLoad {
    const HeatFlux* flux = nullptr;
    std::vector<Face> faces;
    Vector unit;      ///< integral v
    double area = 0;  ///< [m2]
    double held = 0;  ///< [W/m2]
  };
  struct CellOfBody {
    std::vector<std::size_t> x, r;  ///< indices of the grid lines at which its cells begin
    std::size_t first_cell = 0;
  };

  void make_triangulation();
  void find_cells();
  void make_pattern();
  void prepare_curved_cells();
  [[nodiscard]] FilmFace film_face(const Face& face, const HeatConvection& law) const;
  void assemble_bodies();
  void assemble_interfaces();
  void assemble_boundaries();
  void add_functions(double t, Vector& out) const;

  [[nodiscard]] const HeatBody& body_of(const Cell& cell) const { return problem_.bodies[cell->material_id()]; }
  [[nodiscard]] std::vector<Face> faces_of(const HeatBoundary& boundary, bool free_part_only) const;
  [[nodiscard]] bool is_covered(const HeatBoundary& boundary, const dealii::Point<2>& centre) const;
  [[nodiscard]] double free_area(const HeatBoundary& boundary) const;
  [[nodiscard]] std::vector<std::pair<Face, Face>> pairs_of(const HeatInterface& interface) const;

  const HeatConductionProblem problem_;
  Grid grid_;
  dealii::Triangulation<2> triangulation_;
  dealii::MappingCartesian<2> mapping_;
  dealii::FE_Q<2> fe_;
  dealii::QGauss<2> cell_quadrature_;
  dealii::QGauss<1> face_quadrature_;
  dealii::DoFHandler<2> dofs_;
  std::vector<CellOfBody> layout_;
  std::vector<Cell> cells_;               ///< body after body, rows of rising x, r rising from row to row
  std::vector<CurvedCell> curved_cells_;  ///< of bodies whose k or c depends on temperature
  std::vector<std::vector<double>> shape_, shape_x_,
      shape_r_;  ///< [n_points][n_dofs] of curved cells, on the unit cell
  std::array<std::vector<std::vector<double>>, 4> face_shape_;
  std::array<std::vector<unsigned int>, 4> face_dofs_;
  std::vector<FilmFace> power_faces_, linear_faces_;
  std::vector<FluxLoad> loads_;
  dealii::SparsityPattern pattern_;
  Matrix capacity_, conductance_;  ///< of all that is linear
  Vector capacity_weights_;        ///< stored energy of linear bodies = weights . (T - T_0)
  Vector ambient_load_;            ///< coefficient (ambient - initial) v of linear convections
  mutable Vector scratch_;
};

}  // namespace rotordrop
