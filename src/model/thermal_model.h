#pragma once
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/row_tile.h"
#include "model/observable.h"
#include "model/ports.h"
#include "model/state_layout.h"

namespace rotordrop {

/// Temperatures of all places under their heat inputs. States are absolute temperatures [K].
class ThermalModel {
 public:
  ThermalModel() = default;
  ThermalModel(const ThermalModel&) = delete;
  ThermalModel& operator=(const ThermalModel&) = delete;
  virtual ~ThermalModel() = default;

  [[nodiscard]] virtual std::vector<StateEntry> state_entries() const = 0;
  virtual void initial_state(std::span<double> temperature) const = 0;
  /// Growth of every place [n_places] over ambient; depends on temperatures alone, linearly. That is tried once, when the machine is made.
  virtual void growth(std::span<const double> temperature, std::span<Expansion> out) const = 0;
  /// Growth rates [m/s] from temperature rates [K/s].
  virtual void growth_rates(std::span<const double> temperature_rate, std::span<Expansion> out) const = 0;
  /// Rates of the temperatures [K/s]; returns the heat lost to ambient [W].
  virtual double rates(std::span<const double> temperature, std::span<const HeatInput> heat,
                       std::span<double> dydt) const = 0;
  /// Whether it has advance(): then, where nothing depends on its temperatures, it can follow a drop step by step.
  [[nodiscard]] virtual bool can_follow() const { return false; }
  /// Temperatures after a step through which the heat stays as it is; what the model exchanges over balls and contacts counts with the temperatures
  /// at the beginning. @returns the heat lost to ambient [J]
  virtual double advance([[maybe_unused]] double step, [[maybe_unused]] std::span<const double> from,
                         [[maybe_unused]] std::span<const HeatInput> heat,
                         [[maybe_unused]] std::span<double> to) const {
    throw std::logic_error("this thermal model cannot follow");
  }
  /// Names of places that the heat of supports other than bearings can enter, "TB1/housing", each once; such heat is not among HeatInput.
  [[nodiscard]] virtual std::vector<std::string> heat_ports() const { return {}; }
  /// Adds to the rates of rates() what heat into one of these does; all of it is stored.
  /// @param port   index among heat_ports()
  /// @param watts  [W]
  virtual void add_heat([[maybe_unused]] std::size_t port, [[maybe_unused]] double watts,
                        [[maybe_unused]] std::span<double> dydt) const {}
  /// What observe() writes, in order; names such as "TB1/inner_ring" become dataset names. What is in kelvin is an absolute temperature.
  [[nodiscard]] virtual std::vector<Observable> observables() const = 0;
  virtual void observe(std::span<const double> temperature, std::span<const HeatInput> heat,
                       std::span<double> out) const = 0;
  /// States that are the mean temperatures of the inner rings [n_places]; empty if there are none such (ThermalKind::has_ring_states).
  [[nodiscard]] virtual std::vector<std::size_t> ring_states() const { return {}; }
  /// Heat stored since the start [J]: 0 at initial_state().
  [[nodiscard]] virtual double stored_energy(std::span<const double> temperature) const = 0;
  /// observe() of eight states side by side: each as if it were alone, but for roundoff.
  /// @param temperature, out  number i of state l at [i * RowTile::width + l]; @param heat  of one state after the other
  virtual void observe_tile(std::span<const double> temperature, std::span<const HeatInput> heat,
                            std::span<double> out) const {
    const std::size_t n_heats = heat.size() / RowTile::width;
    std::vector<double> T(temperature.size() / RowTile::width), values(out.size() / RowTile::width);
    for (std::size_t l = 0; l < RowTile::width; ++l) {
      for (std::size_t i = 0; i < T.size(); ++i) T[i] = temperature[i * RowTile::width + l];
      observe(T, heat.subspan(l * n_heats, n_heats), values);
      for (std::size_t i = 0; i < values.size(); ++i) out[i * RowTile::width + l] = values[i];
    }
  }
};

}  // namespace rotordrop
