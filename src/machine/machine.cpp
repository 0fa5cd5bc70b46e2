#include "machine/machine.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/errors.h"
#include "base/parameters/suggestion.h"
#include "machine/evaluate_machine.h"
#include "machine/observe_machine.h"
#include "machine/own_parts.h"

namespace rotordrop {
namespace {

StateEntry heat_lost_entry(const Machine::Parts::Thermal& part) {
  if (part.is_unmarked) return {"heat lost", "J", 1., "heat lost to ambient"};
  return {part.name + " heat lost", "J", 1., "heat lost to ambient by model " + part.name};
}

}  // namespace

Machine::Machine(Parts parts) : parts_(std::move(parts)) {
  const std::size_t n = parts_.supports.size();
  if (parts_.rotor->n_stations() != n || parts_.thermal_place.size() != n)
    throw std::invalid_argument("a machine needs one rotor station and one thermal place (or none) per support");

  lay_out_states();
  lay_out_ledgers();
  integrated_ = layout_;
  lay_out_followers();

  for (std::size_t i = 0; i < n; ++i)
    if (const auto place = parts_.thermal_place[i]) {
      ledger_of_place_.resize(std::max(ledger_of_place_.size(), *place + 1));
      ledger_of_place_[*place] = {places_[i].ledger, places_[i].ledger + n_support_ledger + places_[i].n_own,
                                  places_[i].n_rows};
    }
  connect_heat_ports();
  const std::size_t n_places = ledger_of_place_.size();
  if (parts_.rub_share.size() != n_places)
    throw std::invalid_argument("a machine needs one share of the rub heat per thermal place");
  if (parts_.rotor_growth_by_speed.empty()) parts_.rotor_growth_by_speed.assign(n_places, 0.);
  if (parts_.rotor_growth_by_speed.size() != n_places)
    throw std::invalid_argument("a machine needs the rotor's growth by speed at every thermal place, or at none");
  list_observables();
  n_step_ = observed_size(step_observables_);
  n_detail_ = observed_size(detail_observables_);

  initial_state_ = find_initial_state();
  initial_mechanical_ = mechanical_energy(0., initial_state_);
}

void Machine::lay_out_temperatures(std::size_t k) {
  const auto& part = parts_.thermal[k];
  thermal_[k].state = layout_.size();
  layout_.add_block(part.is_unmarked ? "temperature" : part.name + " temperature", part.model->state_entries());
  thermal_[k].n_state = layout_.size() - thermal_[k].state;
}

void Machine::lay_out_states() {
  layout_.add_block("rotor", parts_.rotor->state_entries());
  n_rotor_ = layout_.size();
  const std::size_t n = parts_.supports.size();
  places_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    places_[i].state = layout_.size();
    const auto entries = parts_.supports[i]->state_entries();
    places_[i].n_state = entries.size();
    layout_.add_block(parts_.supports[i]->name(), entries);
  }
  thermal_.resize(parts_.thermal.size());
  for (std::size_t k = 0; k < thermal_.size(); ++k)
    if (!parts_.thermal[k].follows) lay_out_temperatures(k);
  if (parts_.immediate_growth) {
    immediate_.state = layout_.size();
    layout_.add_block("windows", parts_.immediate_growth->state_entries());
    immediate_.n_state = layout_.size() - immediate_.state;
  }
}

void Machine::lay_out_ledgers() {
  first_ledger_ = layout_.size();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    std::vector<StateEntry> entries = {
        {"rub heat", "J", 100., "friction heat of rotor and inner ring"},
        {"rub heat into ring", "J", 100., "part of the rub heat that enters the inner ring"},
        {"inner heat", "J", 10., "friction heat of balls and inner race"},
        {"outer heat", "J", 10., "friction heat of balls and outer race"},
        {"other dissipation", "J", 1., "energy dissipated by damping, which heats nothing here"},
        {"prescribed work", "J", 1., prescribed_work_meaning},
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
    if (const std::string port = parts_.supports[i]->heat_port(); !port.empty()) {
      places_[i].heats_port = true;
      entries.push_back({"heat into port", "J", 10., "heat that enters the thermal models at " + port});
    }
    layout_.add_block(parts_.supports[i]->name() + " ledger", entries);
  }
  machine_ledger_ = layout_.size();
  std::vector<StateEntry> entries = {{"rotor damping", "J", 1., "energy dissipated by the rotor's damping"},
                                     {"unbalance work", "J", 1., "work of the unbalance forces on the rotor"},
                                     {"drive work", "J", 1., "work of motor or brake on the rotor"}};
  for (std::size_t k = 0; k < thermal_.size(); ++k) {
    if (parts_.thermal[k].follows) continue;
    thermal_[k].lost = machine_ledger_ + entries.size();
    entries.push_back(heat_lost_entry(parts_.thermal[k]));
  }
  windage_ledger_ = machine_ledger_ + entries.size();
  if (parts_.rotor->has_windage())
    entries.push_back({"windage", "J", 100., "energy dissipated by the gas around the rotor, which warms no bearing"});
  layout_.add_block("energy", entries);
}

void Machine::lay_out_followers() {
  std::vector<StateEntry> lost;
  for (std::size_t k = 0; k < thermal_.size(); ++k) {
    if (!parts_.thermal[k].follows) continue;
    const ThermalModel& model = *parts_.thermal[k].model;
    const bool is_needed =
        parts_.driver == k || (parts_.friction_temperatures && parts_.friction_temperatures->model == k);
    if (is_needed || !model.can_follow() || !model.heat_ports().empty())
      throw std::invalid_argument("a thermal model that others depend on, or that cannot follow, is to follow");
    thermal_[k].lost = layout_.size() + lost.size();
    lost.push_back(heat_lost_entry(parts_.thermal[k]));
  }
  n_ledger_ = layout_.size() + lost.size() - first_ledger_;
  if (lost.empty()) return;
  layout_.add_block("followers' energy", lost);
  for (std::size_t k = 0; k < thermal_.size(); ++k)
    if (parts_.thermal[k].follows) lay_out_temperatures(k);
}

void Machine::connect_heat_ports() {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (!places_[i].heats_port) continue;
    const std::string wanted = parts_.supports[i]->heat_port();
    std::vector<std::string> known;
    bool is_found = false;
    for (std::size_t k = 0; k < thermal_.size(); ++k) {
      const auto ports = parts_.thermal[k].model->heat_ports();
      for (std::size_t port = 0; port < ports.size(); ++port) {
        if (std::find(known.begin(), known.end(), ports[port]) == known.end()) known.push_back(ports[port]);
        if (ports[port] != wanted) continue;
        heated_ports_.push_back({i, k, port});
        is_found = true;
      }
    }
    if (!is_found)
      throw InputError({},
                       "bearings." + parts_.supports[i]->name() + " heats \"" + wanted +
                           "\", and no thermal model that runs has a place of that name that can be heated.",
                       suggestion(wanted, known));
  }
}

std::vector<double> Machine::find_initial_state() const {
  std::vector<double> all(layout_.size(), 0.);
  const std::span<double> y = all;
  std::copy(parts_.initial_rotor_state.begin(), parts_.initial_rotor_state.end(), y.begin());
  for (std::size_t i = 0; i < places_.size(); ++i)
    parts_.supports[i]->initial_state(y.subspan(places_[i].state, places_[i].n_state));
  for (std::size_t i = 0; i < thermal_.size(); ++i)
    parts_.thermal[i].model->initial_state(y.subspan(thermal_[i].state, thermal_[i].n_state));
  if (parts_.immediate_growth) parts_.immediate_growth->initial_state(y.subspan(immediate_.state, immediate_.n_state));
  return all;
}

void Machine::initial_state(std::span<double> y) const { std::copy_n(initial_state_.begin(), y.size(), y.begin()); }

std::vector<double> Machine::instants() const {
  std::vector<double> list = parts_.rotor->instants();
  for (const auto& support : parts_.supports) {
    const auto own = support->instants();
    list.insert(list.end(), own.begin(), own.end());
  }
  return list;
}

void Machine::evaluate(double t, std::span<const double> y, Evaluation& found) const {
  found.rates.resize(integrated_.size());
  evaluate(t, y, found.rates, found);
}

void Machine::rhs(double t, std::span<const double> y, std::span<double> rates) const {
  Evaluation found;
  evaluate(t, y, rates, found);
}

void Machine::evaluate(double t, std::span<const double> y, std::span<double> dydt, Evaluation& e) const {
  evaluate_with<double>(OwnParts{parts_}, t, y, dydt, e);
}

double Machine::mechanical_energy(double t, std::span<const double> y, const GrowthHistory* growth_in_force) const {
  return mechanical_energy_of<double>(OwnParts{parts_}, y, inputs_at(t, y, growth_in_force).inputs);
}

Evaluation Machine::inputs_at(double t, std::span<const double> y, const GrowthHistory* growth_in_force) const {
  Evaluation e;
  e.growth_in_force = growth_in_force;
  fit(e);
  prepare_inputs<double>(OwnParts{parts_}, t, y, e);
  return e;
}

EnergyBalance Machine::energy_balance(double t, std::span<const double> y, const GrowthHistory* growth_in_force) const {
  return energy_balance_of<double>(OwnParts{parts_, initial_mechanical_}, y, inputs_at(t, y, growth_in_force).inputs);
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
  const std::size_t n = p.port_ledger() - p.ledger + (p.heats_port ? 1 : 0);
  for (std::size_t i = p.ledger; i < p.ledger + n; ++i)
    if (layout_.entries()[i].name == full) return y[i];
  throw std::out_of_range("no ledger named " + full);
}

}  // namespace rotordrop
