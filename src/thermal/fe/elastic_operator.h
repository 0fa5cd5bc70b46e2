#pragma once
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <vector>

#include "model/thermo_elasticity.h"
#include "thermal/fe/heat_mesh.h"

namespace rotordrop {

/// The elastic bodies in space, each for itself, with test functions v and weight 2 pi r:
///   integral sigma(u) : eps(v) = integral beta theta(T) div v + omega^2 centrifugal(v) + external(v),
///   beta = E/(1 - 2 nu),  theta = integral of alpha from the reference temperature to T,  div v = v_x,x + v_r,r + v_r/r.
/// Unknown 2 i + c is part c (0: x, 1: r) of node i of the mesh, whose temperature is unknown i of the heat problem: temperatures need no interpolation.
class ElasticOperator {
 public:
  using Vector = dealii::Vector<double>;
  using Matrix = dealii::SparseMatrix<double>;
  using Face = HeatMesh::Face;

  explicit ElasticOperator(const ElasticProblem& problem);

  [[nodiscard]] const ElasticProblem& problem() const { return problem_; }
  [[nodiscard]] const HeatMesh& mesh() const { return mesh_; }
  [[nodiscard]] unsigned int n_nodes() const { return n_nodes_; }
  [[nodiscard]] unsigned int size() const { return 2 * n_nodes_; }
  [[nodiscard]] const dealii::Point<2>& node(unsigned int i) const { return nodes_[i]; }
  [[nodiscard]] std::size_t body_of_node(unsigned int i) const { return body_of_node_[i]; }

  [[nodiscard]] const Matrix& stiffness() const { return stiffness_; }
  [[nodiscard]] const Vector& external_load() const { return external_; }
  [[nodiscard]] const Vector& centrifugal_load() const { return centrifugal_; }  ///< per (rad/s)^2
  /// Load of a temperature field [K] [>= n_nodes].
  [[nodiscard]] Vector thermal_load(std::span<const double> T) const;
  /// out_i = d(thermal load . w)/dT_i. @throws SolverError if an expansion coefficient depends on temperature
  [[nodiscard]] std::vector<double> transposed_thermal_load(const Vector& w) const;

  /// Weights [n_nodes] of a mean over the area of sides; over the length of the axis, where a solid body has its inner side.
  [[nodiscard]] Vector mean_weights(const std::vector<HeatBoundary>& boundaries) const;
  enum class Measure { area, length };
  /// Integral of the nodes' functions over faces [n_nodes]: all around [m2], or along their line in the half plane [m].
  [[nodiscard]] Vector integral_over(const std::vector<Face>& faces, Measure measure = Measure::area) const;
  /// Integral of a node's function over its body [m3] [n_nodes].
  [[nodiscard]] const Vector& volume_weights() const { return volume_; }
  /// Entries (i, j, integral N_i N_j) over faces.
  struct MassEntry {
    unsigned int i = 0, j = 0;
    double value = 0;
  };
  [[nodiscard]] std::vector<MassEntry> face_mass(const std::vector<Face>& faces) const;
  /// Nodes of a face.
  [[nodiscard]] std::vector<unsigned int> nodes_of(const Face& face) const;

  [[nodiscard]] AxialRadial value(const Vector& u, std::size_t body, double x, double r) const;
  [[nodiscard]] ElasticSolver::Stress stress(const Vector& u, std::span<const double> T, std::size_t body, double x,
                                             double r) const;
  [[nodiscard]] SurfaceRange hoop_stress(const Vector& u, std::span<const double> T, const HeatBoundary& side) const;
  [[nodiscard]] double difference(const Vector& u, const ElasticFunction& f) const;

 private:
  using Cell = HeatMesh::Cell;
  void find_nodes();
  void make_patterns();
  void assemble_bodies();
  void assemble_tractions();
  [[nodiscard]] double thermal_strain(const ElasticBody& body, double T) const;
  /// Of point q of prepared values in a cell.
  [[nodiscard]] ElasticSolver::Stress stress_at(const dealii::FEValuesBase<2>& fe, unsigned int q, const Cell& cell,
                                                const Vector& u, std::span<const double> T) const;

  const ElasticProblem problem_;
  const HeatMesh mesh_;
  const dealii::FE_Q<2>& fe_;
  const dealii::MappingQ<2>& mapping_;
  const unsigned int n_nodes_;
  dealii::QGauss<2> cell_quadrature_;
  dealii::QGauss<1> face_quadrature_;
  std::vector<dealii::Point<2>> nodes_;
  std::vector<std::size_t> body_of_node_;
  dealii::SparsityPattern pattern_, thermal_pattern_;
  Matrix stiffness_;
  Matrix thermal_;  ///< load per kelvin, of bodies with a constant alpha
  bool has_tables_ = false;
  Vector external_, centrifugal_, volume_;
};

}  // namespace rotordrop
