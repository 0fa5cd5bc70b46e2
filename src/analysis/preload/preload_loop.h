#pragma once
// The loop of thermal preload: temperatures -> growth -> ball loads -> friction heat -> temperatures.
#include <memory>
#include <vector>

#include "analysis/statics/running_bearing.h"
#include "model/ode_system.h"
#include "model/thermal_model.h"

namespace rotordrop {

/// One running bearing on a thermal model. Of the model's places only this one gets heat; rotor and ring touch. For one thread at a time.
class PreloadLoop {
 public:
  /// @param n_places, place  of the thermal model; @param ambient [K]
  PreloadLoop(std::shared_ptr<const ThermalModel> thermal, std::unique_ptr<RunningBearing> bearing,
              std::size_t n_places, std::size_t place, double ambient);

  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] const std::vector<StateEntry>& entries() const { return entries_; }
  [[nodiscard]] std::vector<double> cold() const;
  [[nodiscard]] Expansion growth(std::span<const double> T) const;
  /// @throws SolverError where the bearing has no rest
  [[nodiscard]] RunningState state(std::span<const double> T) const;
  [[nodiscard]] const RunningBearing& bearing() const { return *bearing_; }
  /// Rates [K/s] under a heat of the bearing [W]; returns what is lost to ambient [W].
  double rates(std::span<const double> T, double heat, std::span<double> dydt) const {
    return rates(T, heat, balls(T), dydt);
  }
  /// The same where it is known what the balls conduct.
  double rates(std::span<const double> T, double heat, const BallConduction& balls, std::span<double> dydt) const;
  [[nodiscard]] double stored_energy(std::span<const double> T) const { return thermal_->stored_energy(T); }
  /// Nodes in kelvin, contacts without mass among them.
  [[nodiscard]] const std::vector<Observable>& nodes() const { return nodes_; }
  [[nodiscard]] std::vector<double> node_temperatures(std::span<const double> T, double heat) const;
  [[nodiscard]] double highest_temperature(std::span<const double> T, double heat) const;
  /// d rates / dT [1/s] under a constant heat, row by row [size * size], by central differences. What rolling balls conduct changes with growth.
  /// @param is_rough  by differences of second order instead of fourth, as a search can do with
  [[nodiscard]] std::vector<double> jacobian(std::span<const double> T, double heat, bool is_rough = false) const;
  /// The same where balls conduct what they are told.
  [[nodiscard]] std::vector<double> jacobian_of_held_balls(std::span<const double> T, double heat,
                                                           const BallConduction& held) const;
  /// What rolling balls conduct; zeros of others.
  [[nodiscard]] BallConduction balls(std::span<const double> T) const;
  /// Steady temperatures under a heat, the ones that the bearing comes to from `start` (steady_temperatures.cpp). @throws SolverError
  [[nodiscard]] std::vector<double> steady(double heat, std::span<const double> start) const;
  /// Temperatures `T` become steady under a heat while the balls conduct what they are told: Newton's method, until the next step would be `accuracy` times the way so far or
  /// less. From cold the film of the housing has hardly any slope, and one step alone leads thousands of kelvin too far. @throws SolverError
  void relax(double heat, const BallConduction& held, double accuracy, std::vector<double>& T) const;

 private:
  [[nodiscard]] std::vector<HeatInput> inputs(double heat, const BallConduction& balls) const;

  std::shared_ptr<const ThermalModel> thermal_;
  std::unique_ptr<RunningBearing> bearing_;
  std::size_t n_places_, place_;
  double ambient_;
  std::vector<StateEntry> entries_;
  std::vector<Observable> observables_, nodes_;
  // The state of the call before: searches and time steps ask for the same one several times.
  mutable std::vector<double> last_T_;
  mutable RunningState last_;
};

/// The loop in time: temperatures, then the ledgers of heat made and lost [J].
class PreloadTransient final : public OdeSystem {
 public:
  explicit PreloadTransient(const PreloadLoop& loop);
  [[nodiscard]] const StateLayout& layout() const override { return layout_; }
  void initial_state(std::span<double> y) const override;
  void rhs(double t, std::span<const double> y, std::span<double> dydt) const override;
  [[nodiscard]] std::size_t first_quadrature() const override { return loop_.size(); }
  [[nodiscard]] std::span<const double> temperatures(std::span<const double> y) const { return y.first(loop_.size()); }

 private:
  const PreloadLoop& loop_;
  StateLayout layout_;
};

}  // namespace rotordrop
