#include <algorithm>
#include <cmath>

#include "machine/machine.h"
#include "machine/observe_machine.h"
#include "machine/own_parts.h"

// What a machine reports: the lists of its observables, and their values.
namespace rotordrop {

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
  n_rotor_observed_ = add(state_observables_, "/rotor/", parts_.rotor->observables());
  for (std::size_t i = 0; i < thermal_.size(); ++i) {
    auto observables = parts_.thermal[i].model->observables();
    for (auto& o : observables)
      if (o.unit == "K" && o.kind == Observed::other) o.kind = Observed::temperature;
    thermal_[i].n_observed = add(state_observables_, parts_.thermal[i].group, observables);
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
       {"prescribed_work", "J", prescribed_work_meaning, 1, {}, Observed::energy_moved},
       {"unbalance_work", "J", "work of the unbalance forces on the rotor", 1, {}, Observed::energy_moved},
       {"drive_work", "J", "work of motor or brake on the rotor", 1, {}, Observed::energy_moved},
       {"residual", "J", "mechanical energy not accounted for", 1, {}, Observed::energy_residual},
       {"heat_deposited", "J", "heat given to each thermal model since the start", 1, {}, Observed::heat_deposited}});
  for (const auto& part : parts_.thermal) {
    const std::string prefix = part.prefix(), of = part.is_unmarked ? "" : " by model " + part.name;
    add(state_observables_, "/energy/",
        {{prefix + "heat_stored", "J", "heat stored over ambient" + of, 1, {}},
         {prefix + "heat_lost", "J", "heat lost to ambient since the start" + of, 1, {}},
         {prefix + "heat_residual", "J", "heat not accounted for" + of, 1, {}, Observed::heat_residual, part.name}});
  }
  for (std::size_t i = first_ledger_; i < first_ledger_ + n_ledger_; ++i) {
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

void Machine::observe_probes(std::span<const double> y, std::span<double> out) const {
  std::size_t at = 0;
  for (const Probe& probe : parts_.probes) {
    const Motion motion = parts_.rotor->node_motion(probe.node, rotor_part(y));
    out[at++] = motion.y;
    out[at++] = motion.z;
    out[at++] = probe.clearance - std::hypot(motion.y - probe.centre[0], motion.z - probe.centre[1]);
  }
}

void Machine::observe_held(std::span<const double> y, std::span<double> out) const {
  observe_held_of<double>(OwnParts{parts_}, y, out);
}

void Machine::observe_state(std::span<const double> y, const Evaluation& found, std::span<double> out) const {
  observe_state_of<double>(OwnParts{parts_, initial_mechanical_}, y, found, out);
}

}  // namespace rotordrop
