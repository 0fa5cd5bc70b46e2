#pragma once
#include <span>
#include <string>
#include <vector>

#include "model/observable.h"
#include "model/ports.h"
#include "model/state_layout.h"

namespace rotordrop {

/// What a support sees: depends on states alone, never on forces (no feedthrough).
template <class Real>
struct SupportInputOf {
  Real time = 0;           ///< [s]
  MotionOf<Real> journal;  ///< of the rotor at the support's station
  SpinOf<Real> rotor_spin;
  ExpansionOf<Real> growth;
  Real ring_temperature = 0;  ///< mean of the inner ring [K]; 0 where no friction asks for it
};
using SupportInput = SupportInputOf<double>;

/// What a support returns from one evaluation.
template <class Real>
struct SupportOutputOf {
  ForceOf<Real> force_on_rotor;
  HeatInputOf<Real> heat;
  Real other_dissipation = 0;  ///< dissipated but not given to the thermal model: contact, ball and support damping [W]
  Real heat_into_port = 0;     ///< part of other_dissipation that enters Support::heat_port() [W]
  /// Power on the machine of everything that is prescribed [W]: motion of cages and waves, inertia of balls, growth by speed, magnets, circulatory stiffness.
  Real prescribed_work = 0;
  ExpansionOf<Real> energy_gradient;  ///< dU/d(growth) [N]: times the growth rate it is the work of thermal growth
  std::span<Real> observed;           ///< where to write the observables, in their order; empty: do not
  std::span<Real> observed_details;   ///< where to write the detailed (coarsely sampled) ones; empty: do not
};
using SupportOutput = SupportOutputOf<double>;

/// Holds the rotor at one station: touchdown bearing, linear spring-damper; later a magnet or a snubber.
class Support {
 public:
  Support() = default;
  Support(const Support&) = delete;
  Support& operator=(const Support&) = delete;
  virtual ~Support() = default;

  [[nodiscard]] virtual const std::string& name() const = 0;
  /// Where results hold what it observes.
  [[nodiscard]] virtual std::string results_path() const { return "/bearings/" + name(); }
  [[nodiscard]] virtual std::vector<StateEntry> state_entries() const = 0;
  /// Quadratures of this support's own, besides those that every machine keeps for it.
  [[nodiscard]] virtual std::vector<StateEntry> ledger_entries() const { return {}; }
  /// What evaluate() writes on request, in order; the detailed ones are many and sampled more coarsely.
  [[nodiscard]] virtual std::vector<Observable> observables() const = 0;
  [[nodiscard]] virtual std::vector<Observable> detailed_observables() const { return {}; }
  /// Place of the thermal models that SupportOutput::heat_into_port enters, by its name there: "bush", "TB1/housing"; empty: none. Of the models that run at
  /// least one must have it among its heat_ports(); it enters all that have.
  [[nodiscard]] virtual std::string heat_port() const { return {}; }
  /// Rows of balls whose heat evaluate() tells apart, in HeatInput::rows, which has their size; 0: none.
  [[nodiscard]] virtual std::size_t n_heated_rows() const { return 0; }
  /// Known times at which what evaluate() returns jumps or bends over time [s], in any order: steps end there. At such a time itself it returns what holds
  /// after it.
  [[nodiscard]] virtual std::vector<double> instants() const { return {}; }
  /// @param y [state_entries().size()] in static equilibrium without the rotor
  virtual void initial_state(std::span<double> y) const = 0;
  /// @param y, dydt        [state_entries().size()]
  /// @param ledger_rates   [ledger_entries().size()]
  virtual void evaluate(const SupportInput& input, std::span<const double> y, std::span<double> dydt,
                        std::span<double> ledger_rates, SupportOutput& out) const = 0;
  /// Kinetic, elastic and gravitational energy [J] of the support's bodies and of its contacts.
  [[nodiscard]] virtual double energy(const SupportInput& input, std::span<const double> y) const = 0;
};

}  // namespace rotordrop
