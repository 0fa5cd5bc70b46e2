#include "study/drop/drop_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/section_coupling.h"
#include "study/drop/damage_summary.h"
#include "study/drop/warning_summary.h"
#include "study/recorded_drop.h"

namespace rotordrop {
namespace {

// docs/theory/model.md, section 8: the rub heat from the spin-up alone, whatever friction, bounces and waves:
//   E_slip = (r_r/r_b) integral omega_r (J omega_i' + M) dt - J omega_i^2/2 - integral M omega_i dt + integral F_t v_t dt - energy of bristles.
std::optional<BearingSummary::SpinUp> spin_up_balance(const Machine& machine, std::size_t support,
                                                      std::span<const double> y, double ring_speed) {
  const auto* bearing = dynamic_cast<const TouchdownBearing*>(&machine.support(support));
  if (!bearing || bearing->data().free_cage) return {};  // balls that slip have a motion and a heat of their own
  const auto& d = bearing->data();
  const double balance =
      d.rotor_radius / d.bore_radius * machine.ledger(support, "spin-up drive", y) -
      0.5 * d.ring_spin_inertia * ring_speed * ring_speed -
      (machine.ledger(support, "inner heat", y) + machine.ledger(support, "outer heat", y)) / d.heat_over_work +
      machine.ledger(support, "spin-up centres", y) - bearing->energy_of_bristles(machine.support_part(support, y));
  return BearingSummary::SpinUp{balance, machine.ledger(support, "rub heat", y) - balance};
}

std::string ended_by(const RunParameters& run, const DropResult& result) {
  if (!result.completed) return "interruption";
  if (result.condition_met) return name_of(run.until);
  return run.until_time ? "until" : "end_time";
}

/// Rises of a bearing's temperatures at the end, of every model that is not a meshed section.
/// @param observed  [observed_size(machine.state_observables())]
std::vector<BearingSummary::Rises> rises_of(const Machine& machine, const std::vector<double>& observed,
                                            const std::string& name, double ambient) {
  std::vector<BearingSummary::Rises> all;
  for (std::size_t k = 0; k < machine.n_thermal_models(); ++k) {
    const auto& model = machine.thermal(k);
    BearingSummary::Rises rises{thermal_kind(model.name), {}};
    if (!rises.kind || rises.kind->meshes_sections) continue;
    const std::string prefix = model.group + name + "/";
    std::size_t at = 0;
    for (const auto& o : machine.state_observables()) {
      if (o.size == 1 && o.unit == "K" && o.name.starts_with(prefix))
        rises.values.emplace_back(o.name.substr(prefix.size()), observed[at] - ambient);
      at += o.size;
    }
    if (!rises.values.empty()) all.push_back(std::move(rises));
  }
  return all;
}

double tilt_of_ends(const Machine& machine, const RotorGeometry& geometry, std::span<const double> y) {
  const auto rotor = y.subspan(0, machine.rotor().state_entries().size());
  double tilt = 0.;
  for (const int node : {1, static_cast<int>(geometry.node_x.size())}) {
    const Motion at = machine.rotor().node_motion(node, rotor);
    tilt = std::max(tilt, std::hypot(at.theta_y, at.theta_z));
  }
  return tilt;
}

/// What the drop's observers and ledgers know of a bearing.
BearingSummary followed(const Machine& machine, const DropScalars& scalars, std::size_t i, const DropResult& result) {
  const std::size_t support = scalars.support(i);
  const auto ledger = [&](const char* name) { return machine.ledger(support, name, result.state); };
  BearingSummary b;
  b.name = machine.support(support).name();
  b.scalars = scalars.of(i);
  b.n_rows = scalars.n_rows(i);
  b.is_free = scalars.is_free(i);
  const auto* touchdown = dynamic_cast<const TouchdownBearing*>(&machine.support(support));
  b.is_inertial = touchdown && touchdown->data().ball_model == BallModel::inertial;
  b.friction_heat = ledger("rub heat");
  b.inner_heat = ledger("inner heat");
  b.outer_heat = ledger("outer heat");
  b.mean_contact_force_end = std::numeric_limits<double>::quiet_NaN();  // others keep no impulse
  if (touchdown)
    b.mean_contact_force_end =
        (ledger("contact impulse") - result.impulse_before_end[i]) / (result.end_time - result.averaging_start);
  b.spin_up = spin_up_balance(machine, support, result.state, b.scalars.ring_speed_end);
  return b;
}

}  // namespace

const double* BearingSummary::Rises::find(const std::string& node) const {
  for (const auto& [known, rise] : values)
    if (known == node) return &rise;
  return nullptr;
}

DropSummary summarise(const Case& drop_case, const Machine& machine, const DropScalars& scalars,
                      const DropResult& result, FiniteElements* elements, const RecordedDrop& recorded,
                      const SummaryParts& parts) {
  const auto& p = drop_case.parameters;
  const std::span<const double> y = result.state;
  DropSummary s;
  s.case_name = drop_case.name;
  s.title = p.title.value_or("");
  s.note = p.note.value_or("");
  s.ambient = p.run.ambient;
  s.rotor = rotor_report(p.rotor);
  std::vector<double> observed(observed_size(machine.state_observables()));
  Evaluation found;
  found.growth_in_force = result.growth_in_force ? &*result.growth_in_force : nullptr;
  machine.evaluate(result.end_time, y, found);
  machine.observe_state(y, found, observed);

  const bool is_elastic = elements && p.thermal.expansion == GrowthSource::elastic;
  if (is_elastic && elements->coupling != FeCoupling::windowed) lift_sections(*elements, machine, y, found);
  const ThermalKind* meshing = section_kind(p.thermal);
  for (std::size_t i = 0; i < scalars.size(); ++i) {
    BearingSummary b = followed(machine, scalars, i, result);
    b.is_up_along_y = p.run.gravity[1] < 0. && p.run.gravity[2] == 0.;
    b.rises = rises_of(machine, observed, b.name, p.run.ambient);
    if (elements && meshing)
      for (const auto& section : elements->sections)
        if (section.name == b.name) {
          b.section = {meshing, fe_summary(section, *meshing, elements->coupling, recorded)};
          if (is_elastic)
            b.section->fe.elastic_end = elastic_state(section, section.solver->field(), b.scalars.ring_speed_end);
        }
    for (const auto& entry : p.bearings)
      if (const auto* touchdown = entry.touchdown(); touchdown && entry.name == b.name) {
        if (parts.local_rub)
          b.local =
              local_summary(recorded, b.name, *touchdown, {b.scalars.first_contact_time, b.scalars.first_contact_end});
        b.damage = damage_json(b, result.fatigue[i], *touchdown);
        if (parts.whirl) b.whirl = whirl_summary(recorded, b.name);
      }
    if (b.is_free) b.shoulder = shoulder_report(p, b.name);
    b.support = support_summary(scalars.supports(), machine, p, b.name, y);
    s.bearings.push_back(std::move(b));
  }
  s.probes = probe_summaries(machine, scalars.probes(), y);
  s.rotor_speed_end = machine.spin(y).speed;
  s.tilt_end = tilt_of_ends(machine, p.rotor.geometry, y);
  s.mechanical_initial = machine.initial_mechanical_energy();
  s.energy = machine.energy_balance(result.end_time, y, found.growth_in_force);
  s.has_windage = machine.rotor().has_windage();
  for (std::size_t k = 0; k < machine.n_thermal_models(); ++k) {
    s.heat_models.push_back(thermal_kind(machine.thermal_name(k)));
    s.heat_prefixes.push_back(machine.thermal(k).prefix());
  }
  if (result.windows) s.windows = {*result.windows, result.windows_energy};
  s.completed = result.completed;
  s.end_time = result.end_time;
  s.until = name_of(p.run.until);
  s.ended_by = ended_by(p.run, result);
  s.wall_time = result.wall_time;
  s.cpu_time = result.cpu_time;
  s.statistics = result.statistics;
  s.input_warnings = drop_case.warnings;
  s.warnings = result.warnings;
  for (auto& warning : warnings_in_summary(p, s)) s.warnings.push_back(std::move(warning));
  return s;
}

}  // namespace rotordrop
