#pragma once
// What a machine reports of its state, of one drop or of several side by side.
#include <algorithm>
#include <span>
#include <vector>

#include "machine/machine.h"

namespace rotordrop {

template <class Real, class PartsOf>
Real Machine::mechanical_energy_of(const PartsOf& parts, std::span<const Real> y,
                                   std::span<const SupportInputOf<Real>> inputs) const {
  Real U = parts.rotor().energy(y.subspan(0, n_rotor_));
  for (std::size_t i = 0; i < places_.size(); ++i)
    U += parts.support(i).energy(inputs[i], y.subspan(places_[i].state, places_[i].n_state));
  return U;
}

template <class Real, class PartsOf>
EnergyBalanceOf<Real> Machine::energy_balance_of(const PartsOf& parts, std::span<const Real> y,
                                                 std::span<const SupportInputOf<Real>> inputs) const {
  EnergyBalanceOf<Real> b;
  b.mechanical = mechanical_energy_of(parts, y, inputs);
  for (const auto& place : places_) {
    const auto ledger = y.subspan(place.ledger, n_support_ledger);
    b.heat_deposited += ledger[rub_heat] + ledger[inner_heat] + ledger[outer_heat];
    b.dissipated += ledger[other_dissipation];
    b.prescribed_work += ledger[prescribed_work];
    b.growth_work += ledger[growth_work];
  }
  const auto ledger = y.subspan(machine_ledger_, n_machine_ledger);
  if (parts_.rotor->has_windage()) b.windage = y[windage_ledger_];
  b.dissipated += b.heat_deposited + ledger[rotor_damping] + b.windage;
  b.unbalance_work = ledger[unbalance_work];
  b.drive_work = ledger[drive_work];
  b.residual = parts.initial_mechanical() - b.mechanical - b.dissipated + b.growth_work + b.prescribed_work +
               b.unbalance_work + b.drive_work;
  b.heat.reserve(thermal_.size());
  for (std::size_t k = 0; k < thermal_.size(); ++k) {
    Real stored = 0.;
    parts.with_thermal(
        k, [&](const auto& model) { stored = model.stored_energy(y.subspan(thermal_[k].state, thermal_[k].n_state)); });
    const Real lost = y[thermal_[k].lost];
    Real deposited = b.heat_deposited;
    for (const auto& heated : heated_ports_)
      if (heated.model == k) deposited += y[places_[heated.support].port_ledger()];
    b.heat.push_back({stored, lost, deposited, deposited - stored - lost});
  }
  return b;
}

template <class Real, class PartsOf>
void Machine::observe_held_of(const PartsOf& parts, std::span<const Real> y, std::span<Real> out) const {
  const auto of_rotor = y.subspan(0, n_rotor_);
  const SpinOf<Real> spin = parts.rotor().spin(of_rotor);
  out[0] = spin.speed;
  out[1] = spin.angle;
  parts.rotor().observe(of_rotor, out.subspan(2, n_rotor_observed_));
  const auto ledgers = y.subspan(first_ledger_, n_ledger_);
  std::copy(ledgers.begin(), ledgers.end(), out.last(n_ledger_).begin());
}

template <class Real, class PartsOf>
void Machine::observe_state_of(const PartsOf& parts, std::span<const Real> y, const EvaluationOf<Real>& found,
                               std::span<Real> out) const {
  observe_held_of(parts, y, out);
  const auto temperatures = [&](std::size_t k) { return y.subspan(thermal_[k].state, thermal_[k].n_state); };
  std::size_t at = 2 + n_rotor_observed_;
  for (std::size_t k = 0; k < thermal_.size(); ++k) {
    const auto observed = out.subspan(at, thermal_[k].n_observed);
    parts.with_thermal(k, [&](const auto& model) { model.observe(temperatures(k), found.heats, observed); });
    at += thermal_[k].n_observed;
  }
  std::vector<ExpansionOf<Real>> growth(found.heats.size());
  for (std::size_t k = 0; k < thermal_.size(); ++k) {
    parts.with_thermal(k, [&](const auto& model) { model.growth(temperatures(k), growth); });
    for (const auto& place : parts_.thermal_place)
      if (place)
        for (const Real& value : growth_values(growth[*place])) out[at++] = value;
  }
  const auto b = energy_balance_of<Real>(parts, y, found.inputs);
  for (const Real& value : {b.mechanical, b.dissipated, b.growth_work, b.prescribed_work, b.unbalance_work,
                            b.drive_work, b.residual, b.heat_deposited})
    out[at++] = value;
  for (const auto& heat : b.heat)
    for (const Real& value : {heat.stored, heat.lost, heat.residual}) out[at++] = value;
}

}  // namespace rotordrop
