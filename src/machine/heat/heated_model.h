#pragma once
#include <vector>

#include "model/ode_system.h"
#include "model/thermal_model.h"

namespace rotordrop {

/// A thermal model without a machine, one of its places heated as it is told:  y = [ states of the model | heat lost ].
/// Each state may be told in a unit of its own: y_k = z_k(0) + weight_k (z_k - z_k(0)). An integrator that asks for one accuracy of all y then asks for 1/weight_k of it in z_k.
class HeatedModel final : public OdeSystem {
 public:
  /// @param place    < n_places: the one that is heated
  /// @param weights  > 0, of the model's states; empty: 1
  HeatedModel(const ThermalModel& model, std::size_t n_places, std::size_t place, std::vector<double> weights = {});

  /// Heat at a time [W], and how it goes on from there [W/s], until the next call.
  void hold(double time, const HeatInput& heat, const HeatInput& rate);
  /// Heat into all places at a time, as rates() of the model take it.
  [[nodiscard]] const std::vector<HeatInput>& heats_at(double t) const;

  /// The model's own states z; valid until the next call or rhs().
  [[nodiscard]] std::span<const double> model_state(std::span<const double> y) const;

  [[nodiscard]] const StateLayout& layout() const override { return layout_; }
  void initial_state(std::span<double> y) const override;
  void rhs(double t, std::span<const double> y, std::span<double> dydt) const override;
  [[nodiscard]] std::size_t first_quadrature() const override { return layout_.size() - 1; }

 private:
  const ThermalModel& model_;
  StateLayout layout_;
  std::size_t place_;
  double since_ = 0;
  HeatInput heat_, rate_;
  std::vector<double> weights_, start_;  // of the model's states
  mutable std::vector<double> state_;
  mutable std::vector<HeatInput> heats_;  // of all places
};

}  // namespace rotordrop
