#pragma once
#include <span>
#include <vector>

#include "model/observable.h"
#include "model/oscillator.h"
#include "model/ports.h"
#include "model/state_layout.h"

namespace rotordrop {

/// Power dissipated by the rotor, or done on it as work [W].
template <class Real>
struct RotorPowerOf {
  Real damping = 0;         ///< dissipated by modal and mass-proportional damping
  Real unbalance_work = 0;  ///< done on the rotor by the unbalance forces (which have no reaction torque on the spin)
  Real drive_work = 0;      ///< done on the rotor by the motor or brake torque
  Real windage = 0;         ///< dissipated by the gas around the rotor
  Real spin_acceleration = 0;  ///< no power: rate of the spin speed [rad/s^2]
};
using RotorPower = RotorPowerOf<double>;

/// A rotor. Mass is inverted inside; stations were fixed when it was built. Keeps no copy of the state.
class RotorModel {
 public:
  RotorModel() = default;
  RotorModel(const RotorModel&) = delete;
  RotorModel& operator=(const RotorModel&) = delete;
  virtual ~RotorModel() = default;

  [[nodiscard]] virtual std::vector<StateEntry> state_entries() const = 0;
  [[nodiscard]] virtual std::size_t n_stations() const = 0;
  /// Motion of every station [n_stations]; depends on the state alone.
  virtual void motions(std::span<const double> y, std::span<Motion> out) const = 0;
  /// Motion of any node, numbered from 1; for what is recorded, not for rates.
  [[nodiscard]] virtual Motion node_motion(int node, std::span<const double> y) const = 0;
  [[nodiscard]] virtual Spin spin(std::span<const double> y) const = 0;
  /// Rates of the rotor's own states under the forces on the stations [n_stations].
  virtual RotorPower rates(double t, std::span<const double> y, std::span<const Force> force_on_station,
                           std::span<double> dydt) const = 0;
  /// Whether the gas around it brakes it; then rates() reports that power.
  [[nodiscard]] virtual bool has_windage() const { return false; }
  /// Those of its own states that would oscillate freely without forces on the stations, by their places in its own part of the state vector.
  [[nodiscard]] virtual std::vector<Oscillator> oscillators() const { return {}; }
  /// Known times at which its rates jump or bend over time [s], in any order: steps end there.
  [[nodiscard]] virtual std::vector<double> instants() const { return {}; }
  /// What it reports besides its spin; names are below /rotor/.
  [[nodiscard]] virtual std::vector<Observable> observables() const { return {}; }
  /// @param out  [sum of sizes of observables()]
  virtual void observe(std::span<const double>, std::span<double>) const {}
  /// Kinetic (with spin), elastic and gravitational energy [J]; gravity's zero is the undisplaced centre line.
  [[nodiscard]] virtual double energy(std::span<const double> y) const = 0;
};

}  // namespace rotordrop
