#pragma once
#include <optional>

#include "conduction/heat_stepper.h"
#include "model/heat_conduction.h"
#include "thermal/fe/heat_operator.h"
#include "thermal/fe/operator_equations.h"
#include "thermal/fe/reduction.h"
#include "thermal/fe/solvers/petsc_solver.h"

namespace rotordrop {

/// The finite-element problem, stepped in time, and what is asked of its field.
class HeatSolver final : public HeatConductionSolver {
 public:
  explicit HeatSolver(const HeatConductionProblem& problem);

  [[nodiscard]] double time() const override { return stepper_.time(); }
  void advance_to(double time) override;
  void ask_between_steps(std::function<void()> ask) override { stepper_.ask_between_steps(std::move(ask)); }
  [[nodiscard]] double temperature(std::size_t body, double x, double r) const override {
    return value(operator_.mean_at(body, x, r));
  }
  [[nodiscard]] double mean_temperature(const HeatBoundary& boundary) const override {
    return value(operator_.mean_over({boundary}));
  }
  [[nodiscard]] SurfaceRange surface(const std::vector<HeatBoundary>& boundaries) const override;
  [[nodiscard]] double body_mean(std::size_t body) const override { return value(operator_.mean_of_body(body)); }
  [[nodiscard]] double body_capacity(std::size_t body) const override { return operator_.body_capacity(body); }
  [[nodiscard]] double port_temperature(std::size_t port) const override { return value(operator_.mean_of_port(port)); }
  [[nodiscard]] double port_area(std::size_t port) const override { return operator_.port_area(port); }
  using HeatConductionSolver::set_port_heat;
  void set_port_heat(std::span<const double> watts, std::span<const double> rates) override {
    stepper_.set_port_heat(watts, rates);
  }
  void advance_window(double step) override { stepper_.advance_window(step); }
  [[nodiscard]] std::vector<double> field() const override {
    return {stepper_.field().begin(), stepper_.field().end()};
  }
  void set_field(std::span<const double> temperatures, double time, double input, double lost) override {
    stepper_.set_field(temperatures, time, input, lost);
  }
  ReducedHeat reduce(const ReductionSettings& settings) override;
  void lift(std::span<const double> state, std::span<const double> watts, double time) override;
  [[nodiscard]] std::vector<double> project(std::span<const double> weights) const override;
  [[nodiscard]] const SectionMesh& section_mesh() const override { return operator_.mesh().section(); }
  void write_vtu(const std::string& file) const override;
  [[nodiscard]] bool on_any_rank(bool own) const override { return rotordrop::on_any_rank(own); }
  [[nodiscard]] HeatEnergy energy() const override { return stepper_.energy(); }
  [[nodiscard]] HeatStatistics statistics() const override;
  [[nodiscard]] double difference(const std::function<double(std::size_t, double, double)>& f) const override;
  [[nodiscard]] std::optional<AssembledHeat> assembled() const override;
  [[nodiscard]] HeatMean mean_at(std::size_t body, double x, double r) const override {
    return operator_.mean_at(body, x, r);
  }
  [[nodiscard]] HeatMean mean_over(const std::vector<HeatBoundary>& boundaries) const override {
    return operator_.mean_over(boundaries);
  }

 private:
  [[nodiscard]] double value(const HeatMean& mean) const {
    return mean.of(stepper_.field(), operator_.problem().initial_temperature);
  }
  [[nodiscard]] HeatOperator::Vector temperatures() const;

  HeatOperator operator_;
  const HeatLinearSolver solver_;  ///< that was chosen
  OperatorEquations equations_;
  HeatStepper stepper_;
  std::optional<Reduction> reduction_;
};

}  // namespace rotordrop
