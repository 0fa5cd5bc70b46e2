#include "machine/build_machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>

#include "base/parameters/suggestion.h"
#include "bearing/support/linear_support.h"
#include "bearing/touchdown_checks.h"
#include "machine/magnets.h"
#include "machine/probes.h"
#include "machine/shaft_geometry.h"
#include "machine/speed_growth.h"
#include "machine/static_growth.h"
#include "thermal/section/reduced_sections.h"

namespace rotordrop {
namespace {

/// Of a table its value at ambient, for parts without a section.
ThermalMaterial thermal_material(const MaterialParameters& m, double ambient) {
  ThermalMaterial t{m.k, m.c, m.rho, m.alpha, m.nu};
  if (m.k_table) t.conductivity = t.conductivity_table.emplace(*m.k_table).value(ambient);
  if (m.c_table) t.heat_capacity = t.heat_capacity_table.emplace(*m.c_table).value(ambient);
  return t;
}

const Node& table_of(const Node& case_node, const char* section) {
  static const Node empty = Node::table();
  const Node* found = case_node.find(section);
  return found ? *found : empty;
}

RowConduction row_conduction(const MachineParameters& p, const TouchdownParameters& b, const BallRowGeometry& row) {
  const auto& t = p.thermal;
  const auto body = [&](const std::string& name) {
    const ThermalMaterial m = thermal_material(material_of(p, name), p.run.ambient);
    return ConductingBody{m.conductivity, m.density * m.heat_capacity};
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

GrowthDriver chosen_driver(const ThermalParameters& t) {
  if (t.driver != GrowthDriver::automatic) return t.driver;
  return t.has_lumped ? GrowthDriver::lumped : GrowthDriver::fe;
}

RubShare rub_share(const ThermalParameters& t) {
  return {t.share_to_ring, t.heat_share == HeatShare::jaeger, {t.rub_band_length, t.rub_contact_time, 1.}};
}

void add_elastic_growth(const MachineParameters& p, const TouchdownParameters& b, const FiniteElements& elements,
                        FiniteElements::Section& section) {
  const auto& material = material_of(p, b.ring);
  const auto kind = b.housing_fit_kind == HousingFit::bonded ? FitKind::bonded : FitKind::frictionless;
  const ElasticProblem problem =
      bearing_elastic_problem(section.problem, section.solver->section_mesh(),
                              {material.E, material.nu, material.rho, material.alpha, b.housing_fit, kind});
  section.elastic_solver = elements.make_elastic_solver(problem);
  section.elastic.emplace(*section.elastic_solver, problem, section.problem, section.formula,
                          contact_point_surfaces(b.ball_diameter, b.pitch_diameter, b.contact_angle, b.width),
                          section.solver->field().size());
  const double to_side = 0.5 * b.ball_diameter * std::sin(b.contact_angle);
  std::vector<ElasticGrowth::RowStrips> strips;
  for (const auto& row : row_places(b))
    strips.push_back({row.position - row.direction * to_side, row.position + row.direction * to_side});
  section.row_growth = section.elastic->row_weights(strips);
}

/// Refuses modes that answer heat less exactly than is asked for.
void check_reduction(const FiniteElements::Section& section, const FeParameters& fe) {
  const ReducedHeat& heat = section.reduced;
  if (heat.response_error <= fe.response_tolerance) return;
  throw InputError({},
                   fmt::format("the section of {} on {} modes answers heat with an error of {:.2g} % ({}), and "
                               "thermal.fe.response_tolerance = {:.4g} allows {:.2g} %.",
                               section.name, heat.n_modes(), 100. * heat.response_error, heat.worst_response,
                               fe.response_tolerance, 100. * fe.response_tolerance),
                   fmt::format("thermal.fe.modes = {} is the most that the case allows: raise it (200 if not given), "
                               "allow a larger error, or set thermal.fe.coupling = \"windowed\".",
                               fe.modes));
}

/// Rows of a ring that only translates carry the same loads but for their balls' places; a free one has thrust and tilts.
bool heats_rows_apart(const TouchdownParameters& b) { return b.rows > 1 && b.ring_motion == RingMotion::free; }

/// Meshes the section of every touchdown bearing; reduces it unless it is to run in windows.
/// @param of_a_drop  growth is judged by elasticity where formulas are fed back, if the section's elasticity is linear: its fit no clearance; rows that may carry different
///                   loads are heated apart
void make_sections(const MachineParameters& p, FiniteElements& elements, ReductionSettings reduction = {},
                   bool of_a_drop = false) {
  const auto& fe = p.thermal.fe;
  elements.coupling = fe.coupling;
  for (const auto& entry : p.bearings) {
    const auto* b = entry.touchdown();
    if (!b) continue;
    const auto circuit = circuit_data(p, entry.name, *b);
    SectionSettings settings{fe.shaft != FeShaft::lump, {}};
    settings.numerics.degree = fe.degree;
    settings.numerics.solver = fe.solver;
    settings.numerics.cells = std::max(2, static_cast<int>(std::lround(8 * fe.refinement)));
    settings.rows_apart = of_a_drop && heats_rows_apart(*b);
    settings.housing_film = elements.alone && fe.coupling == FeCoupling::windowed;
    if (elements.alone) settings.numerics.tolerance = elements.alone->time_tolerance;
    const SectionMesh mesh = fe.section == FeSection::plain ? SectionMesh{} : elements.make_mesh(entry.name);
    FiniteElements::Section section;
    section.name = entry.name;
    section.problem = bearing_heat_problem(circuit, mesh, p.run.ambient, settings);
    section.solver = elements.make_solver(section.problem);
    section.row_ports = raceway_row_ports(section.problem);
    section.formula = section_growth(circuit);
    section.adiabatic = adiabatic_section(section);
    section.grows_elastically = p.thermal.expansion == GrowthSource::elastic;
    if (section.grows_elastically || (of_a_drop && elements.make_elastic_solver && b->housing_fit >= 0.))
      add_elastic_growth(p, *b, elements, section);
    if (section.grows_elastically) {
      if (fe.coupling == FeCoupling::windowed) section.adiabatic.growth = immediate_elastic_growth(section);
    }
    if (fe.coupling != FeCoupling::windowed) {
      if (fe.coupling == FeCoupling::monolithic) {
        reduction.modes = 0;
        reduction.fastest = std::numeric_limits<double>::infinity();
      } else {
        // The shaft beside the bearing has modes of its own, which must not be taken from the rings'.
        reduction.modes =
            static_cast<std::size_t>(fe.modes) + std::max(circuit.fins.size(), 8 * circuit.shaft_steps.size());
        reduction.response_tolerance = fe.response_tolerance;
        reduction.longest_time = std::max(reduction.longest_time, p.run.end_time);
      }
      section.reduced = section.solver->reduce(reduction);
      check_reduction(section, fe);
    }
    elements.sections.push_back(std::move(section));
  }
}

ReducedSection::Elastic reduced_elastic(const FiniteElements::Section& section) {
  ReducedSection::Elastic elastic;
  for (std::size_t s = 0; s < elastic.growth.size(); ++s)
    elastic.growth[s] = section.solver->project(section.elastic->weights()[s]);
  const auto& fit = section.elastic->housing_fit();
  const auto functional = [&](const ElasticInfluence& g) {
    return ReducedSection::Functional{g.at_rest, section.solver->project(g.weights)};
  };
  elastic.mean_pressure = functional(fit.mean);
  for (const auto& node : fit.node) elastic.node_pressure.push_back(functional(node));
  elastic.node_share = fit.share;
  for (const auto& row : section.row_growth)
    for (const auto* weights : {&row.radial, &row.axial}) elastic.rows.push_back(section.solver->project(*weights));
  elastic.drives = section.grows_elastically;
  return elastic;
}

std::unique_ptr<ThermalModel> reduced_sections(const MachineParameters& p, const FiniteElements& elements) {
  std::vector<ReducedSection> sections;
  std::size_t k = 0;
  for (const auto& entry : p.bearings) {
    const auto* b = entry.touchdown();
    if (!b) continue;
    const auto& made = elements.sections[k++];
    ReducedSection section{made.name, made.reduced, made.formula, {}, false, made.row_ports, {}};
    if (made.elastic) section.elastic = reduced_elastic(made);
    const auto circuit = circuit_data(p, entry.name, *b);
    section.balls_roll = circuit.balls_roll;
    if (circuit.shaft_ring_link == BearingCircuitData::Link::in_contact) {
      const double touching = circuit_resistances(circuit).R2;
      section.contact_link = {touching, touching + circuit.gap_resistance};
    }
    sections.push_back(std::move(section));
  }
  return std::make_unique<ReducedSections>(std::move(sections), p.run.ambient);
}

/// The thermal models that a case asks for, and who drives.
void add_thermal_models(const MachineParameters& p, const ThermalNetworkData& network, FiniteElements* elements,
                        std::shared_ptr<const GrowthHistory> recorded, Machine::Parts& parts) {
  const GrowthDriver driver = driver_of(p.thermal);
  if (p.thermal.has_lumped) {
    auto circuit = std::make_unique<ThermalNetwork>(network);
    if (p.contact.friction_over_temperature) parts.friction_temperatures = {0, circuit->ring_states()};
    parts.thermal.push_back({"lumped", "/thermal/", std::move(circuit)});
    if (driver == GrowthDriver::lumped) parts.driver = 0;
  }
  if (p.thermal.has_fe) {
    if (elements->coupling == FeCoupling::windowed) {
      if (driver == GrowthDriver::fe) {
        parts.takes_growth = true;
        std::vector<AdiabaticSection> sections;
        for (const auto& section : elements->sections) sections.push_back(section.adiabatic);
        parts.immediate_growth = std::make_unique<AdiabaticRises>(std::move(sections), p.run.ambient);
      }
    } else {
      if (driver == GrowthDriver::fe) parts.driver = parts.thermal.size();
      parts.thermal.push_back({"fe", "/fe/", reduced_sections(p, *elements)});
    }
  }
  if (driver == GrowthDriver::recorded) parts.prescribed_growth = std::move(recorded);
}

using RingCentre = std::pair<double, std::pair<double, double>>;  // x, (y, z)

/// A rotor that starts inside a ring would be shot out of it.
void check_start(const MachineParameters& p, const Node& case_node, const RotorModel& rotor,
                 const Machine::Parts& parts, const std::vector<RingCentre>& ring_centres) {
  std::vector<Motion> motions(parts.supports.size());
  rotor.motions(parts.initial_rotor_state, motions);
  Faults faults;
  std::size_t ring = 0;
  for (std::size_t i = 0; i < p.bearings.size(); ++i) {
    const auto* b = p.bearings[i].touchdown();
    if (!b) continue;
    const auto& [y, z] = ring_centres[ring++].second;
    const double speed = p.run.initial_speed, distance = std::hypot(motions[i].y - y, motions[i].z - z),
                 gap = air_gap(*b, p.contact) - parts.rotor_growth_by_speed[ring - 1] * speed * speed;
    if (distance > gap)
      faults.add(
          position_of(case_node, "rotor"),
          fmt::format("the rotor starts {:.6g} um from the centre of the ring of {}, beyond the air gap of {:.6g} um.",
                      distance * 1e6, p.bearings[i].name, gap * 1e6),
          "Check rotor.initial_offset, initial_tilt and initial_orbit.");
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

/// Names become paths in results and in messages.
void check_name(const std::string& name, const std::string& what, const SourcePosition& where, Faults& faults) {
  const bool is_good = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
  if (!is_good)
    faults.add(where, fmt::format("{} cannot be called \"{}\".", what, name), "Use letters, digits, _ and -.");
}

void check_thermal_models(const MachineParameters& p, const Node& table, Faults& faults) {
  const auto& t = p.thermal;
  const auto driver = chosen_driver(t);
  if ((driver == GrowthDriver::lumped && !t.has_lumped) || (driver == GrowthDriver::fe && !t.has_fe))
    faults.add(position_of_value(table, "driver"), "thermal.driver names a model that is not in thermal.models.",
               "Add it to thermal.models.");
  if (driver == GrowthDriver::recorded && !t.recorded)
    faults.add(position_of_value(table, "driver"),
               "thermal.driver = \"recorded\" needs thermal.recorded, the results of an earlier run.");
  if (t.expansion == GrowthSource::elastic && !t.has_fe)
    faults.add(position_of_value(table, "expansion"),
               "thermal.expansion = \"elastic\" needs the finite elements, which are not in thermal.models.",
               "Add \"fe\" to thermal.models, or take expansion = \"formula\".");
  if (t.plane_strain_growth && t.expansion != GrowthSource::paper)
    faults.add(
        position_of_value(table, "plane_strain_growth"),
        fmt::format("thermal.plane_strain_growth applies to the paper's formulas, and thermal.expansion is \"{}\".",
                    t.expansion == GrowthSource::elastic ? "elastic" : "formula"),
        "Leave it out, or set thermal.expansion = \"paper\".");
  if (!t.has_fe) return;
  if (!t.nodes.empty() || !t.resistors.empty())
    faults.add(
        position_of(table, t.nodes.empty() ? "resistor" : "node"),
        "thermal.node and thermal.resistor extend only the lumped circuit, but the finite elements run too.",
        "Both models would not describe the same bearing. Leave them out, or run thermal.models = [\"lumped\"].");
  if (t.fe.shaft == FeShaft::beyond)
    for (const auto& entry : p.bearings)
      if (const auto* b = entry.touchdown(); b && !p.rotor.geometry.node_x.empty() && shaft_steps(p, *b).empty())
        faults.add(
            position_of_value(table.find("fe") ? *table.find("fe") : table, "shaft"),
            fmt::format("thermal.fe.shaft = \"beyond\", and the rotor does not reach beyond bearings.{}.", entry.name),
            "Check its node, shaft_lump_length and the rotor's geometry, or take shaft = \"bearing\".");
  if (t.fe.coupling == FeCoupling::windowed && t.shaft_ring_link == BearingCircuitData::Link::in_contact)
    faults.add(position_of_value(table, "shaft_ring_link"),
               "thermal.shaft_ring_link = \"in-contact\" changes within a window; thermal.fe.coupling = \"windowed\" "
               "cannot follow it.",
               "Take the reduced coupling, or the permanent link.");
}

/// Few modes, or all of them, stand for linear equations.
void check_tables(const MachineParameters& p, const Node& case_node, Faults& faults) {
  if (!p.thermal.has_fe || p.thermal.fe.coupling == FeCoupling::windowed) return;
  const char* coupling = p.thermal.fe.coupling == FeCoupling::reduced ? "reduced" : "monolithic";
  std::vector<std::string> told;
  for (const auto& entry : p.bearings) {
    const auto* b = entry.touchdown();
    const auto* m = b ? find_material(p, b->ring) : nullptr;
    if (!m || std::find(told.begin(), told.end(), b->ring) != told.end()) continue;
    told.push_back(b->ring);
    const Node& materials = table_of(case_node, "materials");
    const Node* own = materials.find(b->ring);
    for (const auto& [key, values] : {std::pair("k_table", &m->k_table), std::pair("c_table", &m->c_table)})
      if (*values && !PropertyTable(**values).is_constant())
        faults.add(position_of(own ? *own : materials, key),
                   fmt::format("materials.{}.{} depends on temperature, but thermal.fe.coupling = \"{}\" uses the "
                               "modes of a linear problem.",
                               b->ring, key, coupling),
                   "Take thermal.fe.coupling = \"windowed\", or constant k and c.");
  }
}

/// A rotor that may move along its axis needs rings that follow it, and shoulders where it is pushed to.
void check_axial_motion(const MachineParameters& p, const Node& case_node, Faults& faults) {
  const Node& rotor = table_of(case_node, "rotor");
  const bool is_free = p.rotor.axial_motion == AxialFreedom::free;
  const auto& table = p.rotor.axial_force;
  const auto [least, most] =
      std::minmax_element(table.begin(), table.end(), [](const auto& a, const auto& b) { return a[1] < b[1]; });
  if (!is_free && !table.empty() && ((*least)[1] != 0. || (*most)[1] != 0.))
    faults.add(position_of_value(rotor, "axial_force"),
               "rotor.axial_force acts on a rotor that cannot move along its axis.",
               "Set rotor.axial_motion = \"free\".");
  bool stops_plus = false, stops_minus = false;
  for (const auto& entry : p.bearings) {
    const auto* b = entry.touchdown();
    if (!b) continue;
    const bool has_shoulder = b->shoulders.gap_minus_x || b->shoulders.gap_plus_x;
    stops_plus |= b->shoulders.gap_minus_x.has_value();
    stops_minus |= b->shoulders.gap_plus_x.has_value();
    const Node* own = table_of(case_node, "bearings").find(entry.name);
    if (is_free && b->ring_motion != RingMotion::free)
      faults.add(
          position_of_value(own ? *own : table_of(case_node, "bearings"), "ring_motion"),
          fmt::format("rotor.axial_motion = \"free\", but the inner ring of {} cannot move axially with the rotor.",
                      entry.name),
          fmt::format("Set bearings.{}.ring_motion = \"free\".", entry.name));
    if (!is_free && has_shoulder)
      faults.add(position_of(own ? *own : table_of(case_node, "bearings"), "shoulders"),
                 fmt::format("bearings.{}.shoulders stop a rotor that cannot move along its axis.", entry.name),
                 "Set rotor.axial_motion = \"free\".");
  }
  if (!is_free) return;
  const double weight = rigid_body(p.rotor.geometry).mass * p.run.gravity[0];
  const auto unheld = [&](const char* where, const char* key, double force) {
    faults.add(position_of_value(rotor, "axial_motion"),
               fmt::format("nothing stops the rotor, which {:.6g} N push towards {}.", std::fabs(force), where),
               fmt::format("Give a bearing {}, the gap to a shoulder.", key));
  };
  const double to_plus = weight + (table.empty() ? 0. : (*most)[1]),
               to_minus = weight + (table.empty() ? 0. : (*least)[1]);
  if (to_plus > 0. && !stops_plus) unheld("+x", "shoulders.gap_minus_x", to_plus);
  if (to_minus < 0. && !stops_minus) unheld("-x", "shoulders.gap_plus_x", to_minus);
}

void check_end(const MachineParameters& p, const Node& case_node, Faults& faults) {
  if ((p.run.until != EndCondition::no_contact && p.run.until != EndCondition::rings_at_speed) ||
      !touchdown_names(p).empty())
    return;
  faults.add(position_of_value(table_of(case_node, "run"), "until"),
             fmt::format("run.until = \"{}\", but the case has no touchdown bearing.", name_of(p.run.until)),
             "Use \"standstill\" or a time.");
}

void check_statics(const MachineParameters& p, const Node& table, Faults& faults) {
  const auto& s = p.statics;
  for (const auto& load : s.loads)
    check_rotor_node(p.rotor.geometry, load.node, position_of_value(table, "loads"), "statics.loads.node", faults);
  const auto is_zero = [](const auto& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return v == 0.; });
  };
  if (s.subject == StaticsSubject::shaft)
    for (const auto& [key, zero] : {std::pair{"force", is_zero(s.force)}, std::pair{"moment", is_zero(s.moment)}})
      if (!zero)
        faults.add(position_of_value(table, key),
                   fmt::format("statics.{} loads a single bearing, but statics.subject is \"shaft\".", key),
                   "Set statics.subject = \"bearings\", or put forces on the rotor by statics.loads.");
  if (s.subject == StaticsSubject::bearings && !s.loads.empty())
    faults.add(position_of(table, "loads"),
               "statics.loads act on the rotor, which statics.subject = \"bearings\" leaves out.",
               "Set statics.subject = \"shaft\", or load the inner rings by statics.force and statics.moment.");
  if (s.preload_by == PreloadBy::rigid && s.preload_stiffness != 0.)
    faults.add(position_of_value(table, "preload_stiffness"),
               "statics.preload_stiffness belongs to a spring, but statics.preload_by is \"rigid\".",
               "Set statics.preload_by = \"spring\", or leave the stiffness out.");
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

ThermalParts build_thermal_models(const MachineParameters& parameters, const Node& case_node,
                                  const std::string& bearing, FiniteElements& finite_elements,
                                  const std::optional<BallConduction>& ball_conduction) {
  // A user's resistors may join this bearing's circuit with others'.
  MachineParameters p = parameters.thermal.resistors.empty() ? with_single_bearing(parameters, bearing) : parameters;
  p.thermal.driver = GrowthDriver::none;
  p.thermal.contact_conduction = BallConductionModel::fixed;  // there are no loads
  p.single.ball_conduction = ball_conduction;
  Faults faults;
  const auto network = network_data(p, case_node, faults);
  faults.throw_if_any();
  ThermalParts made;
  for (const auto& entry : p.bearings) {
    if (entry.name == bearing) made.place = made.n_places;
    if (entry.touchdown()) ++made.n_places;
  }
  if (p.thermal.has_fe) make_sections(p, finite_elements);
  Machine::Parts parts;
  add_thermal_models(p, network, &finite_elements, nullptr, parts);
  made.models = std::move(parts.thermal);
  return made;
}

BearingCircuitData circuit_data(const MachineParameters& p, const std::string& name, const TouchdownParameters& b) {
  const auto& t = p.thermal;
  BearingCircuitData c;
  c.name = name;
  c.ring = thermal_material(material_of(p, b.ring), p.run.ambient);
  c.ball = thermal_material(material_of(p, b.ball), p.run.ambient);
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
  c.ball_conduction = p.single.ball_conduction;
  if (t.spreading == RacewaySpreading::strip) c.strips = raceway_strips(p, b);
  c.plane_strain_growth = t.plane_strain_growth;
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

GrowthDriver driver_of(const ThermalParameters& t) { return t.growth ? chosen_driver(t) : GrowthDriver::none; }

void check_machine(const MachineParameters& p, const Node& case_node, Faults& faults) {
  const Node& bearings = table_of(case_node, "bearings");
  if (p.bearings.empty())
    faults.add(position_of(case_node, "bearings"), "the case has no bearings.",
               "Add at least one table [bearings.NAME] with type = \"touchdown\" or \"linear\".");
  check_against_geometry(p.rotor, p.rotor.geometry, table_of(case_node, "rotor"), faults);
  std::map<int, std::string> taken;
  bool materials_are_known = true;
  for (const auto& entry : p.bearings) {
    const Node* own = bearings.find(entry.name);
    const Node& table = own ? *own : bearings;
    check_name(entry.name, "a bearing", position_of(bearings, entry.name), faults);
    check_rotor_node(p.rotor.geometry, entry.node(), position_of_value(table, "node"),
                     "bearings." + entry.name + ".node", faults);
    if (const auto* b = entry.touchdown()) {
      if (const auto [other, is_first] = taken.emplace(b->node, entry.name); !is_first)
        faults.add(position_of_value(table, "node"),
                   fmt::format("bearings.{}.node = {}: another touchdown bearing, {}, sits at this node.", entry.name,
                               b->node, other->second),
                   "Give each its own node, or make one bearing with several rows.");
      if (b->housing_fit < 0. && p.thermal.expansion == GrowthSource::elastic &&
          p.thermal.fe.coupling != FeCoupling::windowed)
        faults.add(position_of_value(table, "housing_fit"),
                   fmt::format("bearings.{}.housing_fit = {:.6g} um is a clearance: its growth is not a linear "
                               "function of temperature.",
                               entry.name, b->housing_fit * 1e6),
                   "Take thermal.fe.coupling = \"windowed\", which opens and closes fits, or an interference.");
      check_touchdown(entry.name, *b, p.contact, table, table_of(case_node, "contact"), faults);
      for (const auto& [key, name] : {std::pair{"ball", b->ball}, std::pair{"ring", b->ring}}) {
        if (find_material(p, name)) continue;
        materials_are_known = false;
        std::vector<std::string> known;
        for (const auto& m : p.materials) known.push_back(m.first);
        faults.add(position_of_value(table, key),
                   fmt::format("bearings.{}.{} = \"{}\" is not a known material.", entry.name, key, name),
                   suggestion(name, known, fmt::format("Known in [materials]: {}.", fmt::join(known, ", "))));
      }
    }
  }
  if (materials_are_known) network_data(p, case_node, faults);
  check_thermal_models(p, table_of(case_node, "thermal"), faults);
  check_tables(p, case_node, faults);
  if (p.contact.friction_over_temperature && !p.thermal.has_lumped)
    faults.add(position_of_value(table_of(case_node, "contact"), "friction_over_temperature"),
               "contact.friction_over_temperature follows the inner rings of the lumped circuit, which does not run.",
               "Put \"lumped\" into thermal.models, which may drive nothing, or leave the table out.");
  check_axial_motion(p, case_node, faults);
  check_magnets(p, case_node, faults);
  check_end(p, case_node, faults);
  check_statics(p, table_of(case_node, "statics"), faults);
}

Machine::Parts machine_parts(const MachineParameters& p, const Node& case_node, FiniteElements* finite_elements,
                             std::shared_ptr<const GrowthHistory> recorded) {
  Faults faults;
  const auto network = network_data(p, case_node, faults);
  faults.throw_if_any();

  if (p.thermal.has_fe) make_sections(p, *finite_elements, {}, true);
  const GrowthDriver driver = driver_of(p.thermal);
  // What an earlier run recorded holds it if that run had it.
  const bool grows_by_speed = p.thermal.growth_by_speed != GrowthBySpeed::none && driver != GrowthDriver::recorded;
  const bool is_elastic = p.thermal.expansion == GrowthSource::elastic && driver == GrowthDriver::fe;
  Machine::Parts parts;
  std::vector<int> nodes;
  std::vector<RingCentre> ring_centres;
  std::size_t n_places = 0;
  for (const auto& entry : p.bearings) {
    nodes.push_back(entry.node());
    if (const auto* b = entry.touchdown()) {
      auto data = touchdown_data_of(p, entry.name, *b);
      if (grows_by_speed)
        data.centrifugal_growth =
            is_elastic ? finite_elements->sections[n_places].elastic->per_speed_squared() : ring_growth_by_speed(p, *b);
      parts.rotor_growth_by_speed.push_back(grows_by_speed ? rotor_growth_by_speed(p, *b) : 0.);
      data.heats_rows_apart = p.thermal.has_fe && !finite_elements->sections[n_places].row_ports.empty();
      auto bearing = std::make_unique<TouchdownBearing>(std::move(data));
      std::vector<double> state(bearing->state_entries().size());
      bearing->initial_state(state);
      ring_centres.push_back(
          {p.rotor.geometry.position(b->node), {state[TouchdownBearing::ring_y], state[TouchdownBearing::ring_z]}});
      parts.supports.push_back(std::move(bearing));
      parts.thermal_place.push_back(n_places++);
    } else {
      if (const auto* l = entry.linear())
        parts.supports.push_back(std::make_unique<LinearSupport>(entry.name, l->stiffness, l->damping));
      else if (entry.magnet())
        parts.supports.push_back(nullptr);  // made when it is known where the rotor starts
      else
        parts.supports.push_back(entry.other()->make(entry.name));
      parts.thermal_place.push_back(std::nullopt);
    }
  }
  parts.probes = probes_of(p.rotor);
  for (auto& probe : probe_contacts(p.rotor)) {
    nodes.push_back(probe.node);
    parts.supports.push_back(std::move(probe.contact));
    parts.thermal_place.push_back(std::nullopt);
  }
  parts.rub_share.assign(n_places, rub_share(p.thermal));
  add_thermal_models(p, network, finite_elements, std::move(recorded), parts);

  auto rotor = std::make_unique<ModalRotor>(p.rotor.geometry, rotor_settings(p.rotor, p.run.gravity), nodes);
  // The rotor starts as a straight line through the ring centres of the outermost touchdown bearings.
  const double x_cg = rotor->body().centre_of_gravity;
  Motion start;
  if (!ring_centres.empty()) {
    const auto [first, last] = std::minmax_element(ring_centres.begin(), ring_centres.end(),
                                                   [](const auto& a, const auto& b) { return a.first < b.first; });
    start = first->first < last->first ? straight_line(first->first, first->second.first, first->second.second,
                                                       last->first, last->second.first, last->second.second, x_cg)
                                       : Motion{.y = first->second.first, .z = first->second.second};
  }
  parts.initial_rotor_state.resize(rotor->n_state());
  rotor->initial_rigid_state(start + initial_disturbance(p.rotor), {p.rotor.initial_angle, p.run.initial_speed},
                             parts.initial_rotor_state);
  add_magnets(p, *rotor, start, parts);
  check_start(p, case_node, *rotor, parts, ring_centres);
  parts.rotor = std::move(rotor);
  return parts;
}

std::unique_ptr<Machine> build_machine(const MachineParameters& p, const Node& case_node,
                                       FiniteElements* finite_elements, std::shared_ptr<const GrowthHistory> recorded) {
  return std::make_unique<Machine>(machine_parts(p, case_node, finite_elements, std::move(recorded)));
}

std::shared_ptr<const ThermalModel> reduced_fe_model(const MachineParameters& p, FiniteElements& finite_elements,
                                                     double longest) {
  MachineParameters reduced = p;
  reduced.thermal.fe.coupling = FeCoupling::reduced;
  ReductionSettings settings;
  settings.shortest_time = 0.01;
  settings.longest_time = longest;
  make_sections(reduced, finite_elements, settings);
  return reduced_sections(reduced, finite_elements);
}

}  // namespace rotordrop
