#include "case/plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <tuple>

#include "case/usual_values.h"
#include "machine/probes.h"

namespace rotordrop {
namespace {

/// Above it rings of steel burst: rho v^2 is 1.25 GPa at 400 m/s.
constexpr double fastest_surface = 400.;                      // [m/s]
constexpr double slowest_spin = 10. * std::numbers::pi;       // 300 rpm [rad/s]
constexpr double strongest_gravity = 30.;                     // drops on ships and in vehicles, with a margin [m/s2]
constexpr double coarsest_balance = 0.1;                      // G100 of ISO 21940-11 [m/s]
constexpr double shortest_run = 0.01;                         // shorter ones are trials [s]
constexpr double lightest_rotor = 0.1, heaviest_rotor = 1e5;  // [kg]

/// Steps of a drop take some 10 us of computing each.
constexpr double many_steps = 1e9, most_steps = 1e11;

double fewest_steps(const CaseParameters& p) { return p.run.latest_end() / step_or_bound(p.integration); }

void warn(std::vector<Fault>& warnings, const SourcePosition& where, std::string message, std::string advice) {
  Fault warning{where, std::move(message), std::move(advice)};
  if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(std::move(warning));
}

double mm(double metres) { return metres * 1e3; }

const Node& table_at(const Node& tree, std::string_view a, std::string_view b = "") {
  const Node* first = tree.find(a);
  if (!first || !first->is_table()) return tree;
  const Node* second = b.empty() ? nullptr : first->find(b);
  return second && second->is_table() ? *second : *first;
}

/// The step if that is given, else the end.
SourcePosition position_of_step(const CaseParameters& p, const Node& tree) {
  return p.integration.step ? position_of_value(table_at(tree, "integration"), "step")
                            : position_of_value(table_at(tree, "run"), "end_time");
}

/// Diameters and materials of a shaft; a geometry has no declarations of its own here.
void look_at_elements(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  const Node& rotor = table_at(tree, "rotor");
  for (std::size_t i = 0; i < p.rotor.geometry.elements.size(); ++i) {
    const auto& [n1, n2, od, id, material] = p.rotor.geometry.elements[i];
    if (material.rho < 500. || material.rho > 25e3)
      warn(warnings, position_of(rotor, "geometry"),
           fmt::format("a material of the rotor has rho = {:.6g} kg/m3; it is most often between 500 and 25000 kg/m3.",
                       material.rho),
           "A bare number is in kg/m3: steel has 7850, or \"7.85 g/cm3\".");
    if (material.E < 1e9 || material.E > 1e12)
      warn(warnings, position_of(rotor, "geometry"),
           fmt::format("a material of the rotor has E = {:.6g} Pa; it is most often between 1 and 1000 GPa.",
                       material.E),
           "A bare number is in Pa: steel has 2.1e11, or \"210 GPa\".");
    if (od > 3. || od < 2e-3)
      warn(warnings, position_of(rotor, "geometry"),
           fmt::format("element {} of the rotor has od = {:.6g} m; it is most often between 0.002 and 3 m.", i + 1, od),
           "A bare number is in metres: 90 millimetres are 0.09 or \"90 mm\".");
  }
}

/// A rotor is not thinner than a disc: Ip <= 2 Id of every body, equal for a plane one.
void look_at_rotor(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  const Node& rotor = table_at(tree, "rotor");
  const RigidBody body = rigid_body(p.rotor.geometry);
  if (body.mass < lightest_rotor || body.mass > heaviest_rotor)
    warn(warnings, position_of(rotor, "geometry"),
         fmt::format("the rotor's mass is {:.4g} kg; most often it is {} to {} kg.", body.mass, lightest_rotor,
                     heaviest_rotor),
         "Check the units of its dimensions (bare numbers are in metres) and of its density (kg/m3).");
  if (body.Ip > 2. * body.Id * (1. + 1e-9))
    warn(warnings, position_of(rotor, "geometry"),
         fmt::format("the rotor's Ip = {:.4g} kg m2 is more than 2 Id = {:.4g} kg m2, which no rigid body has.",
                     body.Ip, 2. * body.Id),
         "Check Ip and Id of its mass points; they may be exchanged.");
  double thickest = 0.;
  for (const auto& element : p.rotor.geometry.elements) thickest = std::max(thickest, element.od);
  const auto& x = p.rotor.geometry.node_x;
  const double length = x.empty() ? 0. : x.back() - x.front();
  if (thickest > 0. && length > 50. * thickest)
    warn(warnings, position_of(rotor, "geometry"),
         fmt::format("the rotor is {:.4g} m long and at most {:.4g} m thick, more than 50 times as long as thick.",
                     length, thickest),
         "Check the units of its lengths; bare numbers are in metres.");
  for (std::size_t i = 0; i < p.rotor.geometry.mass_points.size(); ++i) {
    const auto& point = p.rotor.geometry.mass_points[i];
    const double gyration = point.mass > 0. && point.Ip > 0. ? std::sqrt(point.Ip / point.mass) : thickest;
    if (thickest > 0. && (gyration > 5. * thickest || gyration < 0.05 * thickest))
      warn(warnings, position_of(rotor, "geometry"),
           fmt::format("mass point {} at node {} has {:.4g} kg and Ip = {:.4g} kg m2: a radius of gyration of {:.3g} "
                       "mm, where the shaft is up to {:.4g} mm thick.",
                       i + 1, point.node, point.mass, point.Ip, mm(gyration), mm(thickest)),
           "Check the units of mass and Ip: kg and kg m2, not kg mm2.");
    if (point.Ip > 2. * point.Id * (1. + 1e-9) && point.Ip > 0. && point.Id > 0.)
      warn(warnings, position_of(rotor, "geometry"),
           fmt::format("mass point {} at node {} has Ip = {:.4g} kg m2, more than 2 Id = {:.4g} kg m2, which no "
                       "rigid body has.",
                       i + 1, point.node, point.Ip, 2. * point.Id),
           "Ip is about the rotor's axis, Id about a diameter; they may be exchanged.");
  }
}

void look_at_bearing(const std::string& name, const TouchdownParameters& b, const CaseParameters& p, const Node& tree,
                     std::vector<Fault>& warnings) {
  const Node& table = table_at(tree, "bearings", name);
  const double bore = 2. * bore_radius(b, p.contact), gap = air_gap(b, p.contact), journal = bore - 2. * gap;
  const double speed = 0.5 * journal * std::fabs(p.run.initial_speed);
  if (p.run.initial_speed != 0. && std::fabs(p.run.initial_speed) < slowest_spin)
    warn(warnings, position_of_value(table_at(tree, "run"), "initial_speed"),
         fmt::format("the rotor spins at {:.4g} rpm; magnetically levitated rotors spin faster than {:.0f} rpm.",
                     std::fabs(p.run.initial_speed) * 30. / std::numbers::pi, slowest_spin * 30. / std::numbers::pi),
         "A point is a decimal point: eleven thousand is 11000 rpm, not 11.000 rpm.");
  if (speed > fastest_surface)
    warn(
        warnings, position_of_value(table_at(tree, "run"), "initial_speed"),
        fmt::format("the rotor's surface runs at {:.0f} m/s in bearings.{} ({:.0f} rpm, diameter {:.4g} mm); most "
                    "often it is below {:.0f} m/s.",
                    speed, name, std::fabs(p.run.initial_speed) * 30. / std::numbers::pi, mm(journal), fastest_surface),
        "A bare speed is in rad/s: if rpm is meant, write for example \"15200 rpm\".");
  // The journal is the shaft, perhaps with a sleeve on it; a shaft that does not pass the bore is another machine's.
  if (const double shaft = shaft_diameter(p.rotor.geometry, b.node); shaft > 0.) {
    if (shaft > bore)
      warn(warnings, position_of_value(table, "node"),
           fmt::format("the shaft at node {} has a diameter of {:.4g} mm; it does not pass the bore of bearings.{}, "
                       "{:.4g} mm.",
                       b.node, mm(shaft), name, mm(bore)),
           "Check the node, the bearing's size and the units of the rotor's od.");
    else if (bore - shaft < 1.2 * gap)  // gaps are varied with the same shaft
      warn(
          warnings, position_of_value(table, "node"),
          fmt::format("the shaft at node {} has a diameter of {:.5g} mm and leaves {:.4g} mm by radius in bearings.{}, "
                      "{:.5g} mm, where the air gap is {:.4g} mm.",
                      b.node, mm(shaft), mm(0.5 * (bore - shaft)), name, mm(bore), mm(gap)),
          "The air gap is by radius: half of what bore and journal differ by. The drop has a journal that leaves it.");
    else if (shaft < 0.95 * journal)
      warn(
          warnings, position_of_value(table, "node"),
          fmt::format("the shaft at node {} has a diameter of {:.4g} mm, less than 95 % of the journal in bearings.{}, "
                      "{:.4g} mm, which is its bore less twice the air gap.",
                      b.node, mm(shaft), name, mm(journal)),
          "Unless a sleeve is on it, check the node, the bearing's size and the units of the rotor's od.");
  }
  if (b.bore_diameter && std::fabs(*b.bore_diameter - b.inner_ring_diameters[0]) > 0.02 * *b.bore_diameter)
    warn(warnings, position_of_value(table, "inner_ring_diameters"),
         fmt::format("bearings.{} has inner_ring_diameters from {:.4g} mm, but its bore_diameter is {:.4g} mm.", name,
                     mm(b.inner_ring_diameters[0]), mm(*b.bore_diameter)),
         "One of them may belong to another size.");
  if (b.outside_diameter && std::fabs(*b.outside_diameter - b.outer_ring_diameters[1]) > 0.02 * *b.outside_diameter)
    warn(warnings, position_of_value(table, "outer_ring_diameters"),
         fmt::format("bearings.{} has outer_ring_diameters up to {:.4g} mm, but its outside_diameter is {:.4g} mm.",
                     name, mm(b.outer_ring_diameters[1]), mm(*b.outside_diameter)),
         "One of them may belong to another size.");
  if (b.width < b.rows * b.ball_diameter) {
    const bool is_one = b.rows == 1;
    warn(warnings, position_of_value(table, "width"),
         fmt::format("bearings.{} is {:.4g} mm wide, but its {} of balls of {:.4g} mm {} {:.4g} mm.", name, mm(b.width),
                     is_one ? "row" : fmt::format("{} rows", b.rows), mm(b.ball_diameter), is_one ? "needs" : "need",
                     mm(b.rows * b.ball_diameter)),
         is_one ? "The balls' diameter may belong to another size."
                : "A catalogue entry describes one bearing: of a pair, width, ring_mass, ring_spin_inertia and C0 "
                  "are those of both together.");
  }
  if (b.row_spacing && b.rows > 1 && *b.row_spacing < b.ball_diameter)
    warn(warnings, position_of_value(table, "row_spacing"),
         fmt::format("the rows of bearings.{} are {:.4g} mm apart, but its balls are {:.4g} mm thick: rows overlap.",
                     name, mm(*b.row_spacing), mm(b.ball_diameter)),
         "row_spacing is from centre to centre of neighbouring rows.");
  if (b.housing_length > 20. * b.outer_ring_diameters[1])
    warn(warnings, position_of_value(table, "housing_length"),
         fmt::format("the housing of bearings.{} is {:.4g} mm long, more than 20 times the bearing's diameter.", name,
                     mm(b.housing_length)),
         "A bare number is in metres.");
  if (b.width > b.outer_ring_diameters[1])
    warn(warnings, position_of_value(table, "width"),
         fmt::format("bearings.{} is {:.4g} mm wide, more than its diameter, {:.4g} mm.", name, mm(b.width),
                     mm(b.outer_ring_diameters[1])),
         "A bare number is in metres.");
}

/// Of the ring against its dimensions, and of a row alone what belongs to sets.
void look_at_ring(const std::string& name, const TouchdownParameters& b, const MaterialParameters* ring,
                  const Node& tree, std::vector<Fault>& warnings) {
  const Node& table = table_at(tree, "bearings", name);
  const auto [inside, outside] = std::pair(b.inner_ring_diameters[0], b.inner_ring_diameters[1]);
  if (ring) {
    const double solid = ring->rho * 0.25 * std::numbers::pi * (outside * outside - inside * inside) * b.width;
    if (b.ring_mass > 5. * solid || b.ring_mass < 0.2 * solid)
      warn(warnings, position_of_value(table, "ring_mass"),
           fmt::format("bearings.{}.ring_mass is {:.4g} kg, but a ring of its diameters, width and material has {:.3g} "
                       "kg.",
                       name, b.ring_mass, solid),
           "It is of the inner ring, of all rows together, without balls and cage. Check the unit.");
  }
  // Where raceways end: beside the groove, between the ring's other face and the balls' centres.
  for (const auto& [key, shoulder, from, to] :
       {std::tuple{"inner_shoulder_diameter", b.inner_shoulder_diameter, b.inner_ring_diameters[0], b.pitch_diameter},
        {"outer_shoulder_diameter", b.outer_shoulder_diameter, b.pitch_diameter, b.outer_ring_diameters[1]}})
    if (shoulder && (*shoulder <= from || *shoulder >= to))
      warn(warnings, position_of_value(table, key),
           fmt::format("bearings.{}.{} is {:.4g} mm, but a shoulder of this ring lies between {:.4g} and {:.4g} mm.",
                       name, key, mm(*shoulder), mm(from), mm(to)),
           "It is a diameter, between the ring's face and the pitch circle.");
  if (const double wall = 0.5 * (b.housing_diameters[1] - b.housing_diameters[0]); wall < 0.02 * b.housing_diameters[0])
    warn(warnings, position_of_value(table, "housing_diameters"),
         fmt::format("the housing of bearings.{} has a wall of {:.4g} mm around a bore of {:.4g} mm.", name, mm(wall),
                     mm(b.housing_diameters[0])),
         "housing_diameters are bore and outside.");
  for (const auto& [key, is_given] :
       {std::pair{"arrangement", b.arrangement != RowArrangement::face_to_face}, {"preload", b.preload > 0.}})
    if (b.rows == 1 && is_given)
      warn(warnings, position_of_value(table, key),
           fmt::format("bearings.{}.{} is of a set, but the bearing has rows = 1.", name, key),
           "Write count = 2 for a pair of catalogue bearings, or rows = 2 with the data of both; or leave it out.");
}

/// The file that a key is from; in parameters.toml of a run the one that stands behind it.
std::string origin_of(const Node& table, const char* key) {
  constexpr std::string_view from = "from ";
  const Node::Entry* entry = table.entry(key);
  if (!entry) return "";
  const auto at = entry->comment.find(from);
  if (at == std::string::npos) return entry->value.where().file;
  return entry->comment.substr(at + from.size(), entry->comment.find(':', at) - at - from.size());
}

/// Springs and dampers against the mass that they carry.
void look_at_support(const std::string& name, const SupportParameters& support, const Node& tree,
                     std::vector<Fault>& warnings) {
  const Node& table = table_at(tree, "bearings", name);
  const Node* own = table.find("support");
  if (!own) own = &table;
  const bool has_springs = support.type != "ribbon" && support.type != "elastomer";
  // Of a layer below that of the type it is what the type replaces.
  const Node* type = own->find("type");
  const auto is_meant = [&](const char* key) {
    const std::string file = origin_of(*own, key);
    return !type || file == origin_of(*own, "type") || file == tree.where().file || file.starts_with("--set");
  };
  const auto without_effect = [&](const char* key) {
    if (!is_meant(key)) return;
    warn(warnings, position_of_value(*own, key),
         fmt::format("bearings.{}.support.{} has no effect with type = \"{}\".", name, key, support.type),
         "Set the type that is meant, or take the key out.");
  };
  for (const auto& [key, is_given] : {std::pair{"K_y", support.K_y.has_value()},
                                      {"K_z", support.K_z.has_value()},
                                      {"C_y", support.C_y.has_value()},
                                      {"C_z", support.C_z.has_value()}})
    if (is_given && !has_springs) without_effect(key);
  if (support.ribbon && support.type != "ribbon") without_effect("ribbon");
  if (support.elastomer && support.type != "elastomer") without_effect("elastomer");
  if (support.squeeze_film && support.type != "squeeze-film") without_effect("squeeze_film");
  for (const auto& [key, K, C] : {std::tuple{"C_y", support.K_y, support.C_y}, {"C_z", support.K_z, support.C_z}}) {
    if (!K || !C || *C == 0.) continue;
    const double ratio = *C / (2. * std::sqrt(*K * support.mass));
    if (ratio < 1e-4 || ratio > 10.)
      warn(warnings, position_of_value(*own, key),
           fmt::format("bearings.{}.support.{} = {:.6g} N s/m is {:.3g} of critical damping of its mass and stiffness; "
                       "most often it is between 0.0001 and 10.",
                       name, key, *C, ratio),
           "Critical is 2 sqrt(K m). A bare number is in N s/m. Check mass and stiffness, too.");
  }
}

/// What goes for the run as a whole.
void look_at_run(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  const Node& run = table_at(tree, "run");
  const auto& g = p.run.gravity;
  if (const double magnitude = std::hypot(g[0], g[1], g[2]); magnitude > strongest_gravity)
    warn(warnings, position_of_value(run, "gravity"),
         fmt::format("run.gravity = {:.6g} m/s2 is {:.3g} times that of the earth.", magnitude, magnitude / 9.80665),
         "A bare number is in m/s2: 981 cm/s2 are 9.81.");
  bool has_magnets = false, is_released = false;
  for (const auto& entry : p.bearings)
    if (const auto* magnet = entry.magnet()) {
      has_magnets = true;
      is_released = is_released || std::min(magnet->release_time[0], magnet->release_time[1]) < p.run.latest_end();
    }
  if (has_magnets && !is_released)
    warn(warnings, position_of_value(run, "end_time"),
         fmt::format("no magnet lets go before the end of the run, {:.6g} s: nothing falls.", p.run.latest_end()),
         "Check release_time of the magnets and run.end_time; bare numbers are in seconds.");
  double unbalance = 0., mass = rigid_body(p.rotor.geometry).mass;
  for (const auto& one : p.rotor.unbalance) unbalance += one.me;
  if (const double e_omega = unbalance / mass * std::fabs(p.run.initial_speed); e_omega > coarsest_balance)
    warn(warnings, position_of_value(table_at(tree, "rotor"), "unbalance"),
         fmt::format("the rotor's unbalance of {:.4g} kg m in {:.4g} kg is e omega = {:.4g} mm/s at its initial speed; "
                     "machines like this are balanced to G0.4 to G6.3.",
                     unbalance, mass, e_omega * 1e3),
         "A bare number is in kg m: one gram millimetre is 1e-6. A lost blade may be meant.");
  if (const double steps = fewest_steps(p); steps > many_steps)
    warn(warnings, position_of_step(p, tree),
         fmt::format("run.end_time = {:.6g} s takes {:.2g} steps of at most {:.3g} s: hours or days.",
                     p.run.latest_end(), steps, step_or_bound(p.integration)),
         "A bare number is in seconds. Check run.end_time and integration.step; run.until ends a run by a condition.");
  const Node& output = table_at(tree, "output");
  for (const auto& [key, interval] :
       {std::pair{"interval", p.output.interval}, {"detail_interval", p.output.detail_interval}})
    if (interval > std::max(p.run.latest_end(), shortest_run))
      warn(warnings, position_of_value(output, key),
           fmt::format("output.{} = {:.6g} s is longer than the run, {:.6g} s: its series have the first and the last "
                       "row alone.",
                       key, interval, p.run.latest_end()),
           "A bare number is in seconds: \"50 us\" is usual.");
}

/// A stationary part that the rotor reaches before, or while, its touchdown bearings hold it.
void look_at_probes(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings) {
  const Node* tables = table_at(tree, "rotor").find("probes");
  for (const auto& [name, probe] : p.rotor.probes) {
    const double reach = reachable_displacement(p, probe.node);
    const double left = probe.clearance - std::hypot(probe.centre[0], probe.centre[1]);
    if (!std::isfinite(reach) || left > reach) continue;
    const Node* own = tables ? tables->find(name) : nullptr;
    warn(warnings, position_of_value(own ? *own : table_at(tree, "rotor"), "clearance"),
         fmt::format("rotor.probes.{}.clearance leaves {:.4g} um at node {}, not more than the {:.4g} um by which the "
                     "gaps of the touchdown bearings let a straight rotor move there: it touches.",
                     name, left * 1e6, probe.node, reach * 1e6),
         "Touchdown bearings are there to be touched first: check the clearance, its centre, the node and "
         "contact.air_gap.");
  }
}

/// What the case has but its laws leave out.
void look_at_laws(const std::string& name, const TouchdownParameters& b, const CaseParameters& p, const Node& tree,
                  std::vector<Fault>& warnings) {
  if (p.rotor.axial_motion != AxialFreedom::free || b.load_law != FrictionLoadLaw::radial) return;
  warn(
      warnings, position_of_value(table_at(tree, "bearings", name), "load_law"),
      fmt::format("{} takes axial load (rotor.axial_motion = \"free\"), but with load_law = \"radial\" thrust makes no "
                  "friction and no heat in it.",
                  name),
      fmt::format("Set bearings.{}.load_law = \"equivalent\".", name));
}

}  // namespace

std::vector<Fault> look_for_slips(const SectionDeclaration& section, const CaseParameters& p, const Node& tree) {
  std::vector<Fault> warnings;
  look_for_unusual_values(section, tree, warnings);
  look_at_elements(p, tree, warnings);
  look_at_rotor(p, tree, warnings);
  look_at_probes(p, tree, warnings);
  look_at_run(p, tree, warnings);
  look_for_common_keys_without_effect(tree, warnings);
  for (const auto& entry : p.bearings)
    if (const auto* touchdown = entry.touchdown()) {
      look_at_bearing(entry.name, *touchdown, p, tree, warnings);
      look_at_laws(entry.name, *touchdown, p, tree, warnings);
      look_at_ring(entry.name, *touchdown, find_material(p, touchdown->ring), tree, warnings);
      look_at_support(entry.name, touchdown->support, tree, warnings);
    }
  return warnings;
}

void check_length(const CaseParameters& p, const Node& tree, Faults& faults) {
  if (const double steps = fewest_steps(p); steps > most_steps)
    faults.add(position_of_step(p, tree),
               fmt::format("run.end_time = {:.6g} s in steps of at most {:.3g} s are {:.2g} steps; at most {:.0e} are "
                           "taken, which is more than ten days.",
                           p.run.latest_end(), step_or_bound(p.integration), steps, most_steps),
               "Make the step longer or the run shorter.");
}

void check_output(const CaseParameters& p, const Node& tree, Faults& faults) {
  // Rows of some hundred numbers each: 100 GB if all are written. Where rows become coarse while nothing changes, most are not.
  const auto& longest = p.output.longest_interval;
  const double most_rows = longest && *longest <= p.output.interval ? 1e8 : 1e10;
  const Node& table = table_at(tree, "output");
  for (const auto& [key, interval] :
       {std::pair{"interval", p.output.interval}, std::pair{"detail_interval", p.output.detail_interval}})
    if (p.run.latest_end() / interval > most_rows)
      faults.add(
          position_of_value(table, key),
          fmt::format("output.{} = {:.4g} s and run.end_time = {:.6g} s make {:.3g} rows of results; at most {:.0e} "
                      "are written.",
                      key, interval, p.run.latest_end(), p.run.latest_end() / interval, most_rows),
          "Make the interval longer or the run shorter.");
}

}  // namespace rotordrop
