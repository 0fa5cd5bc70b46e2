#include "machine/rotor_report.h"

#include "rotor/modal_rotor.h"

namespace rotordrop {

RotorReport rotor_report(const RotorParameters& parameters) {
  const ModalRotor rotor(parameters.geometry, rotor_settings(parameters, {}), {});
  RotorReport report;
  report.body = rotor.body();
  for (const double f : rotor.mode_frequencies())
    if (f > 0.) report.free_free_frequencies.push_back(f);
  return report;
}

std::vector<WhirlModes> machine_modes(const MachineParameters& p, const std::vector<double>& spin_speeds) {
  std::vector<LinearSupportAtNode> supports;
  for (const auto& entry : p.bearings)
    if (const auto* l = entry.linear()) supports.push_back({l->node, l->stiffness, l->damping});
  for (const auto& entry : p.bearings)
    if (const auto* m = entry.magnet()) supports.push_back({m->node, m->stiffness, m->damping});
  const ModalAnalysis analysis(p.rotor.geometry, {.modal_damping = p.rotor.modal_damping,
                                                  .mass_proportional_alpha = p.rotor.mass_proportional_alpha});
  std::vector<WhirlModes> all;
  for (const double speed : spin_speeds) all.push_back(analysis.whirl_modes(speed, supports));
  return all;
}

}  // namespace rotordrop
