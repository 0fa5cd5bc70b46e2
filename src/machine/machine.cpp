#include "machine/machine.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rotordrop {
namespace {

void add(std::vector<Expansion>& to, const std::vector<Expansion>& from) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = combined(1., to[i], 1., from[i]);
}

}  // namespace

Machine::Machine(Parts parts) : parts_(std::move(parts)) {
  const std::size_t n = parts_.supports.size();
  if (parts_.rotor->n_stations() != n || parts_.thermal_place.size() != n)
    throw std::invalid_argument("a machine needs one rotor station and one thermal place (or none) per support");

  layout_.add_block("rotor", parts_.rotor->state_entries());
  n_rotor_ = layout_.size();
  places_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    places_[i].state = layout_.size();
    const auto entries = parts_.supports[i]->state_entries();
    places_[i].n_state = entries.size();
    layout_.add_block(parts_.supports[i]->name(), entries);
  }
  for (const auto& part : parts_.thermal) {
    const std::size_t start = layout_.size();
    layout_.add_block(part.name == "lumped" ? "temperature" : part.name + " temperature", part.model->state_entries());
    thermal_.push_back({start, layout_.size() - start, 0});
  }
  if (parts_.immediate_growth) {
    immediate_.state = layout_.size();
    layout_.add_block("windows", parts_.immediate_growth->state_entries());
    immediate_.n_state = layout_.size() - immediate_.state;
  }
  first_ledger_ = layout_.size();
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<StateEntry> entries = {
        {"rub heat", "J", 100., "friction heat of rotor and inner ring"},
        {"rub heat into ring", "J", 100., "part of the rub heat that enters the inner ring"},
        {"inner heat", "J", 10., "friction heat of balls and inner race"},
        {"outer heat", "J", 10., "friction heat of balls and outer race"},
        {"other dissipation", "J", 1., "energy dissipated by damping, which heats nothing here"},
        {"prescribed work", "J", 1., "work of prescribed cage and waviness motion on the machine"},
        {"growth work", "J", 1., "work of thermal growth on the machine"}};
    const auto own = parts_.supports[i]->ledger_entries();
    entries.insert(entries.end(), own.begin(), own.end());
    places_[i].ledger = layout_.size();
    places_[i].n_own = own.size();
    places_[i].n_rows = parts_.supports[i]->n_heated_rows();
    for (std::size_t row = 1; row <= places_[i].n_rows; ++row)
      for (const std::string race : {"inner", "outer"})
        entries.push_back({"row " + std::to_string(row) + " " + race + " heat", "J", 10.,
                           "friction heat of the balls of row " + std::to_string(row) + " and " + race + " race"});
    layout_.add_block(parts_.supports[i]->name() + " ledger", entries);
  }
  machine_ledger_ = layout_.size();
  std::vector<StateEntry> entries = {{"rotor damping", "J", 1., "energy dissipated by the rotor's damping"},
                                     {"unbalance work", "J", 1., "work of the unbalance forces on the rotor"},
                                     {"drive work", "J", 1., "work of motor or brake on the rotor"}};
  for (const auto& part : parts_.thermal)
    entries.push_back(part.name == "lumped" ? StateEntry{"heat lost", "J", 1., "heat lost to ambient"}
                                            : StateEntry{part.name + " heat lost", "J", 1.,
                                                         "heat lost to ambient by model " + part.name});
  if (parts_.rotor->has_windage())
    entries.push_back({"windage", "J", 100., "energy dissipated by the gas around the rotor, which warms no bearing"});
  n_machine_ledger_ = entries.size();
  layout_.add_block("energy", entries);

  for (std::size_t i = 0; i < n; ++i)
    if (const auto place = parts_.thermal_place[i]) {
      ledger_of_place_.resize(std::max(ledger_of_place_.size(), *place + 1));
      ledger_of_place_[*place] = {places_[i].ledger, places_[i].ledger + n_support_ledger + places_[i].n_own,
                                  places_[i].n_rows};
    }
  const std::size_t n_places = ledger_of_place_.size();
  if (parts_.rub_share.size() != n_places)
    throw std::invalid_argument("a machine needs one share of the rub heat per thermal place");
  if (parts_.rotor_growth_by_speed.empty()) parts_.rotor_growth_by_speed.assign(n_places, 0.);
  if (parts_.rotor_growth_by_speed.size() != n_places)
    throw std::invalid_argument("a machine needs the rotor's growth by speed at every thermal place, or at none");
  list_observables();
  n_step_ = observed_size(step_observables_);
  n_detail_ = observed_size(detail_observables_);

  std::vector<double> y(layout_.size());
  initial_state(y);
  initial_mechanical_ = mechanical_energy(0., y);
}

void Machine::list_observables() {
  const auto add = [](std::vector<Observable>& list, const std::string& prefix, const std::vector<Observable>& more,
                      const std::string& place = {}) {
    std::size_t size = 0;
    for (Observable o : more) {
      o.name = prefix + o.name;
      if (o.place.empty()) o.place = place;
      size += o.size;
      list.push_back(std::move(o));
    }
    return size;
  };
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const auto& support = *parts_.supports[i];
    const std::string prefix = support.results_path() + "/";
    places_[i].n_step = add(step_observables_, prefix, support.observables(), support.name());
    places_[i].n_detail = add(detail_observables_, prefix, support.detailed_observables(), support.name());
  }
  for (const Probe& probe : parts_.probes)
    add(step_observables_, "/probes/" + probe.name + "/",
        {{"position", "m", "rotor centre at the probe, from the unloaded outer rings' axis", 2, {"y", "z"}},
         {"clearance", "m", "radial clearance left at the probe; negative: the rotor is beyond it", 1, {}}});
  add(state_observables_, "/rotor/",
      {{"spin_speed", "rad/s", "spin speed of the rotor", 1, {}},
       {"spin_angle", "rad", "spin angle of the rotor", 1, {}}});
  for (std::size_t i = 0; i < thermal_.size(); ++i) {
    auto observables = parts_.thermal[i].model->observables();
    for (auto& o : observables)
      if (o.unit == "K" && o.kind == Observed::other) o.kind = Observed::temperature;
    thermal_[i].n_observed = add(state_observables_, parts_.thermal[i].place, observables);
  }
  for (const auto& part : parts_.thermal)
    for (std::size_t i = 0; i < places_.size(); ++i)
      if (parts_.thermal_place[i])
        add(state_observables_, "/growth/" + part.name + "/",
            {growth_observable(parts_.supports[i]->name(), "thermal growth by model " + part.name)});
  add(state_observables_, "/energy/",
      {{"mechanical", "J", "kinetic, elastic and gravitational energy", 1, {}},
       {"dissipated", "J", "mechanical energy dissipated since the start", 1, {}, Observed::energy_moved},
       {"growth_work", "J", "work of thermal growth on the machine", 1, {}, Observed::energy_moved},
       {"prescribed_work",
        "J",
        "work of prescribed cage and waviness motion on the machine",
        1,
        {},
        Observed::energy_moved},
       {"unbalance_work", "J", "work of the unbalance forces on the rotor", 1, {}, Observed::energy_moved},
       {"drive_work", "J", "work of motor or brake on the rotor", 1, {}, Observed::energy_moved},
       {"residual", "J", "mechanical energy not accounted for", 1, {}, Observed::energy_residual},
       {"heat_deposited", "J", "heat given to each thermal model since the start", 1, {}, Observed::heat_deposited}});
  for (const auto& part : parts_.thermal) {
    const bool is_lumped = part.name == "lumped";
    const std::string prefix = is_lumped ? "" : part.name + "_", of = is_lumped ? "" : " by model " + part.name;
    add(state_observables_, "/energy/",
        {{prefix + "heat_stored", "J", "heat stored over ambient" + of, 1, {}},
         {prefix + "heat_lost", "J", "heat lost to ambient since the start" + of, 1, {}},
         {prefix + "heat_residual", "J", "heat not accounted for" + of, 1, {}, Observed::heat_residual, part.name}});
  }
  for (std::size_t i = first_ledger_; i < layout_.size(); ++i) {
    const auto& entry = layout_.entries()[i];
    // "TB1 ledger/rub heat" becomes /ledger/TB1/rub_heat, "energy/heat lost" /ledger/heat_lost.
    std::string path = entry.name;
    if (const auto at = path.find(" ledger/"); at != std::string::npos)
      path.erase(at, 7);
    else
      path.erase(0, path.find('/') + 1);
    std::replace(path.begin(), path.end(), ' ', '_');
    Observable o{"/ledger/" + path, entry.unit, entry.long_name, 1, {}};
    state_observables_.push_back(std::move(o));
  }
}

void Machine::initial_state(std::span<double> y) const {
  std::fill(y.begin(), y.end(), 0.);
  std::copy(parts_.initial_rotor_state.begin(), parts_.initial_rotor_state.end(), y.begin());
  for (std::size_t i = 0; i < places_.size(); ++i)
    parts_.supports[i]->initial_state(y.subspan(places_[i].state, places_[i].n_state));
  for (std::size_t i = 0; i < thermal_.size(); ++i)
    parts_.thermal[i].model->initial_state(y.subspan(thermal_[i].state, thermal_[i].n_state));
  if (parts_.immediate_growth) parts_.immediate_growth->initial_state(y.subspan(immediate_.state, immediate_.n_state));
}

void Machine::fit(Evaluation& e) const {
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

void Machine::prepare_inputs(double t, std::span<const double> y, Evaluation& e) const {
  parts_.rotor->motions(rotor_part(y), e.motions);
  const Spin spin = parts_.rotor->spin(rotor_part(y));
  if (parts_.driver)
    parts_.thermal[*parts_.driver].model->growth(driver_part(y), e.growth);
  else if (const GrowthHistory* given = given_growth(e))
    given->at(t, e.growth);
  else
    std::fill(e.growth.begin(), e.growth.end(), Expansion{});
  if (parts_.immediate_growth) {
    parts_.immediate_growth->growth(y.subspan(immediate_.state, immediate_.n_state), e.immediate_growth);
    add(e.growth, e.immediate_growth);
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    auto& input = e.inputs[i];
    input.time = t;
    input.journal = e.motions[i];
    input.rotor_spin = spin;
    if (const auto place = parts_.thermal_place[i]) {
      input.growth = e.growth[*place];
      input.growth.shaft += parts_.rotor_growth_by_speed[*place] * spin.speed * spin.speed;
      if (const auto& followed = parts_.friction_temperatures)
        input.ring_temperature = thermal_part(followed->model, y)[followed->states[*place]];
    }
  }
}

void Machine::observe_probes(std::span<const double> y, std::span<double> out) const {
  std::size_t at = 0;
  for (const Probe& probe : parts_.probes) {
    const Motion motion = parts_.rotor->node_motion(probe.node, rotor_part(y));
    out[at++] = motion.y;
    out[at++] = motion.z;
    out[at++] = probe.clearance - std::hypot(motion.y - probe.centre[0], motion.z - probe.centre[1]);
  }
}

void Machine::evaluate(double t, std::span<const double> y, Evaluation& found) const {
  found.rates.resize(layout_.size());
  evaluate(t, y, found.rates, found);
}

void Machine::rhs(double t, std::span<const double> y, std::span<double> rates) const {
  Evaluation found;
  evaluate(t, y, rates, found);
}

void Machine::evaluate(double t, std::span<const double> y, std::span<double> dydt, Evaluation& e) const {
  fit(e);
  e.time = t;
  e.step.resize(e.wants_step ? n_step_ : 0);
  e.details.resize(e.wants_details ? n_detail_ : 0);
  prepare_inputs(t, y, e);
  std::size_t step_at = 0, detail_at = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& p = places_[i];
    auto& out = e.outputs[i];
    out.observed = e.wants_step ? std::span(e.step).subspan(step_at, p.n_step) : std::span<double>{};
    out.observed_details = e.wants_details ? std::span(e.details).subspan(detail_at, p.n_detail) : std::span<double>{};
    step_at += p.n_step;
    detail_at += p.n_detail;
    parts_.supports[i]->evaluate(e.inputs[i], y.subspan(p.state, p.n_state), dydt.subspan(p.state, p.n_state),
                                 dydt.subspan(p.ledger + n_support_ledger, p.n_own), out);
    e.forces[i] = out.force_on_rotor;
    if (const auto place = parts_.thermal_place[i]) {
      auto& heat = e.heats[*place];
      heat = out.heat;
      heat.rub_into_ring =
          heat.rub * parts_.rub_share[*place].to_ring(heat.rotor_surface_speed, heat.ring_surface_speed);
    }
  }
  if (!e.step.empty() && !parts_.probes.empty()) observe_probes(y, std::span(e.step).subspan(step_at));
  const auto machine_ledger = dydt.subspan(machine_ledger_, n_machine_ledger_);
  for (std::size_t k = 0; k < thermal_.size(); ++k) {
    const auto rates = dydt.subspan(thermal_[k].state, thermal_[k].n_state);
    machine_ledger[heat_lost + k] = parts_.thermal[k].model->rates(thermal_part(k, y), e.heats, rates);
    if (parts_.driver == k) parts_.thermal[k].model->growth_rates(rates, e.growth_rate);
  }
  if (!parts_.driver) {
    if (const GrowthHistory* given = given_growth(e))
      given->rate(t, e.growth_rate);
    else
      std::fill(e.growth_rate.begin(), e.growth_rate.end(), Expansion{});
  }
  if (parts_.immediate_growth) {
    const auto rates = dydt.subspan(immediate_.state, immediate_.n_state);
    parts_.immediate_growth->rates(y.subspan(immediate_.state, immediate_.n_state), e.heats, rates);
    parts_.immediate_growth->growth_rates(rates, e.immediate_growth);
    add(e.growth_rate, e.immediate_growth);
  }
  const RotorPower power = parts_.rotor->rates(t, rotor_part(y), e.forces, dydt.subspan(0, n_rotor_));

  for (std::size_t i = 0; i < places_.size(); ++i) {
    const auto& out = e.outputs[i];
    const auto ledger = dydt.subspan(places_[i].ledger, n_support_ledger);
    ledger[rub_heat] = out.heat.rub;
    ledger[inner_heat] = out.heat.inner;
    ledger[outer_heat] = out.heat.outer;
    ledger[other_dissipation] = out.other_dissipation;
    const auto place = parts_.thermal_place[i];
    // The rotor's speed makes it grow against its contacts; the spin's balance does not feel that.
    const double by_speed = place ? parts_.rotor_growth_by_speed[*place] : 0.;
    ledger[prescribed_work] = out.prescribed_work + out.energy_gradient.shaft * by_speed * 2. *
                                                        e.inputs[i].rotor_spin.speed * power.spin_acceleration;
    ledger[rub_heat_into_ring] = place ? e.heats[*place].rub_into_ring : 0.;
    ledger[growth_work] = place ? out.energy_gradient.dot(e.growth_rate[*place]) : 0.;
    if (out.heat.rows.empty()) continue;
    const auto of_rows =
        dydt.subspan(places_[i].ledger + n_support_ledger + places_[i].n_own, 2 * out.heat.rows.size());
    for (std::size_t row = 0; row < out.heat.rows.size(); ++row) {
      of_rows[2 * row] = out.heat.rows[row].inner;
      of_rows[2 * row + 1] = out.heat.rows[row].outer;
    }
  }
  machine_ledger[rotor_damping] = power.damping;
  machine_ledger[unbalance_work] = power.unbalance_work;
  machine_ledger[drive_work] = power.drive_work;
  if (parts_.rotor->has_windage()) machine_ledger[heat_lost + thermal_.size()] = power.windage;
}

double Machine::mechanical_energy(std::span<const double> y, std::span<const SupportInput> inputs) const {
  double U = parts_.rotor->energy(rotor_part(y));
  for (std::size_t i = 0; i < places_.size(); ++i)
    U += parts_.supports[i]->energy(inputs[i], y.subspan(places_[i].state, places_[i].n_state));
  return U;
}

double Machine::mechanical_energy(double t, std::span<const double> y, const GrowthHistory* growth_in_force) const {
  return mechanical_energy(y, inputs_at(t, y, growth_in_force).inputs);
}

Evaluation Machine::inputs_at(double t, std::span<const double> y, const GrowthHistory* growth_in_force) const {
  Evaluation e;
  e.growth_in_force = growth_in_force;
  fit(e);
  prepare_inputs(t, y, e);
  return e;
}

EnergyBalance Machine::energy_balance(double t, std::span<const double> y, const GrowthHistory* growth_in_force) const {
  return energy_balance(y, inputs_at(t, y, growth_in_force).inputs);
}

EnergyBalance Machine::energy_balance(std::span<const double> y, std::span<const SupportInput> inputs) const {
  EnergyBalance b;
  b.mechanical = mechanical_energy(y, inputs);
  for (const auto& place : places_) {
    const auto ledger = y.subspan(place.ledger, n_support_ledger);
    b.heat_deposited += ledger[rub_heat] + ledger[inner_heat] + ledger[outer_heat];
    b.dissipated += ledger[other_dissipation];
    b.prescribed_work += ledger[prescribed_work];
    b.growth_work += ledger[growth_work];
  }
  const auto ledger = y.subspan(machine_ledger_, n_machine_ledger_);
  if (parts_.rotor->has_windage()) b.windage = ledger[heat_lost + thermal_.size()];
  b.dissipated += b.heat_deposited + ledger[rotor_damping] + b.windage;
  b.unbalance_work = ledger[unbalance_work];
  b.drive_work = ledger[drive_work];
  b.residual = initial_mechanical_ - b.mechanical - b.dissipated + b.growth_work + b.prescribed_work +
               b.unbalance_work + b.drive_work;
  for (std::size_t k = 0; k < thermal_.size(); ++k) {
    const double stored = parts_.thermal[k].model->stored_energy(thermal_part(k, y)), lost = ledger[heat_lost + k];
    b.heat.push_back({stored, lost, b.heat_deposited - stored - lost});
  }
  return b;
}

void Machine::observe_state(std::span<const double> y, const Evaluation& found, std::span<double> out) const {
  const Spin spin = parts_.rotor->spin(rotor_part(y));
  out[0] = spin.speed;
  out[1] = spin.angle;
  std::size_t at = 2;
  for (std::size_t k = 0; k < thermal_.size(); ++k) {
    parts_.thermal[k].model->observe(thermal_part(k, y), found.heats, out.subspan(at, thermal_[k].n_observed));
    at += thermal_[k].n_observed;
  }
  std::vector<Expansion> growth(found.heats.size());
  for (std::size_t k = 0; k < thermal_.size(); ++k) {
    parts_.thermal[k].model->growth(thermal_part(k, y), growth);
    for (const auto& place : parts_.thermal_place)
      if (place)
        for (const double value : growth_values(growth[*place])) out[at++] = value;
  }
  const EnergyBalance b = energy_balance(y, found.inputs);
  for (const double value : {b.mechanical, b.dissipated, b.growth_work, b.prescribed_work, b.unbalance_work,
                             b.drive_work, b.residual, b.heat_deposited})
    out[at++] = value;
  for (const auto& heat : b.heat)
    for (const double value : {heat.stored, heat.lost, heat.residual}) out[at++] = value;
  for (std::size_t i = first_ledger_; i < y.size(); ++i) out[at++] = y[i];
}

PlaceEnergy Machine::heat_given(std::size_t place, std::span<const double> y) const {
  const auto& [first, rows, n_rows] = ledger_of_place_[place];
  const auto ledger = y.subspan(first, n_support_ledger);
  PlaceEnergy given{ledger[rub_heat], ledger[rub_heat_into_ring], ledger[inner_heat], ledger[outer_heat]};
  for (std::size_t row = 0; row < n_rows; ++row) given.rows.push_back({y[rows + 2 * row], y[rows + 2 * row + 1]});
  return given;
}

double Machine::ledger(std::size_t support, const std::string& name, std::span<const double> y) const {
  const std::string full = parts_.supports[support]->name() + " ledger/" + name;
  const Place& p = places_[support];
  const std::size_t n = n_support_ledger + p.n_own + 2 * p.n_rows;
  for (std::size_t i = p.ledger; i < p.ledger + n; ++i)
    if (layout_.entries()[i].name == full) return y[i];
  throw std::out_of_range("no ledger named " + full);
}

}  // namespace rotordrop
