#pragma once
#include <vector>

#include "model/thermo_elasticity.h"
#include "thermal/fe/elastic_operator.h"
#include "thermal/fe/solvers/linear_solver.h"

namespace rotordrop {

/// Joins the bodies. A closed fit makes two unknowns one, so that a jump u_second = u_first + offset holds exactly and the pressure is the
/// force that then keeps each body in balance; which nodes are closed is found by an active-set iteration. With u = C v + d,
///   C^T K C v = C^T (f - K d).
class ElasticStatics final : public ElasticSolver {
 public:
  explicit ElasticStatics(const ElasticProblem& problem);

  [[nodiscard]] std::size_t n_nodes() const override { return operator_.n_nodes(); }
  [[nodiscard]] std::vector<double> interpolate(
      const std::function<double(std::size_t, double, double)>& f) const override;
  void solve(std::span<const double> temperatures, double speed) override;
  [[nodiscard]] bool fits_changed() const override { return fits_changed_; }
  [[nodiscard]] AxialRadial displacement(std::size_t body, double x, double r) const override {
    return operator_.value(u_, body, x, r);
  }
  [[nodiscard]] AxialRadial mean_displacement(const std::vector<HeatBoundary>& boundaries) const override;
  [[nodiscard]] double output(std::size_t output) const override { return outputs_.at(output) * u_; }
  [[nodiscard]] FitState fit(std::size_t fit) const override;
  [[nodiscard]] Stress stress(std::size_t body, double x, double r) const override {
    return operator_.stress(u_, T_, body, x, r);
  }
  [[nodiscard]] SurfaceRange hoop_stress(const HeatBoundary& boundary) const override {
    return operator_.hoop_stress(u_, T_, boundary);
  }
  [[nodiscard]] ElasticInfluence influence(std::size_t output) const override;
  [[nodiscard]] ElasticInfluence pressure_influence(std::size_t fit) const override;
  [[nodiscard]] std::vector<ElasticInfluence> node_pressure_influences(std::size_t fit) const override;
  [[nodiscard]] FitOpenings openings(std::size_t fit) const override;
  [[nodiscard]] std::vector<double> node_shares(std::size_t fit) const override;
  [[nodiscard]] double difference(const ElasticFunction& f) const override { return operator_.difference(u_, f); }

 private:
  using Vector = ElasticOperator::Vector;
  /// Two unknowns that meet in a fit: closed, u[second] = u[first] + sign interference.
  struct Pair {
    std::size_t fit = 0;
    unsigned int first = 0, second = 0;
    double sign = 1;        ///< of the first's outward normal along the unknowns' axis
    bool is_normal = true;  ///< else along the surface, of a bonded fit
    bool is_closed = true;
  };
  struct Fit {
    std::vector<HeatMesh::Face> faces;  ///< of the first
    std::vector<std::size_t> pairs;     ///< normal ones, in the order of `nodes`
    std::vector<unsigned int> nodes;    ///< of the first
    Vector share;                       ///< integral of the nodes' functions [m2]
    double area = 0;
  };
  /// What is known of an unknown of the operator: offset, or offset + reduced unknown.
  struct Link {
    int reduced = -1;  ///< -1: known
    double offset = 0;
  };

  void find_pairs();
  void find_held();
  [[nodiscard]] double offset_of(const Pair& pair) const;  ///< u[second] - u[first] if closed
  [[nodiscard]] double gap(const Pair& pair) const;        ///< [m]; negative: they overlap
  /// Force [N] that presses the pair together, of internal minus external forces.
  [[nodiscard]] double press(const Pair& pair, const Vector& residual) const;
  void join();  ///< links, groups and factors for the pairs that are closed
  [[nodiscard]] Vector solve_joined(const Vector& load) const;  ///< K^-1 of the joined bodies, known unknowns zero
  [[nodiscard]] bool update_pairs(double force_slack);
  void centre(Vector& u) const;             ///< takes out the mean axial displacement of what is free
  void centre_functional(Vector& j) const;  ///< its transpose
  /// j . u + sum of q over pairs of their press
  [[nodiscard]] ElasticInfluence adjoint(const Vector& j, const std::vector<std::pair<std::size_t, double>>& q) const;

  const ElasticOperator operator_;
  std::vector<Vector> outputs_;
  std::vector<Pair> pairs_;
  std::vector<Fit> fits_;
  std::vector<bool> is_held_;  ///< by unknown
  std::vector<double> held_at_;
  std::vector<Link> links_;
  std::vector<std::vector<std::size_t>> free_groups_;  ///< bodies that move along the axis together
  dealii::SparsityPattern pattern_;
  dealii::SparseMatrix<double> joined_;
  std::unique_ptr<LinearSolver> inverse_;
  bool is_joined_ = false, fits_changed_ = false;
  std::vector<double> T_;
  Vector u_, load_, residual_;
};

}  // namespace rotordrop
