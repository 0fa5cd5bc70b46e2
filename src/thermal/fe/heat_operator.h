#pragma once
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "conduction/heat_equations.h"
#include "conduction/heat_sources.h"
#include "model/assembled_heat.h"
#include "model/heat_conduction.h"
#include "thermal/fe/curved_cells.h"
#include "thermal/fe/heat_mesh.h"
#include "thermal/fe/nonzero_rows.h"

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

  /// Unknowns: those of the mesh, then the nodes' temperatures.
  [[nodiscard]] unsigned int size() const { return n_field_ + static_cast<unsigned int>(problem_.nodes.size()); }
  [[nodiscard]] std::size_t n_cells() const { return mesh_.cells().size(); }
  [[nodiscard]] const HeatMesh& mesh() const { return mesh_; }
  [[nodiscard]] const HeatConductionProblem& problem() const { return problem_; }
  [[nodiscard]] const dealii::SparsityPattern& pattern() const { return pattern_; }
  /// No property depends on temperature, no convection is a power law: one Jacobian for all.
  [[nodiscard]] bool is_linear() const { return curved_.empty() && power_faces_.empty(); }
  /// No conductivity depends on temperature: the Jacobian is symmetric, and positive definite.
  [[nodiscard]] bool is_symmetric() const;
  void initial_temperature(Vector& T) const;

  /// Bodies and boundaries that are held at a temperature. An unknown that two of them share belongs to the first.
  [[nodiscard]] const std::vector<HeldUnknowns>& held() const { return held_; }

  [[nodiscard]] HeatSources& sources() { return sources_; }
  /// Whether no heat changes with time while the sources hold what they do.
  [[nodiscard]] bool is_steady() const;
  /// out(v) = integral rho (H(T) - H(T_before)) v  [J]
  void enthalpy_difference(const Vector& T, const Vector& T_before, Vector& out) const;
  /// out(v) = F(T, t)(v)  [W]
  void heat_flow(const Vector& T, double t, Vector& out) const;
  /// out = d(enthalpy)/dT - scaled_step dF/dT, rows and columns of held unknowns but for their diagonal left out
  void jacobian(const Vector& T, double scaled_step, HeatMatrix kind, Matrix& out) const;

  /// Held fluxes times their areas, the areas taken from the bodies' dimensions [W]; functions of place and time by quadrature.
  [[nodiscard]] double input_power(double t) const;
  [[nodiscard]] double lost_power(const Vector& T) const;  ///< [W]
  /// In words: the body or node that an unknown belongs to, and the flux or port that cools it, or else the one that cools most.
  [[nodiscard]] std::string part_of(std::size_t unknown) const;
  [[nodiscard]] std::string strongest_cooling(std::size_t unknown, double t) const;
  [[nodiscard]] double stored_energy(const Vector& T, const Vector& T_0) const;  ///< [J], by quadrature of H

  [[nodiscard]] HeatMean mean_at(std::size_t body, double x, double r) const;
  [[nodiscard]] HeatMean mean_over(const std::vector<HeatBoundary>& boundaries) const;               ///< by area
  [[nodiscard]] const HeatMean& mean_of_body(std::size_t body) const { return bodies_[body].mean; }  ///< by volume
  [[nodiscard]] const HeatMean& mean_of_port(std::size_t port) const { return ports_[port].mean; }
  /// All of it as plain data, if it is linear.
  [[nodiscard]] std::optional<AssembledHeat> assembled() const;

  // What a reduction needs; T = initial temperature + rise.
  [[nodiscard]] const Matrix& capacity() const { return capacity_; }
  [[nodiscard]] const Matrix& conductance() const { return conductance_; }
  /// out(v) = a watt into the port, spread over its area.
  [[nodiscard]] const Vector& port_weights(std::size_t port) const { return ports_[port].weights; }
  [[nodiscard]] double port_area(std::size_t port) const { return ports_[port].area; }
  [[nodiscard]] const std::string& port_name(std::size_t port) const { return ports_[port].name; }
  /// Weights of a mean over a body's volume, and the body's heat capacity [J/K].
  [[nodiscard]] const Vector& body_weights(std::size_t body) const { return bodies_[body].weights; }
  [[nodiscard]] double body_capacity(std::size_t body) const { return bodies_[body].capacity; }
  /// Body of an unknown of the mesh. Its weight in the body's mean may be none: on the axis quadratic elements have no volume.
  [[nodiscard]] std::size_t body_of_unknown(unsigned int unknown) const { return body_of_[unknown]; }
  [[nodiscard]] unsigned int n_field() const { return n_field_; }
  [[nodiscard]] unsigned int index_of_node(std::size_t node) const {
    return n_field_ + static_cast<unsigned int>(node);
  }
  /// Heat lost by linear convection and links [W] = weights . rise, if the surroundings have the initial temperature.
  [[nodiscard]] const Vector& loss_weights() const { return loss_weights_; }

  [[nodiscard]] double difference(const Vector& T, const std::function<double(std::size_t, double, double)>& f) const;

  /// Time [s] in which heat crosses the thinnest cell, node to node.
  [[nodiscard]] double shortest_time() const;

 private:
  using Cell = HeatMesh::Cell;
  using Face = HeatMesh::Face;
  /// Of a face with convection, what its integrals need.
  struct FilmFace {
    const HeatConvection* law = nullptr;
    std::vector<unsigned int> dofs;                           ///< of the shape functions that do not vanish there
    std::vector<double> weights;                              ///< [n_points]
    const std::vector<std::vector<double>>* shape = nullptr;  ///< [n_points][n_dofs]
  };
  struct FluxLoad {
    const HeatFlux* flux = nullptr;
    std::vector<Face> faces;
    Vector unit;                          ///< integral v
    double area = 0;                      ///< [m2]
    std::vector<Face> second_faces = {};  ///< of an interface: its other side
    [[nodiscard]] double part(bool is_second) const {
      if (!flux->second) return 1.;
      return is_second ? 1. - flux->resistance_beyond : flux->resistance_beyond;
    }
  };
  [[nodiscard]] FluxLoad flux_load(const HeatFlux& flux) const;
  /// f(faces, their part of the heat) for each side of a flux.
  static void on_sides(const FluxLoad& load, const auto& f) {
    f(load.faces, load.part(false));
    if (load.flux->second) f(load.second_faces, load.part(true));
  }
  struct Port {
    std::string name;
    Vector weights;      ///< integral v / area; sums to 1
    double area = 0;     ///< [m2]; 0 for a node
    HeatMean mean = {};  ///< of the weights
  };
  struct BodyMean {
    Vector weights;
    double capacity = 0;
    HeatMean mean = {};
  };

  void find_covered_edges();
  void make_ports();
  void make_pattern();
  void prepare_curved_cells();
  [[nodiscard]] FilmFace film_face(const Face& face, const HeatConvection& law) const;
  void assemble_bodies();
  void assemble_interfaces();
  void assemble_boundaries();
  void assemble_nodes_and_links();
  void find_held_unknowns();
  [[nodiscard]] HeatSources make_sources() const;
  void add_functions(double t, Vector& out) const;

  [[nodiscard]] const HeatBody& body_of(const Cell& cell) const { return problem_.bodies[cell->material_id()]; }
  [[nodiscard]] std::vector<Face> free_faces_of(const HeatBoundary& boundary) const;
  [[nodiscard]] std::vector<std::pair<unsigned int, double>> ends_of(const HeatLink& link) const;
  [[nodiscard]] Vector integral_over(const std::vector<Face>& faces) const;

  const HeatConductionProblem problem_;
  const HeatMesh mesh_;
  const dealii::FE_Q<2>& fe_;
  const dealii::MappingQ<2>& mapping_;
  dealii::QGauss<2> cell_quadrature_;
  dealii::QGauss<1> face_quadrature_;
  const std::vector<Cell>& cells_;
  const unsigned int n_field_;
  std::vector<bool> is_covered_;  ///< edges of the section that an interface covers
  CurvedCells curved_{{}};        ///< of bodies whose k or c depends on temperature
  std::array<std::vector<std::vector<double>>, 4> face_shape_;
  std::array<std::vector<unsigned int>, 4> face_dofs_;
  std::vector<FilmFace> power_faces_, linear_faces_;
  std::vector<FluxLoad> loads_;
  std::vector<Port> ports_;
  std::vector<HeldUnknowns> held_;
  std::vector<BodyMean> bodies_;
  std::vector<std::size_t> body_of_;  ///< [n_field_]
  dealii::SparsityPattern pattern_;
  Matrix capacity_, conductance_;  ///< of all that is linear
  NonzeroRows capacity_rows_, conductance_rows_;
  Vector capacity_weights_;  ///< stored energy of linear bodies = weights . (T - T_0)
  Vector loss_weights_;
  Vector ambient_load_;  ///< coefficient (ambient - initial) v of linear convections
  HeatSources sources_;
  mutable Vector scratch_;
};

}  // namespace rotordrop
