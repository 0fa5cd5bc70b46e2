#include "machine/check_machine.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "base/parameters/suggestion.h"
#include "bearing/touchdown_checks.h"
#include "machine/balance.h"
#include "machine/bearing_data.h"
#include "machine/magnets.h"
#include "machine/shaft_geometry.h"

namespace rotordrop {
namespace {

/// Names become paths in results and in messages.
void check_name(const std::string& name, const std::string& what, const SourcePosition& where, Faults& faults) {
  const bool is_good = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
  if (!is_good)
    faults.add(where, fmt::format("{} cannot be called \"{}\".", what, name), "Use letters, digits, _ and -.");
  // Beside /ledger/NAME of bearings stand the machine's own ledgers (machine/machine.cpp).
  static const std::set<std::string> ledgers = {"rotor_damping", "unbalance_work", "drive_work", "windage",
                                                "heat_lost"};
  if (ledgers.contains(name) || name.ends_with("_heat_lost"))
    faults.add(where,
               fmt::format("{} cannot be called \"{}\": in results.h5 that is a ledger of the machine.", what, name),
               "Choose another name.");
}

void check_driver(const ThermalParameters& t, const Node& table, Faults& faults) {
  if (thermal_kind(t.driver) && !t.runs(t.driver))
    faults.add(position_of_value(table, "driver"), "thermal.driver names a model that is not in thermal.models.",
               "Add it to thermal.models.");
  if (t.driver == recorded_driver && !t.recorded)
    faults.add(position_of_value(table, "driver"),
               "thermal.driver = \"recorded\" needs thermal.recorded, the results of an earlier run.");
}

/// The models that some key asks for, as a list for advice.
std::string kinds_that(bool ThermalKind::*property) {
  std::string names;
  for (const auto* kind : thermal_kinds())
    if (kind->*property) names += (names.empty() ? "\"" : " or \"") + kind->name + "\"";
  return names;
}

bool follows_rings(const ThermalParameters& t) {
  const auto chosen = chosen_kinds(t);
  return std::any_of(chosen.begin(), chosen.end(), [](const ThermalKind* kind) { return kind->has_ring_states; });
}

void check_thermal_models(const MachineParameters& p, const Node& table, Faults& faults) {
  const auto& t = p.thermal;
  check_driver(t, table, faults);
  for (const auto* kind : chosen_kinds(t)) maker_of(t, *kind, faults);
  if (t.expansion == GrowthSource::elastic && !t.runs_sections())
    faults.add(position_of_value(table, "expansion"),
               "thermal.expansion = \"elastic\" needs the finite elements, which are not in thermal.models.",
               fmt::format("Add {} to thermal.models, or take expansion = \"formula\".",
                           kinds_that(&ThermalKind::meshes_sections)));
  if (t.plane_strain_growth && t.expansion != GrowthSource::paper)
    faults.add(
        position_of_value(table, "plane_strain_growth"),
        fmt::format("thermal.plane_strain_growth applies to the paper's formulas, and thermal.expansion is \"{}\".",
                    t.expansion == GrowthSource::elastic ? "elastic" : "formula"),
        "Leave it out, or set thermal.expansion = \"paper\".");
  if (!t.runs_sections()) return;
  if (!t.nodes.empty() || !t.resistors.empty())
    faults.add(
        position_of(table, t.nodes.empty() ? "resistor" : "node"),
        "thermal.node and thermal.resistor extend only the lumped circuit, but the finite elements run too.",
        fmt::format("Both models would not describe the same bearing. Leave them out, or run thermal.models = [{}].",
                    kinds_that(&ThermalKind::is_circuit)));
  if (t.fe.shaft == FeShaft::beyond)
    for (const auto& entry : p.bearings)
      if (const auto* b = entry.touchdown(); b && !p.rotor.geometry.node_x.empty() && shaft_steps(p, *b).empty())
        faults.add(
            position_of_value(table.find(fe_name) ? *table.find(fe_name) : table, "shaft"),
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
  if (!p.thermal.runs_sections() || p.thermal.fe.coupling == FeCoupling::windowed) return;
  const char* coupling = p.thermal.fe.coupling == FeCoupling::reduced ? "reduced" : "monolithic";
  std::vector<std::string> told;
  for (const auto& entry : p.bearings) {
    const auto* b = entry.touchdown();
    if (!b) continue;
    for (const auto& name : meshed_materials(p, *b)) {
      const auto* m = find_material(p, name);
      if (!m || std::find(told.begin(), told.end(), name) != told.end()) continue;
      told.push_back(name);
      const Node& materials = table_of(case_node, "materials");
      const Node* own = materials.find(name);
      for (const auto& [key, values] : {std::pair("k_table", &m->k_table), std::pair("c_table", &m->c_table)})
        if (*values && !PropertyTable(**values).is_constant())
          faults.add(position_of(own ? *own : materials, key),
                     fmt::format("materials.{}.{} depends on temperature, but thermal.fe.coupling = \"{}\" uses the "
                                 "modes of a linear problem.",
                                 name, key, coupling),
                     "Take thermal.fe.coupling = \"windowed\", or constant k and c.");
    }
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
    stops_plus |= b->shoulders.gap_minus_x.has_value();
    stops_minus |= b->shoulders.gap_plus_x.has_value();
    const Node* own = table_of(case_node, "bearings").find(entry.name);
    if (is_free && b->ring_motion != RingMotion::free)
      faults.add(
          position_of_value(own ? *own : table_of(case_node, "bearings"), "ring_motion"),
          fmt::format("rotor.axial_motion = \"free\", but the inner ring of {} cannot move axially with the rotor.",
                      entry.name),
          fmt::format("Set bearings.{}.ring_motion = \"free\".", entry.name));
    if (!is_free && b->shoulders.any())
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

void check_machine(const MachineParameters& p, const Node& case_node, Faults& faults) {
  const Node& bearings = table_of(case_node, "bearings");
  check_against_geometry(p.rotor, p.rotor.geometry, table_of(case_node, "rotor"), faults);
  check_balance(p, case_node, faults);
  std::map<int, std::string> taken;
  bool are_materials_known = true, have_journals = true;
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
      have_journals = have_journals && air_gap(*b, p.contact) < bore_radius(*b, p.contact);
      check_touchdown(entry.name, *b, p.contact, table, table_of(case_node, "contact"), faults);
      std::vector<std::pair<const char*, std::string>> materials = {{"ball", b->ball}, {"ring", b->ring}};
      if (b->journal) materials.emplace_back("journal", *b->journal);
      for (const auto& [key, name] : materials) {
        if (find_material(p, name)) continue;
        are_materials_known = false;
        std::vector<std::string> known;
        for (const auto& m : p.materials) known.push_back(m.first);
        faults.add(position_of_value(table, key),
                   fmt::format("bearings.{}.{} = \"{}\" is not a known material.", entry.name, key, name),
                   suggestion(name, known, fmt::format("Known in [materials]: {}.", fmt::join(known, ", "))));
      }
    }
  }
  if (are_materials_known && have_journals) network_data(p, case_node, faults);
  check_thermal_models(p, table_of(case_node, "thermal"), faults);
  check_tables(p, case_node, faults);
  if (p.contact.friction_over_temperature && !follows_rings(p.thermal))
    faults.add(position_of_value(table_of(case_node, "contact"), "friction_over_temperature"),
               "contact.friction_over_temperature follows the inner rings of the lumped circuit, which does not run.",
               fmt::format("Put {} into thermal.models, which may drive nothing, or leave the table out.",
                           kinds_that(&ThermalKind::has_ring_states)));
  check_axial_motion(p, case_node, faults);
  check_magnets(p, case_node, faults);
  check_end(p, case_node, faults);
  check_statics(p, table_of(case_node, "statics"), faults);
}

}  // namespace rotordrop
