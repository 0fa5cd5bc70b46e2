#include "machine/lanes/machine_lanes.h"

#include <algorithm>
#include <stdexcept>

#include "base/level_choice.h"
#include "bearing/touchdown_bearing.h"
#include "machine/lanes/lane_engine.h"
#include "rotor/modal_rotor_in_lanes.h"
#include "thermal/circuit/thermal_network_in_lanes.h"

namespace rotordrop {
namespace {

const TouchdownBearing* touchdown(const Machine& m, std::size_t i) {
  return dynamic_cast<const TouchdownBearing*>(&m.support(i));
}
const ThermalNetwork* network(const Machine& m, std::size_t i) {
  return dynamic_cast<const ThermalNetwork*>(m.thermal(i).model.get());
}

/// @param with_followers  whether models that follow are asked, too
std::string why_not_in_lanes(const Machine& m, bool with_followers) {
  const auto* rotor = dynamic_cast<const ModalRotor*>(&m.rotor());
  if (!rotor) return "its rotor is a model of its own";
  if (!ModalRotorInLanes<EightDrops>::is_alike(*rotor, *rotor)) return "its rotor moves along the axis";
  for (std::size_t i = 0; i < m.n_supports(); ++i) {
    const auto* bearing = touchdown(m, i);
    if (!bearing) return m.support(i).name() + " is no touchdown bearing";
    if (!bearing->runs_in_lanes())
      return "bearing " + bearing->name() +
             " has more than rigid rings that translate, with rolling balls, and regularised "
             "friction";
  }
  for (std::size_t i = 0; i < m.n_thermal_models(); ++i)
    if (!network(m, i) && (with_followers || !m.thermal(i).follows))
      return "thermal model \"" + m.thermal_name(i) + "\" is no lumped circuit";
  const auto& parts = m.parts();
  if (parts.immediate_growth || parts.takes_growth || parts.prescribed_growth)
    return "growth comes from outside its circuits";
  return {};
}

}  // namespace

std::string why_not_in_lanes(const Machine& m) { return why_not_in_lanes(m, true); }

bool evaluates_in_lanes(const Machine& m) { return why_not_in_lanes(m, false).empty(); }

bool are_alike(const Machine& a, const Machine& b) {
  const auto &p = a.parts(), &q = b.parts();
  const auto same_names = [](const StateEntry& one, const StateEntry& other) { return one.name == other.name; };
  if (!why_not_in_lanes(a).empty() || !why_not_in_lanes(b).empty() ||
      !std::ranges::equal(a.layout().entries(), b.layout().entries(), same_names) ||
      !std::ranges::equal(a.step_observables(), b.step_observables(), {}, &Observable::name, &Observable::name) ||
      a.n_supports() != b.n_supports() || a.n_thermal_models() != b.n_thermal_models() ||
      p.thermal_place != q.thermal_place || p.driver != q.driver ||
      p.friction_temperatures.has_value() != q.friction_temperatures.has_value() ||
      !std::ranges::equal(p.rub_share, q.rub_share, {}, &RubShare::by_jaeger, &RubShare::by_jaeger))
    return false;
  if (p.friction_temperatures && (p.friction_temperatures->model != q.friction_temperatures->model ||
                                  p.friction_temperatures->states != q.friction_temperatures->states))
    return false;
  for (std::size_t i = 0; i < a.n_supports(); ++i)
    if (!touchdown(a, i)->is_alike(*touchdown(b, i))) return false;
  for (std::size_t i = 0; i < a.n_thermal_models(); ++i)
    if (!ThermalNetworkInLanes<EightDrops>::is_alike(*network(a, i), *network(b, i))) return false;
  return ModalRotorInLanes<EightDrops>::is_alike(static_cast<const ModalRotor&>(a.rotor()),
                                                 static_cast<const ModalRotor&>(b.rotor()));
}

std::unique_ptr<LaneSystem> make_lanes(std::span<const Machine* const> machines) {
  if (machines.empty() || machines.size() > LaneSystem::width)
    throw std::invalid_argument("lanes hold one to eight machines");
  const bool is_one =
      std::ranges::all_of(machines, [&](const Machine* machine) { return machine == machines.front(); });
  for (const Machine* machine : machines)
    if (is_one ? !evaluates_in_lanes(*machine) : !are_alike(*machines.front(), *machine))
      throw std::invalid_argument("machines side by side must be alike");
  return ROTORDROP_OF_LEVEL(make_lanes)(machines);
}

}  // namespace rotordrop
