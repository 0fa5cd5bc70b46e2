#include "machine/heat/thermal_parts.h"

#include "base/errors.h"
#include "machine/bearing_data.h"
#include "machine/heat/make_sections.h"
#include "machine/others/declared_parts.h"

namespace rotordrop {
namespace {

ThermalGeometry thermal_geometry(const MachineParameters& p, const Node& case_node, const FiniteElements* elements,
                                 Faults& faults) {
  ThermalGeometry geometry;
  geometry.ambient = p.run.ambient;
  for (const auto& entry : p.bearings)
    if (const auto* b = entry.touchdown()) geometry.bearings.push_back(circuit_data(p, entry.name, *b));
  geometry.circuits = network_data(p, case_node, faults);
  geometry.sections = [&p, elements] { return reduced_sections(p, *elements); };
  return geometry;
}

/// Sections that advance beside the drop: what heat does to them at once is in the state vector if their growth is fed back.
void add_immediate_growth(const FiniteElements& elements, double ambient, Machine::Parts& parts) {
  parts.takes_growth = true;
  std::vector<AdiabaticSection> sections;
  for (const auto& section : elements.sections) sections.push_back(section.adiabatic);
  parts.immediate_growth = std::make_unique<AdiabaticRises>(std::move(sections), ambient);
}

}  // namespace

void add_thermal_models(const MachineParameters& p, const Node& case_node, FiniteElements* elements,
                        std::shared_ptr<const GrowthHistory> recorded, Machine::Parts& parts) {
  Faults faults;
  const ThermalGeometry geometry = thermal_geometry(p, case_node, elements, faults);
  const std::string driver = driver_of(p.thermal);
  for (const ThermalKind* kind : chosen_kinds(p.thermal)) {
    const bool drives = kind->name == driver;
    if (kind->meshes_sections && elements->coupling == FeCoupling::windowed) {
      if (drives) add_immediate_growth(*elements, p.run.ambient, parts);
      continue;
    }
    const MakeThermalModel make = maker_of(p.thermal, *kind, faults);
    faults.throw_if_any();
    auto model = make(geometry);
    check_declared(model.get(), *kind, geometry.bearings.size(),
                   position_of_value(table_of(case_node, "thermal"), "models"), faults);
    faults.throw_if_any();
    if (p.contact.friction_over_temperature && !parts.friction_temperatures)
      if (auto states = model->ring_states(); !states.empty())
        parts.friction_temperatures = {parts.thermal.size(), std::move(states)};
    if (drives) parts.driver = parts.thermal.size();
    const auto& friction = parts.friction_temperatures;
    const bool is_felt =
        drives || (friction && friction->model == parts.thermal.size()) || !model->heat_ports().empty();
    // All modes of a mesh are the reference by which steps are judged.
    const bool is_reference = kind->meshes_sections && p.thermal.fe.coupling == FeCoupling::monolithic;
    const bool follows = !is_felt && !is_reference && model->can_follow();
    parts.thermal.push_back({kind->name, kind->group, std::move(model), kind->is_unmarked, follows,
                             kind->meshes_sections ? p.thermal.fe.longest_step : 0.});
  }
  faults.throw_if_any();
  if (driver == recorded_driver) parts.prescribed_growth = std::move(recorded);
}

ThermalParts build_thermal_models(const MachineParameters& parameters, const Node& case_node,
                                  const std::string& bearing, FiniteElements& finite_elements,
                                  const std::optional<BallConduction>& ball_conduction) {
  // A user's resistors may join this bearing's circuit with others'.
  MachineParameters p = parameters.thermal.resistors.empty() ? with_single_bearing(parameters, bearing) : parameters;
  p.thermal.driver = no_driver;
  p.thermal.contact_conduction = BallConductionModel::fixed;  // there are no loads
  p.single.heated = bearing;
  p.single.ball_conduction = ball_conduction;
  ThermalParts made;
  for (const auto& entry : p.bearings) {
    if (entry.name == bearing) made.place = made.n_places;
    if (entry.touchdown()) ++made.n_places;
  }
  if (p.thermal.runs_sections()) make_sections(p, finite_elements);
  Machine::Parts parts;
  add_thermal_models(p, case_node, &finite_elements, nullptr, parts);
  made.models = std::move(parts.thermal);
  return made;
}

}  // namespace rotordrop
