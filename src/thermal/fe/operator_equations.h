#pragma once
#include "conduction/heat_equations.h"
#include "thermal/fe/heat_operator.h"

namespace rotordrop {

/// The heat operator as what is stepped: its matrices by deal.II, its factors by the solver that was chosen.
class OperatorEquations final : public HeatEquations {
 public:
  /// @param problem  in space; must outlive it
  OperatorEquations(HeatOperator& problem, HeatLinearSolver solver) : operator_(problem), solver_(solver) {}

  [[nodiscard]] Vector initial_temperature() const override;
  [[nodiscard]] bool is_linear() const override { return operator_.is_linear(); }
  [[nodiscard]] bool is_symmetric() const override { return operator_.is_symmetric(); }
  [[nodiscard]] const std::vector<HeldUnknowns>& held() const override { return operator_.held(); }
  void hold_fluxes_of(double time) override { operator_.sources().hold_fluxes_of(time); }
  void hold_port_heat(std::span<const double> watts, std::span<const double> rates, double time) override {
    operator_.sources().hold_port_heat(watts, rates, time);
  }
  [[nodiscard]] bool is_steady() const override { return operator_.is_steady(); }
  void enthalpy_difference(const Vector& T, const Vector& T_before, Vector& out) const override;
  void heat_flow(const Vector& T, double t, Vector& out) const override;
  [[nodiscard]] std::unique_ptr<HeatInverse> make_inverse() const override;
  [[nodiscard]] double input_power(double t) const override { return operator_.input_power(t); }
  [[nodiscard]] double lost_power(const Vector& T) const override;
  [[nodiscard]] double stored_energy(const Vector& T, const Vector& T_before) const override;
  [[nodiscard]] double expected_rise(double duration) const override {
    return operator_.sources().expected_rise(duration);
  }
  [[nodiscard]] double shortest_time() const override { return operator_.shortest_time(); }
  [[nodiscard]] std::string part_of(std::size_t unknown) const override { return operator_.part_of(unknown); }
  [[nodiscard]] std::string strongest_cooling(std::size_t unknown, double t) const override {
    return operator_.strongest_cooling(unknown, t);
  }

 private:
  HeatOperator& operator_;
  HeatLinearSolver solver_;
  mutable HeatOperator::Vector T_, T_before_, out_;
};

/// Entries of one kind of vector as the other.
void copy_to(const Eigen::VectorXd& from, dealii::Vector<double>& to);
void copy_to(const dealii::Vector<double>& from, Eigen::VectorXd& to);

}  // namespace rotordrop
