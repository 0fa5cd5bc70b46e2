#pragma once
#include <array>
#include <map>
#include <optional>

#include "model/heat_conduction.h"
#include "thermal/fe/heat_operator.h"
#include "thermal/fe/reduction.h"
#include "thermal/fe/solvers/linear_solver.h"
#include "thermal/fe/solvers/petsc_solver.h"

namespace rotordrop {

/// Steps the finite-element problem in time: a six-stage ESDIRK method of order 4 (stage order 2, L-stable, its last stage is the
/// new state), embedded order 3 for the error. All implicit stages share one matrix, factorised again only when the step changes
/// or, with temperature-dependent properties, when Newton's iteration slows down.
class HeatSolver final : public HeatConductionSolver {
 public:
  explicit HeatSolver(const HeatConductionProblem& problem);

  [[nodiscard]] double time() const override { return time_; }
  void advance_to(double time) override;
  [[nodiscard]] double temperature(std::size_t body, double x, double r) const override {
    return operator_.temperature(T_, body, x, r);
  }
  [[nodiscard]] double mean_temperature(const HeatBoundary& boundary) const override {
    return operator_.mean_temperature(T_, boundary);
  }
  [[nodiscard]] SurfaceRange surface(const std::vector<HeatBoundary>& boundaries) const override {
    return operator_.surface(T_, boundaries);
  }
  [[nodiscard]] double body_mean(std::size_t body) const override { return operator_.body_mean(T_, body); }
  [[nodiscard]] double body_capacity(std::size_t body) const override { return operator_.body_capacity(body); }
  [[nodiscard]] double port_temperature(std::size_t port) const override {
    return operator_.port_temperature(T_, port);
  }
  [[nodiscard]] double port_area(std::size_t port) const override { return operator_.port_area(port); }
  using HeatConductionSolver::set_port_heat;
  void set_port_heat(std::span<const double> watts, std::span<const double> rates) override;
  void advance_window(double step) override;
  [[nodiscard]] std::vector<double> field() const override { return {T_.begin(), T_.end()}; }
  void set_field(std::span<const double> temperatures, double time, double input, double lost) override;
  ReducedHeat reduce(const ReductionSettings& settings) override;
  void lift(std::span<const double> state, std::span<const double> watts, double time) override;
  [[nodiscard]] std::vector<double> project(std::span<const double> weights) const override;
  [[nodiscard]] const SectionMesh& section_mesh() const override { return operator_.mesh().section(); }
  void write_vtu(const std::string& file) const override;
  [[nodiscard]] bool on_any_rank(bool own) const override { return rotordrop::on_any_rank(own); }
  [[nodiscard]] HeatEnergy energy() const override { return {input_, operator_.stored_energy(T_, T_0_), lost_}; }
  [[nodiscard]] HeatStatistics statistics() const override { return statistics_; }
  [[nodiscard]] double difference(const std::function<double(std::size_t, double, double)>& f) const override {
    return operator_.difference(T_, f);
  }

 private:
  using Vector = HeatOperator::Vector;
  static constexpr std::size_t n_stages = 6;

  void integrate_to(double stop);
  void integrate_fixed(double stop);
  [[nodiscard]] double next_change() const;
  /// Computes the stages of a step; false if Newton's iteration fails.
  [[nodiscard]] bool compute_stages(double step);
  [[nodiscard]] bool solve_stage(std::size_t i, double step);
  [[nodiscard]] double estimate_error(double step);  ///< [K], largest of all nodes
  void accept(double step);
  /// @throws SolverError if a temperature is not above 0 K, with what cools there
  void require_above_zero(const Vector& T, double time) const;
  void jump_to_held_temperatures();
  void book(double joules_through_boundary);
  /// Heat that held boundaries took up or gave off while the field went from `before` to `after`.
  /// @param flow_joules  integral of the heat flow over the step, by the method's weights [J]
  void book_held_boundaries(const Vector& before, const Vector& after, const Vector& flow_joules);
  void factorise(double step, const Vector& T);
  [[nodiscard]] std::unique_ptr<LinearSolver> new_linear_solver() const {
    return make_linear_solver(statistics_.solver, operator_.is_symmetric());
  }
  void advance_parts_of_window(double step, int most_parts);
  [[nodiscard]] bool step_window(double step);
  [[nodiscard]] bool solve_window_stage(double step, double t, Vector& T, Vector& flow);

  HeatOperator operator_;
  const HeatNumerics numerics_;
  std::vector<double> changes_;  ///< times at which a flux changes, rising
  double smallest_scale_ = 0;    ///< [K]
  double time_ = 0, step_ = 0;   ///< step_: wanted next
  bool must_restart_ = true;     ///< an input has changed
  double input_ = 0, lost_ = 0;  ///< [J]
  double scale_ = 0;             ///< [K] of errors, in this step
  Vector T_, T_0_;
  std::array<Vector, n_stages> stage_, flow_;
  Vector known_, residual_;
  dealii::SparseMatrix<double> matrix_;
  std::unique_ptr<LinearSolver> inverse_;
  double factorised_step_ = 0;
  bool is_stale_ = false;  ///< the matrix belongs to temperatures too far away
  HeatStatistics statistics_;
  std::map<double, std::unique_ptr<LinearSolver>> window_inverse_;  ///< by step
  std::optional<Reduction> reduction_;
};

}  // namespace rotordrop
