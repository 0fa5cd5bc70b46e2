#pragma once
#include <string>
#include <vector>

#include "model/thermal_model.h"
#include "thermal/heating/bearing_heat.h"

namespace rotordrop {

/// Adiabatic rise of mean temperatures, before any heat is conducted away: inner ring, shaft, and outer ring with its housing rise by heat over heat
/// capacity. The part of a section's growth that follows the heat at once; the rest changes slowly.
struct AdiabaticSection {
  std::string name;                                                   ///< of the bearing
  double inner_capacity = 0, shaft_capacity = 0, outer_capacity = 0;  ///< outer: ring and housing [J/K]
  GrowthPerRise growth;
  /// @param inner, shaft, outer  heat given to them [J]; or [W], for a rate
  [[nodiscard]] Expansion growth_by(double inner, double shaft, double outer) const;
};

class AdiabaticRises final : public ThermalModel {
 public:
  AdiabaticRises(std::vector<AdiabaticSection> sections, double ambient);

  [[nodiscard]] std::vector<StateEntry> state_entries() const override;
  void initial_state(std::span<double> state) const override;
  void growth(std::span<const double> state, std::span<Expansion> out) const override;
  void growth_rates(std::span<const double> rate, std::span<Expansion> out) const override;
  double rates(std::span<const double> state, std::span<const HeatInput> heat, std::span<double> dydt) const override;
  [[nodiscard]] std::vector<Observable> observables() const override { return {}; }
  void observe(std::span<const double>, std::span<const HeatInput>, std::span<double>) const override {}
  [[nodiscard]] double stored_energy(std::span<const double> state) const override;

 private:
  std::vector<AdiabaticSection> sections_;
  double ambient_;
};

}  // namespace rotordrop
