#include "machine/build_machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bearing/support/linear_support.h"
#include "machine/heat/make_sections.h"
#include "machine/magnets.h"
#include "machine/others/declared_parts.h"
#include "machine/probes.h"
#include "machine/speed_growth.h"

namespace rotordrop {
namespace {

RubShare rub_share(const MachineParameters& p, const TouchdownParameters& b) {
  const auto effusivity = [&](const MaterialParameters& material) {
    const ThermalMaterial m = thermal_material(material, p.run.ambient);
    return std::sqrt(m.conductivity * m.density * m.heat_capacity);
  };
  const ThermalParameters& t = p.thermal;
  return {
      t.share_to_ring,
      t.heat_share == HeatShare::jaeger,
      {t.rub_band_length, t.rub_contact_time, effusivity(shaft_material(p, b)) / effusivity(material_of(p, b.ring))}};
}

bool driver_meshes_sections(const std::string& driver) {
  const ThermalKind* kind = thermal_kind(driver);
  return kind && kind->meshes_sections;
}

/// A touchdown bearing's ring at rest in its balls.
struct RingAtRest {
  double position;            // along the rotor [m]
  std::vector<double> state;  // of the bearing
  [[nodiscard]] double y() const { return state[TouchdownBearing::ring_y]; }
  [[nodiscard]] double z() const { return state[TouchdownBearing::ring_z]; }
};

/// How far the surface of a round rotor beside a ring's centre reaches, at most, towards a bore that its waves make narrower [m].
/// @param y, z  of the rotor, relative to the ring, which has not turned yet
double reach_into_bore(const std::vector<BoreWave>& waves, double y, double z) {
  double reach = std::hypot(y, z);
  if (waves.empty()) return reach;
  reach = -std::numeric_limits<double>::infinity();
  int highest = 1;
  for (const BoreWave& wave : waves) highest = std::max(highest, wave.order);
  const int n = 64 * highest;  // azimuths: crests are found to 0.1 %
  for (int k = 0; k < n; ++k) {
    const double azimuth = 2. * std::numbers::pi * k / n;
    double here = y * std::cos(azimuth) + z * std::sin(azimuth);
    for (const BoreWave& wave : waves)
      here += wave.turned(0.).height(std::sin(wave.order * azimuth), std::cos(wave.order * azimuth));
    reach = std::max(reach, here);
  }
  return reach;
}

/// A rotor that starts inside a ring would be shot out of it.
void check_start(const MachineParameters& p, const Node& case_node, const RotorModel& rotor,
                 const Machine::Parts& parts, const std::vector<RingAtRest>& rings) {
  std::vector<Motion> motions(parts.supports.size());
  rotor.motions(parts.initial_rotor_state, motions);
  Faults faults;
  std::size_t ring = 0;
  for (std::size_t i = 0; i < p.bearings.size(); ++i) {
    const auto* b = p.bearings[i].touchdown();
    if (!b) continue;
    const RingAtRest& at_rest = rings[ring++];
    const auto& bearing = static_cast<const TouchdownBearing&>(*parts.supports[i]);
    const double speed = p.run.initial_speed, y = motions[i].y - at_rest.y(), z = motions[i].z - at_rest.z(),
                 distance = std::hypot(y, z), overlap = bearing.overlap_with_shoulders(motions[i], at_rest.state),
                 gap = air_gap(*b, p.contact) - parts.rotor_growth_by_speed[ring - 1] * speed * speed;
    if (gap <= 0.)
      faults.add(position_of(case_node, "contact"),
                 fmt::format("the spinning rotor grows by {:.4g} um at {} and closes the air gap of {:.4g} um.",
                             (air_gap(*b, p.contact) - gap) * 1e6, p.bearings[i].name, air_gap(*b, p.contact) * 1e6),
                 "Air gaps are a few tenths of a millimetre; check the unit of air_gap.");
    else if (distance > gap)
      faults.add(
          position_of(case_node, "rotor"),
          fmt::format("the rotor starts {:.6g} um from the centre of the ring of {}, beyond the air gap of {:.6g} um.",
                      distance * 1e6, p.bearings[i].name, gap * 1e6),
          "Check rotor.initial_offset, initial_tilt and initial_orbit.");
    else if (const double reach = reach_into_bore(bearing.data().bore_waves, y, z); reach > gap)
      faults.add(position_of(case_node, "bearings"),
                 fmt::format("the rotor starts {:.6g} um inside the wavy bore of {}: it is {:.6g} um from the ring's "
                             "centre, the air gap is {:.6g} um, and waves make the bore narrower.",
                             (reach - gap) * 1e6, p.bearings[i].name, distance * 1e6, gap * 1e6),
                 "Check amplitudes in its waviness, rotor.initial_offset, initial_tilt and initial_orbit.");
    else if (overlap > 0.)
      faults.add(
          position_of(case_node, "bearings"),
          fmt::format("a shoulder of the rotor starts {:.6g} um inside the ring of {}, which hangs {:.6g} um from "
                      "its unloaded place along the axis.",
                      overlap * 1e6, p.bearings[i].name, at_rest.state[TouchdownBearing::ring_x] * 1e6),
          "Gaps are of unloaded positions: make shoulders.gap_minus_x and gap_plus_x larger, or check "
          "initial_tilt, run.gravity and the bearing's preload.");
    if (!faults.empty()) break;  // one fault, whatever the number of rings
  }
  for (const auto& [name, probe] : p.rotor.probes) {
    if (!probe.contact) continue;
    const Motion at = rotor.node_motion(probe.node, parts.initial_rotor_state);
    const double distance = std::hypot(at.y - probe.centre[0], at.z - probe.centre[1]);
    if (distance > probe.clearance)
      faults.add(position_of(case_node, "rotor"),
                 fmt::format("the rotor starts {:.6g} um from the axis of rotor.probes.{}, beyond its clearance of "
                             "{:.6g} um.",
                             distance * 1e6, name, probe.clearance * 1e6),
                 "Check its clearance and centre, and rotor.initial_offset, initial_tilt and initial_orbit.");
  }
  faults.throw_if_any();
}

}  // namespace

Machine::Parts machine_parts(const MachineParameters& p, const Node& case_node, FiniteElements* finite_elements,
                             std::shared_ptr<const GrowthHistory> recorded) {
  if (p.thermal.runs_sections()) make_sections(p, *finite_elements, {}, true);
  const std::string driver = driver_of(p.thermal);
  const bool grows_by_speed = drop_grows_by_speed(p);
  const bool is_elastic = p.thermal.expansion == GrowthSource::elastic && driver_meshes_sections(driver);
  Machine::Parts parts;
  std::vector<int> nodes;
  std::vector<RingAtRest> rings;
  std::size_t n_places = 0;
  Faults faults;
  for (const auto& entry : p.bearings) {
    nodes.push_back(entry.node());
    if (const auto* b = entry.touchdown()) {
      auto data = touchdown_data_of(p, entry.name, *b);
      if (grows_by_speed)
        data.centrifugal_growth =
            is_elastic ? finite_elements->sections[n_places].elastic->per_speed_squared() : ring_growth_by_speed(p, *b);
      parts.rotor_growth_by_speed.push_back(grows_by_speed ? rotor_growth_by_speed(p, *b) : 0.);
      data.heats_rows_apart = p.thermal.runs_sections() && !finite_elements->sections[n_places].row_ports.empty();
      auto bearing = std::make_unique<TouchdownBearing>(std::move(data));
      std::vector<double> state(bearing->state_entries().size());
      bearing->initial_state(state);
      rings.push_back({p.rotor.geometry.position(b->node), std::move(state)});
      parts.supports.push_back(std::move(bearing));
      parts.rub_share.push_back(rub_share(p, *b));
      parts.thermal_place.emplace_back(n_places++);
    } else {
      if (const auto* l = entry.linear())
        parts.supports.push_back(std::make_unique<LinearSupport>(entry.name, l->stiffness, l->damping));
      else if (entry.magnet())
        parts.supports.push_back(nullptr);  // made when it is known where the rotor starts
      else {
        parts.supports.push_back(entry.other()->make(entry.name));
        check_declared(parts.supports.back().get(), entry.name,
                       position_of(table_of(case_node, "bearings"), entry.name), faults);
      }
      parts.thermal_place.emplace_back(std::nullopt);
    }
  }
  faults.throw_if_any();
  parts.probes = probes_of(p.rotor);
  for (auto& probe : probe_contacts(p.rotor)) {
    nodes.push_back(probe.node);
    parts.supports.push_back(std::move(probe.contact));
    parts.thermal_place.emplace_back(std::nullopt);
  }
  add_thermal_models(p, case_node, finite_elements, std::move(recorded), parts);

  auto rotor = std::make_unique<ModalRotor>(p.rotor.geometry, rotor_settings(p.rotor, p.run.gravity), nodes);
  // The rotor starts as a straight line through the ring centres of the outermost touchdown bearings.
  const double x_cg = rotor->body().centre_of_gravity;
  Motion start;
  if (!rings.empty()) {
    const auto [first, last] = std::minmax_element(
        rings.begin(), rings.end(), [](const auto& a, const auto& b) { return a.position < b.position; });
    start = first->position < last->position
                ? straight_line(first->position, first->y(), first->z(), last->position, last->y(), last->z(), x_cg)
                : Motion{.y = first->y(), .z = first->z()};
  }
  parts.initial_rotor_state.resize(rotor->n_state());
  rotor->initial_rigid_state(start + initial_disturbance(p.rotor), {p.rotor.initial_angle, p.run.initial_speed},
                             parts.initial_rotor_state);
  add_magnets(p, *rotor, start, parts);
  check_start(p, case_node, *rotor, parts, rings);
  parts.rotor = std::move(rotor);
  return parts;
}

std::unique_ptr<Machine> build_machine(const MachineParameters& p, const Node& case_node,
                                       FiniteElements* finite_elements, std::shared_ptr<const GrowthHistory> recorded) {
  return std::make_unique<Machine>(machine_parts(p, case_node, finite_elements, std::move(recorded)));
}

}  // namespace rotordrop
