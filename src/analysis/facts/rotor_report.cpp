#include "analysis/facts/rotor_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

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

RotorShapes rotor_shapes(const RotorParameters& parameters, const std::vector<int>& stations) {
  const ModalRotor rotor(parameters.geometry, rotor_settings(parameters, {}), stations);
  RotorShapes shapes{rotor.mode_frequencies(), {}};
  for (std::size_t mode = 0; mode < rotor.n_modes(); ++mode) {
    auto& shape = shapes.shape.emplace_back();
    for (int node = 1; node <= parameters.geometry.n_nodes(); ++node) shape.push_back(rotor.mode_shape(node, mode));
  }
  return shapes;
}

namespace {

std::vector<LinearSupportAtNode> linear_supports(const MachineParameters& p) {
  std::vector<LinearSupportAtNode> supports;
  for (const auto& entry : p.bearings)
    if (const auto* l = entry.linear()) supports.push_back({l->node, l->stiffness, l->damping});
  for (const auto& entry : p.bearings)
    if (const auto* m = entry.magnet()) supports.push_back({m->node, m->stiffness, m->damping});
  return supports;
}

/// The same isotropic spring at every node.
std::vector<LinearSupportAtNode> springs(const std::vector<int>& nodes, double stiffness) {
  std::vector<LinearSupportAtNode> supports;
  for (const int node : nodes) supports.push_back({node, {{{stiffness, 0.}, {0., stiffness}}}, {}});
  return supports;
}

ModalAnalysisOptions damped_as(const RotorParameters& rotor) {
  return {.modal_damping = rotor.modal_damping, .mass_proportional_alpha = rotor.mass_proportional_alpha};
}

}  // namespace

std::vector<std::string> supports_without_stiffness(const MachineParameters& p) {
  std::vector<std::string> names;
  for (const auto& entry : p.bearings)
    if (entry.other()) names.push_back(entry.name);
  return names;
}

std::string left_out_text(const std::vector<std::string>& supports) {
  if (supports.empty()) return "";
  return fmt::format(
      "Left out: {}. The stiffness of a kind of support that a module or program adds is not known here; put a linear "
      "support in its place to include it.\n",
      fmt::join(supports, ", "));
}

std::vector<WhirlModes> machine_modes(const MachineParameters& p, const std::vector<double>& spin_speeds,
                                      double largest_frequency) {
  const auto supports = linear_supports(p);
  ModalAnalysisOptions options = damped_as(p.rotor);
  if (std::isfinite(largest_frequency)) {
    options.cut_off_frequency = 2.5 * largest_frequency;
    for (const auto& support : supports) options.attachment_nodes.push_back(support.node);
  }
  const ModalAnalysis analysis(p.rotor.geometry, options);
  std::vector<WhirlModes> all;
  for (const double speed : spin_speeds) all.push_back(analysis.whirl_modes(speed, supports));
  return all;
}

CriticalSpeedReport critical_speeds(const MachineParameters& p, const CriticalSpeedOptions& options) {
  CriticalSpeedReport report;
  auto supports = linear_supports(p);
  std::vector<int> nodes;
  const bool has_linear = !supports.empty();
  std::vector<std::string> stations;
  for (const auto& entry : p.bearings)
    if (!has_linear || entry.linear() || entry.magnet()) {
      nodes.push_back(entry.node());
      stations.push_back(entry.name);
    }
  if (options.stiffness) {
    supports = springs(nodes, *options.stiffness);
    report.is_on_given_stiffness = true;
  }
  if (!supports.empty()) report.stations = stations;
  for (const auto& name : supports_without_stiffness(p))
    if (std::find(report.stations.begin(), report.stations.end(), name) == report.stations.end())
      report.left_out.push_back(name);
  const ModalAnalysisOptions damped = damped_as(p.rotor);
  // A picture needs no modes far above it; the supports' nodes keep their flexibility.
  ModalAnalysisOptions few = damped;
  few.cut_off_frequency = 5. * options.up_to / (2. * std::numbers::pi);
  few.attachment_nodes = nodes;
  const ModalAnalysis analysis(p.rotor.geometry, options.is_coarse ? few : damped);
  const double sense = p.run.initial_speed < 0. ? -1. : 1.;
  report.speeds = analysis.critical_speeds(options.up_to, supports, sense);
  const auto at_end = analysis.whirl_modes(sense * options.up_to, supports);
  report.n_overdamped = at_end.n_overdamped;
  report.n_diverging = at_end.n_diverging;
  report.divergence_rate = at_end.divergence_rate;
  report.n_rigid_body_modes = at_end.n_rigid_body_modes;
  for (const double stiffness : options.map) {
    report.map_stiffness.push_back(stiffness);
    report.map_speeds.emplace_back();
    for (const double speed : analysis.undamped_critical_speeds(springs(nodes, stiffness)))
      if (speed <= options.up_to) report.map_speeds.back().push_back(speed);
  }
  if (options.n_speeds > 1) {
    std::optional<ModalAnalysis> few_modes;
    if (!options.is_coarse) few_modes.emplace(p.rotor.geometry, few);
    const ModalAnalysis& coarse = few_modes ? *few_modes : analysis;
    for (int k = 0; k < options.n_speeds; ++k) {
      report.diagram_speeds.push_back(options.up_to * k / (options.n_speeds - 1));
      report.diagram_modes.push_back(coarse.whirl_modes(sense * report.diagram_speeds.back(), supports));
    }
  }
  return report;
}

}  // namespace rotordrop
