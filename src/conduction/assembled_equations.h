#pragma once
#include <Eigen/SparseCore>

#include <memory>

#include "conduction/heat_equations.h"
#include "conduction/heat_sources.h"
#include "model/assembled_heat.h"
#include "model/heat_conduction.h"

namespace rotordrop {

struct OrderedMatrices;

/// A linear problem whose matrices are known: nothing is asked of finite elements any more. Inverses need it as long as they live.
class AssembledEquations final : public HeatEquations {
 public:
  /// @param problem  of which `assembled` was made but for the fluxes over time; both must outlive it
  AssembledEquations(const HeatConductionProblem& problem, const AssembledHeat& assembled);
  ~AssembledEquations() override;

  [[nodiscard]] Vector initial_temperature() const override;
  [[nodiscard]] bool is_linear() const override { return true; }
  [[nodiscard]] bool is_symmetric() const override { return true; }
  [[nodiscard]] const std::vector<HeldUnknowns>& held() const override { return assembled_.held; }
  void hold_fluxes_of(double time) override { sources_.hold_fluxes_of(time); }
  void hold_port_heat(std::span<const double> watts, std::span<const double> rates, double time) override {
    sources_.hold_port_heat(watts, rates, time);
  }
  [[nodiscard]] bool is_steady() const override { return sources_.is_steady(); }
  void enthalpy_difference(const Vector& T, const Vector& T_before, Vector& out) const override;
  void heat_flow(const Vector& T, double t, Vector& out) const override;
  [[nodiscard]] std::unique_ptr<HeatInverse> make_inverse() const override;
  [[nodiscard]] double input_power(double t) const override { return sources_.power(t); }
  [[nodiscard]] double lost_power(const Vector& T) const override;
  [[nodiscard]] double stored_energy(const Vector& T, const Vector& T_before) const override;
  [[nodiscard]] double expected_rise(double duration) const override { return sources_.expected_rise(duration); }
  [[nodiscard]] double shortest_time() const override { return assembled_.shortest_time; }
  [[nodiscard]] std::string part_of(std::size_t unknown) const override;
  [[nodiscard]] std::string strongest_cooling(std::size_t unknown, double t) const override;

 private:
  using Rows = Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>>;
  using List = Eigen::Map<const Eigen::VectorXd>;
  [[nodiscard]] Rows matrix(const std::vector<double>& values) const;
  static List list(const std::vector<double>& values) {
    return {values.data(), static_cast<Eigen::Index>(values.size())};
  }
  [[nodiscard]] double T_0() const { return problem_.initial_temperature; }

  const HeatConductionProblem& problem_;
  const AssembledHeat& assembled_;
  const Rows capacity_, conductance_;
  const double ambient_power_;  ///< [W] in while all is at T_0
  HeatSources sources_;
  mutable std::unique_ptr<const OrderedMatrices> ordered_;  ///< with the first inverse
};

}  // namespace rotordrop
