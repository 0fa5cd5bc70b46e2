#pragma once
#include <algorithm>
#include <span>

#include "machine/machine.h"

namespace rotordrop {

/// The machine's own parts, of one drop.
struct Machine::OwnParts {
  const Parts& parts;
  double mechanical_at_start = 0;  ///< energy, for the balance [J]
  [[nodiscard]] const RotorModel& rotor() const { return *parts.rotor; }
  [[nodiscard]] const Support& support(std::size_t i) const { return *parts.supports[i]; }
  [[nodiscard]] const ThermalModel& thermal(std::size_t i) const { return *parts.thermal[i].model; }
  [[nodiscard]] const ThermalModel& immediate_growth() const { return *parts.immediate_growth; }
  [[nodiscard]] const RubShare& rub_share(std::size_t place) const { return parts.rub_share[place]; }
  template <class Act>
  void with_thermal(std::size_t i, const Act& act) const {
    act(thermal(i));
  }
  [[nodiscard]] double initial_mechanical() const { return mechanical_at_start; }
  [[nodiscard]] double rotor_growth_by_speed(std::size_t place) const { return parts.rotor_growth_by_speed[place]; }
  /// Growth that is prescribed or comes from outside, and its rate; none: zeros.
  void given_growth(double t, const Evaluation& e, std::span<Expansion> out) const {
    if (const GrowthHistory* given = history(e))
      given->at(t, out);
    else
      std::fill(out.begin(), out.end(), Expansion{});
  }
  void given_growth_rate(double t, const Evaluation& e, std::span<Expansion> out) const {
    if (const GrowthHistory* given = history(e))
      given->rate(t, out);
    else
      std::fill(out.begin(), out.end(), Expansion{});
  }
  [[nodiscard]] const GrowthHistory* history(const Evaluation& e) const {
    return parts.takes_growth ? e.growth_in_force : parts.prescribed_growth.get();
  }
};

}  // namespace rotordrop
