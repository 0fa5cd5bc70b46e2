#include "machine/bearing_data.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "machine/shaft_geometry.h"
#include "machine/static_growth.h"

namespace rotordrop {

ThermalMaterial thermal_material(const MaterialParameters& m, double ambient) {
  ThermalMaterial t{m.k, m.c, m.rho, m.alpha, m.nu};
  if (m.k_table) t.conductivity = t.conductivity_table.emplace(*m.k_table).value(ambient);
  if (m.c_table) t.heat_capacity = t.heat_capacity_table.emplace(*m.c_table).value(ambient);
  return t;
}

const MaterialParameters& shaft_material(const MachineParameters& p, const TouchdownParameters& b) {
  return material_of(p, b.journal.value_or(b.ring));
}

std::vector<std::string> meshed_materials(const MachineParameters& p, const TouchdownParameters& b) {
  std::vector<std::string> names{b.ring};
  if (b.journal && *b.journal != b.ring && p.thermal.fe.shaft != FeShaft::lump) names.push_back(*b.journal);
  return names;
}

namespace {

RowConduction row_conduction(const MachineParameters& p, const TouchdownParameters& b, const BallRowGeometry& row) {
  const auto& t = p.thermal;
  const auto body = [&](const std::string& name) {
    const ThermalMaterial m = thermal_material(material_of(p, name), p.run.ambient);
    return ConductingBody{m.conductivity, m.volumetric_capacity()};
  };
  const ConductingBody ring = body(b.ring), ball = body(b.ball);
  const auto contact = [&](const RaceContact& race) {
    return contact_conduction(ring, ball, race.axis_factor, race.ellipticity, t.oil_film, t.oil_conductivity);
  };
  const double radius = 0.5 * b.ball_diameter;
  return {contact(row.inner), contact(row.outer),
          t.ball_track == BallTrack::wandering
              ? wandering_track_conductance(ball.conductivity, radius)
              : repeating_track_conductance(ball.conductivity, radius, t.contact_half_width)};
}

/// Where the balls of each row run on the rings.
BearingCircuitData::Strips raceway_strips(const MachineParameters& p, const TouchdownParameters& b) {
  const double to_side = 0.5 * b.ball_diameter * std::sin(b.contact_angle),
               to_race = 0.5 * b.ball_diameter * std::cos(b.contact_angle);
  BearingCircuitData::Strips s;
  s.half_width = p.thermal.fe.strip_half_width.value_or(p.thermal.contact_half_width);
  for (const auto& row : row_places(b)) {
    const double middle = 0.5 * b.width + row.position;
    s.inner.push_back(middle - row.direction * to_side);
    s.outer.push_back(middle + row.direction * to_side);
  }
  s.inner_radius = 0.5 * b.pitch_diameter - to_race;
  s.outer_radius = 0.5 * b.pitch_diameter + to_race;
  // Rings given as cylinders may have no wall left under the groove: then half of theirs.
  const auto wall = [](double given, const auto& diameters) {
    const double half = 0.25 * (diameters[1] - diameters[0]);
    return given > 0.2 * half ? given : half;
  };
  s.inner_thickness = wall(s.inner_radius - 0.5 * b.inner_ring_diameters[0], b.inner_ring_diameters);
  s.outer_thickness = wall(0.5 * b.outer_ring_diameters[1] - s.outer_radius, b.outer_ring_diameters);
  return s;
}

}  // namespace

ThermalNetworkData network_data(const MachineParameters& p, const Node& case_node, Faults& faults) {
  ThermalNetworkData network;
  network.ambient = p.run.ambient;
  for (const auto& entry : p.bearings)
    if (const auto* b = entry.touchdown()) add_bearing_circuit(circuit_data(p, entry.name, *b), network);
  add_extra_parts(p.thermal, table_of(case_node, "thermal"), network, faults);
  return network;
}

BearingCircuitData circuit_data(const MachineParameters& p, const std::string& name, const TouchdownParameters& b) {
  const auto& t = p.thermal;
  BearingCircuitData c;
  c.name = name;
  c.ring = thermal_material(material_of(p, b.ring), p.run.ambient);
  c.ball = thermal_material(material_of(p, b.ball), p.run.ambient);
  c.shaft = thermal_material(shaft_material(p, b), p.run.ambient);
  c.width = b.width;
  c.journal_radius = bore_radius(b, p.contact) - air_gap(b, p.contact);
  c.ring_mass = b.ring_mass;
  c.inner_bore = b.inner_ring_diameters[0];
  c.inner_outside = b.inner_ring_diameters[1];
  c.outer_bore = b.outer_ring_diameters[0];
  c.outer_outside = b.outer_ring_diameters[1];
  c.housing_bore = b.housing_diameters[0];
  c.housing_outside = b.housing_diameters[1];
  c.housing_length = b.housing_length;
  c.shaft_length = b.shaft_lump_length.value_or(b.width);
  c.shaft_bore_radius = shaft_bore_radius(p, b);
  c.n_balls = b.rows * b.balls_per_row;
  c.ball_diameter = b.ball_diameter;
  c.h_shaft = t.h_shaft;
  c.h_ball = t.h_ball;
  c.fit_resistance = t.fit_resistance;
  c.contact_half_width = t.contact_half_width;
  c.races = race_surfaces(p, b);
  if (t.shaft == ShaftModel::fin) c.fins = shaft_fins(p, b, c);
  if (t.fe.shaft == FeShaft::beyond) c.shaft_steps = shaft_steps(p, b);
  c.balls_roll = t.contact_conduction == BallConductionModel::rolling;
  if (name == p.single.heated) c.ball_conduction = p.single.ball_conduction;
  if (t.spreading == RacewaySpreading::strip) c.strips = raceway_strips(p, b);
  c.plane_strain_growth = t.plane_strain_growth;
  using Growth = BearingCircuitData::OuterGrowth;
  c.outer_growth = t.expansion == GrowthSource::paper ? Growth::profile
                   : is_soft(b.support)               ? Growth::ring
                                                      : Growth::joined;
  c.shaft_ring_link = t.shaft_ring_link;
  c.factors = b.circuit;
  c.gap_resistance =
      std::log1p(air_gap(b, p.contact) / c.journal_radius) / (2. * std::numbers::pi * t.gas_conductivity * b.width);
  return c;
}

TouchdownSurroundings touchdown_surroundings(const MachineParameters& p, const TouchdownParameters& b) {
  const MaterialParameters &ring = material_of(p, b.ring), &ball = material_of(p, b.ball);
  TouchdownSurroundings around{{ring.E, ring.nu},
                               {ball.E, ball.nu},
                               p.run.gravity,
                               ball.rho,
                               p.rotor.axial_motion == AxialFreedom::free,
                               ring.rho,
                               {}};
  // The outermost of the shaft's layers at the node makes the surface.
  const ShaftElement* outermost = nullptr;
  double inside = std::numeric_limits<double>::infinity();
  for (const auto& e : p.rotor.geometry.elements) {
    if (b.node != e.n1 && b.node != e.n2) continue;
    if (!outermost || e.od > outermost->od) outermost = &e;
    inside = std::min(inside, 0.5 * e.id);
  }
  if (outermost) around.journal = JournalBody{{outermost->material.E, outermost->material.nu}, inside};
  return around;
}

TouchdownBearingData touchdown_data_of(const MachineParameters& p, const std::string& name,
                                       const TouchdownParameters& b) {
  auto data = touchdown_data(name, b, p.contact, touchdown_surroundings(p, b));
  if (p.thermal.contact_conduction == BallConductionModel::rolling)
    data.conduction = row_conduction(p, b, data.rows.front());
  return data;
}

}  // namespace rotordrop
