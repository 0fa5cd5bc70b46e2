#pragma once
// One pass over a machine, of one drop or of several side by side: motion and growth from states, then forces and heats, then rates.
#include <algorithm>
#include <span>

#include "machine/machine.h"

namespace rotordrop {

template <class Real>
void Machine::fit(EvaluationOf<Real>& e) const {
  if (e.inputs.size() != places_.size() || e.heats.size() != n_thermal_places()) {
    for (auto* list : {&e.growth, &e.growth_rate, &e.immediate_growth}) list->assign(n_thermal_places(), {});
    e.motions.resize(places_.size());
    e.inputs.assign(places_.size(), {});
    e.outputs.assign(places_.size(), {});
    e.forces.resize(places_.size());
    e.heats.assign(n_thermal_places(), {});
  }
  for (std::size_t i = 0; i < places_.size(); ++i)
    if (auto& rows = e.outputs[i].heat.rows; rows.size() != places_[i].n_rows) rows.resize(places_[i].n_rows);
}

template <class Real>
void add_growth(std::vector<ExpansionOf<Real>>& to, const std::vector<ExpansionOf<Real>>& from) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = combined(1., to[i], Real(1.), from[i]);
}

template <class Real, class PartsOf>
void Machine::prepare_inputs(const PartsOf& parts, const Real& t, std::span<const Real> y,
                             EvaluationOf<Real>& e) const {
  const auto of_rotor = y.subspan(0, n_rotor_);
  parts.rotor().motions(of_rotor, e.motions);
  const SpinOf<Real> spin = parts.rotor().spin(of_rotor);
  const auto block = [&](const ThermalBlock& b) { return y.subspan(b.state, b.n_state); };
  if (parts_.driver)
    parts.thermal(*parts_.driver).growth(block(thermal_[*parts_.driver]), e.growth);
  else
    parts.given_growth(t, e, e.growth);
  if (parts_.immediate_growth) {
    parts.immediate_growth().growth(block(immediate_), e.immediate_growth);
    add_growth(e.growth, e.immediate_growth);
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    auto& input = e.inputs[i];
    input.time = t;
    input.journal = e.motions[i];
    input.rotor_spin = spin;
    if (const auto place = parts_.thermal_place[i]) {
      input.growth = e.growth[*place];
      input.growth.shaft += parts.rotor_growth_by_speed(*place) * spin.speed * spin.speed;
      if (const auto& followed = parts_.friction_temperatures)
        input.ring_temperature = block(thermal_[followed->model])[followed->states[*place]];
    }
  }
}

template <class Real, class PartsOf>
void Machine::evaluate_with(const PartsOf& parts, const Real& t, std::span<const Real> y, std::span<Real> dydt,
                            EvaluationOf<Real>& e) const {
  fit(e);
  e.time = t;
  e.step.resize(e.wants_step ? n_step_ : 0);
  e.details.resize(e.wants_details ? n_detail_ : 0);
  prepare_inputs(parts, t, y, e);
  std::size_t step_at = 0, detail_at = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& p = places_[i];
    auto& out = e.outputs[i];
    out.observed = e.wants_step ? std::span(e.step).subspan(step_at, p.n_step) : std::span<Real>{};
    out.observed_details = e.wants_details ? std::span(e.details).subspan(detail_at, p.n_detail) : std::span<Real>{};
    step_at += p.n_step;
    detail_at += p.n_detail;
    parts.support(i).evaluate(e.inputs[i], y.subspan(p.state, p.n_state), dydt.subspan(p.state, p.n_state),
                              dydt.subspan(p.ledger + n_support_ledger, p.n_own), out);
    e.forces[i] = out.force_on_rotor;
    if (const auto place = parts_.thermal_place[i]) {
      auto& heat = e.heats[*place];
      heat = out.heat;
      heat.rub_into_ring =
          heat.rub * parts.rub_share(*place).to_ring(heat.rotor_surface_speed, heat.ring_surface_speed);
    }
  }
  if constexpr (!RealTraits<Real>::is_in_lanes)
    if (!e.step.empty() && !parts_.probes.empty()) observe_probes(y, std::span(e.step).subspan(step_at));
  for (std::size_t k = 0; k < thermal_.size(); ++k) {
    if (parts_.thermal[k].follows) continue;
    const auto T = y.subspan(thermal_[k].state, thermal_[k].n_state);
    const auto rates = dydt.subspan(thermal_[k].state, thermal_[k].n_state);
    dydt[thermal_[k].lost] = parts.thermal(k).rates(T, e.heats, rates);
    for (const auto& heated : heated_ports_)
      if (heated.model == k) parts.thermal(k).add_heat(heated.port, e.outputs[heated.support].heat_into_port, rates);
    if (parts_.driver == k) parts.thermal(k).growth_rates(rates, e.growth_rate);
  }
  if (!parts_.driver) parts.given_growth_rate(t, e, e.growth_rate);
  if (parts_.immediate_growth) {
    const auto rates = dydt.subspan(immediate_.state, immediate_.n_state);
    parts.immediate_growth().rates(y.subspan(immediate_.state, immediate_.n_state), e.heats, rates);
    parts.immediate_growth().growth_rates(rates, e.immediate_growth);
    add_growth(e.growth_rate, e.immediate_growth);
  }
  const RotorPowerOf<Real> power = parts.rotor().rates(t, y.subspan(0, n_rotor_), e.forces, dydt.subspan(0, n_rotor_));

  for (std::size_t i = 0; i < places_.size(); ++i) {
    const auto& out = e.outputs[i];
    const auto ledger = dydt.subspan(places_[i].ledger, n_support_ledger);
    ledger[rub_heat] = out.heat.rub;
    ledger[inner_heat] = out.heat.inner;
    ledger[outer_heat] = out.heat.outer;
    ledger[other_dissipation] = out.other_dissipation;
    const auto place = parts_.thermal_place[i];
    // The rotor's speed makes it grow against its contacts; the spin's balance does not feel that.
    const Real by_speed = place ? parts.rotor_growth_by_speed(*place) : Real(0.);
    ledger[prescribed_work] = out.prescribed_work + out.energy_gradient.shaft * by_speed * 2. *
                                                        e.inputs[i].rotor_spin.speed * power.spin_acceleration;
    ledger[rub_heat_into_ring] = place ? e.heats[*place].rub_into_ring : Real(0.);
    ledger[growth_work] = place ? out.energy_gradient.dot(e.growth_rate[*place]) : Real(0.);
    if (places_[i].heats_port) dydt[places_[i].port_ledger()] = out.heat_into_port;
    if (out.heat.rows.empty()) continue;
    const auto of_rows =
        dydt.subspan(places_[i].ledger + n_support_ledger + places_[i].n_own, 2 * out.heat.rows.size());
    for (std::size_t row = 0; row < out.heat.rows.size(); ++row) {
      of_rows[2 * row] = out.heat.rows[row].inner;
      of_rows[2 * row + 1] = out.heat.rows[row].outer;
    }
  }
  const auto machine_ledger = dydt.subspan(machine_ledger_, n_machine_ledger);
  machine_ledger[rotor_damping] = power.damping;
  machine_ledger[unbalance_work] = power.unbalance_work;
  machine_ledger[drive_work] = power.drive_work;
  if (parts_.rotor->has_windage()) dydt[windage_ledger_] = power.windage;
}

}  // namespace rotordrop
