#include "study/heat/bearing_heat_case.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <mutex>

#include "analysis/facts/given_conduction.h"
#include "base/errors.h"
#include "base/parameters/suggestion.h"
#include "case/bearing_mesh.h"
#include "case/modules/fe_module.h"
#include "case/program_files.h"
#include "io/text/toml_reader.h"
#include "machine/check_machine.h"
#include "study/heat/recorded_heat.h"
#include "thermal/field_parameters.h"

namespace rotordrop {

namespace {

/// The bearing that is meant, or a fault.
std::string chosen_bearing(const Case& drop, const PrescribedHeatParameters& heat, const Node& table, Faults& faults) {
  const auto names = touchdown_names(drop.parameters);
  if (heat.bearing) {
    if (std::find(names.begin(), names.end(), *heat.bearing) == names.end())
      faults.add(position_of_value(table, "bearing"),
                 fmt::format("heat.bearing = \"{}\" is not a touchdown bearing.", *heat.bearing),
                 suggestion(*heat.bearing, names));
    return *heat.bearing;
  }
  if (names.size() == 1) return names.front();
  faults.add(
      table.where(),
      names.empty() ? "the case has no touchdown bearing to heat." : "heat.bearing is missing: which one is heated?",
      names.empty() ? "" : fmt::format("Known: {}.", fmt::join(names, ", ")));
  return {};
}

/// By load and speed, or as stated; none: R5.
std::optional<BallConduction> conduction_of_balls(const CaseParameters& p, const std::string& bearing) {
  const auto& heat = *p.heat;
  if (heat.ball_conductance) return BallConduction{*heat.ball_conductance, *heat.ball_conductance, 0.};
  if (heat.ball_load) return given_conduction(p, bearing, *heat.ball_load, heat.ring_speed.value_or(0.));
  return {};
}

void build_models(BearingHeatCase& c) {
  const auto& p = c.drop.parameters;
  c.elements = finite_elements_of(c.drop);
  c.elements.alone = {.time_tolerance = p.heat->time_tolerance};
  c.ball_conduction = conduction_of_balls(p, c.bearing);
  const std::lock_guard guard(section_lock());
  c.parts = build_thermal_models(p, c.drop.tree, c.bearing, c.elements, c.ball_conduction);
  FiniteElements::Section* section = c.elements.sections.empty() ? nullptr : &c.elements.sections.front();
  for (const auto& part : c.parts.models) {
    const ThermalKind* kind = thermal_kind(part.name);
    c.models.push_back(
        {part.name, heated_model(*part.model, {.bearing = c.bearing,
                                               .n_places = c.parts.n_places,
                                               .place = c.parts.place,
                                               .ambient = p.run.ambient,
                                               .time_tolerance = p.heat->time_tolerance,
                                               .section = kind && kind->meshes_sections ? section : nullptr})});
  }
  if (section && c.elements.coupling == FeCoupling::windowed)
    c.models.push_back({section_kind(p.thermal)->name, heated_mesh(*section)});
}

/// Names and places of probes become indices; what is not there becomes faults.
class ProbeFinder {
 public:
  ProbeFinder(BearingHeatCase& c, const Node& table, Faults& faults) : case_(c), table_(table), faults_(faults) {}

  void find_all() {
    const auto& wanted = case_.drop.parameters.heat->probes;
    for (at_ = 0; at_ < wanted.size(); ++at_) find(wanted[at_]);
    if (!wanted.empty()) return;
    for (std::size_t m = 0; m < case_.models.size(); ++m) {
      const auto& names = case_.models[m].heated->names();
      for (std::size_t i = 0; i < names.size(); ++i) {
        std::string name = case_.models[m].name + "." + names[i];
        std::replace(name.begin(), name.end(), '/', '.');
        case_.probes.push_back({name, m, i, {}, 0, 0., 0.});
      }
    }
  }

 private:
  void fault(const BearingProbeParameters& p, const char* key, const std::string& what, const std::string& advice) {
    const Node* list = table_.find("probe");
    faults_.add(list && list->is_array() ? position_of_value(list->items()[at_], key) : SourcePosition{},
                fmt::format("heat.probe#{} (\"{}\"): {}", at_ + 1, p.name, what), advice);
  }

  void find(const BearingProbeParameters& p) {
    if (p.node) {
      find_node(p);
      return;
    }
    std::size_t fe = 0;
    while (fe < case_.models.size() && !meshes_section(case_.models[fe].name)) ++fe;
    if (fe == case_.models.size()) {
      fault(p, p.boundary ? "boundary" : "x",
            "points and boundaries need the finite elements, which are not among the models.",
            fmt::format("Add \"{}\" to heat.models, or give a node of the circuit.", fe_name));
      return;
    }
    BearingHeatCase::Probe probe{p.name, fe, {}, {}, 0, 0., 0.};
    if (p.boundary ? find_boundary(p, probe) : find_point(p, probe)) case_.probes.push_back(probe);
  }

  /// "model = "a" or model = "b"".
  [[nodiscard]] std::string ways_to_say(const std::vector<std::pair<std::size_t, std::size_t>>& found) const {
    std::string text;
    for (const auto& [model, node] : found)
      text += fmt::format("{}model = \"{}\"", text.empty() ? "" : " or ", case_.models[model].name);
    return text;
  }

  [[nodiscard]] static bool meshes_section(const std::string& model) {
    const ThermalKind* kind = thermal_kind(model);
    return kind && kind->meshes_sections;
  }

  void find_node(const BearingProbeParameters& p) {
    std::vector<std::string> all;
    std::vector<std::pair<std::size_t, std::size_t>> found;
    bool has_model = false;
    for (std::size_t m = 0; m < case_.models.size(); ++m) {
      if (p.model && case_.models[m].name != *p.model) continue;
      has_model = true;
      const auto& names = case_.models[m].heated->names();
      for (std::size_t i = 0; i < names.size(); ++i) {
        if (std::find(all.begin(), all.end(), names[i]) == all.end()) all.push_back(names[i]);
        if (names[i] == *p.node) found.emplace_back(m, i);
      }
    }
    if (!has_model)
      fault(p, "model", fmt::format("model \"{}\" does not run.", *p.model), "Add it to heat.models.");
    else if (found.empty())
      fault(p, "node", fmt::format("there is no node \"{}\".", *p.node), suggestion(*p.node, all));
    else if (found.size() > 1)
      fault(p, "node", fmt::format("{} models have a \"{}\".", found.size() == 2 ? "both" : "several", *p.node),
            "Add " + ways_to_say(found) + ".");
    else
      case_.probes.push_back({p.name, found.front().first, found.front().second, {}, 0, 0., 0.});
  }

  [[nodiscard]] const SectionMesh& mesh() const { return case_.elements.sections.front().solver->section_mesh(); }

  bool find_boundary(const BearingProbeParameters& p, BearingHeatCase::Probe& probe) {
    std::vector<std::string> names;
    for (const auto& edge : mesh().edges) {
      const std::string name = boundary_name(mesh(), edge.boundary);
      if (name == *p.boundary) {
        probe.boundary = edge.boundary;
        return true;
      }
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    fault(p, "boundary", fmt::format("there is no boundary \"{}\".", *p.boundary), suggestion(*p.boundary, names));
    return false;
  }

  bool find_point(const BearingProbeParameters& p, BearingHeatCase::Probe& probe) {
    probe.x = *p.x;
    probe.r = *p.r;
    const auto& section = case_.elements.sections.front();
    const auto& bodies = section.problem.bodies;
    std::vector<std::string> names;
    for (const auto& body : bodies) names.push_back(body.name);
    if (p.body && std::find(names.begin(), names.end(), *p.body) == names.end()) {
      fault(p, "body", fmt::format("there is no body \"{}\".", *p.body), suggestion(*p.body, names));
      return false;
    }
    for (probe.body = 0; probe.body < bodies.size(); ++probe.body) {
      if (p.body && names[probe.body] != *p.body) continue;
      try {
        static_cast<void>(section.solver->temperature(probe.body, probe.x, probe.r));
        return true;
      } catch (const SolverError&) {
        continue;  // outside
      }
    }
    fault(p, "x", p.body ? fmt::format("the point lies outside {}.", *p.body) : "the point is not inside any body.",
          "x = 0 is the middle of the bearing's width; `rotordrop mesh` writes the section.");
    return false;
  }

  BearingHeatCase& case_;
  const Node& table_;
  Faults& faults_;
  std::size_t at_ = 0;
};

/// Fields of the section against the end of this computation; that of the drop is another one.
void check_fields(BearingHeatCase& c, Faults& faults) {
  const ThermalParameters& thermal = c.drop.parameters.thermal;
  if (!thermal.runs_sections()) return;
  const Node& drop = c.drop.tree;
  const Node* table = drop.find("thermal");
  const Node* fe = table ? table->find(fe_name) : nullptr;
  const Node& given = fe ? *fe : drop;
  check_number_of_fields("thermal.fe.field_interval", thermal.fe.field_interval.value_or(0.), c.end_time,
                         position_of_value(given, "field_interval"), faults);
  const auto& times = thermal.fe.field_times;
  if (!times.empty() && times.back() > c.end_time && times.back() <= c.drop.parameters.run.latest_end())
    c.drop.warnings.push_back(
        {position_of_value(given, "field_times"),
         fmt::format("thermal.fe.field_times go up to {:.6g} s, beyond the end of the given heat, "
                     "{:.6g} s: no field is written there.",
                     times.back(), c.end_time),
         "Give a later heat.end_time.", "thermal.fe.field_times"});
}

}  // namespace

bool is_bearing_heat_case(const std::filesystem::path& file) {
  look_for_file(file);
  const Node tree = read_toml(file);
  return tree.has("heat") || tree.has("bearings") || tree.has("rotor");
}

std::unique_ptr<BearingHeatCase> read_bearing_heat_case(const std::filesystem::path& file,
                                                        const std::vector<std::string>& overrides) {
  auto c = std::make_unique<BearingHeatCase>();
  c->drop = read_case(file, overrides);
  auto& p = c->drop.parameters;
  if (!p.heat)
    throw InputError({file.string(), 0, 0},
                     "this is the case of a drop, without a [heat] table that prescribes the heat input of a bearing.",
                     "docs/how-to/heat.md shows one; params/heat/bearing.toml is an example.");
  const Node& table = *c->drop.tree.find("heat");
  if (p.heat->models) p.thermal.models = *p.heat->models;
  // Nobody's growth is fed back into anything.
  p.thermal.driver = no_driver;
  if (!p.thermal.runs_sections() && p.thermal.expansion == GrowthSource::elastic)
    p.thermal.expansion = GrowthSource::formula;
  Faults faults;
  check_machine(p, c->drop.tree, faults);
  if (p.thermal.models.empty())
    faults.add(position_of_value(table_of(c->drop.tree, "thermal"), "models"),
               "thermal.models is empty, so there is no model to heat.",
               "Give heat.models, such as [\"" + thermal_kinds().front()->name + "\"].");
  c->bearing = chosen_bearing(c->drop, *p.heat, table, faults);
  c->history = make_heat_history(*p.heat, table, p.thermal, c->bearing, read_recorded_heat, faults);
  faults.throw_if_any();
  c->output_times = p.heat->output_times;
  c->end_time = p.heat->end_time.value_or(c->output_times.empty() ? 0. : c->output_times.back());
  if (c->output_times.empty() || c->output_times.back() < c->end_time) c->output_times.push_back(c->end_time);
  check_fields(*c, faults);
  build_models(*c);
  ProbeFinder(*c, table, faults).find_all();
  faults.throw_if_any();
  return c;
}

std::string bearing_heat_case_text(const BearingHeatCase& c) {
  std::string models;
  for (const auto& model : c.models) models += (models.empty() ? "" : ", ") + model.name;
  return fmt::format("bearing {}: models {}; {:.6g} J in {} changes; {} probes at {} times up to {:.6g} s\n", c.bearing,
                     models, c.history.turnover(c.end_time), c.history.changes().size(), c.probes.size(),
                     c.output_times.size(), c.end_time) +
         limits_left_out_text(c);
}

std::string limits_left_out_text(const BearingHeatCase& c) {
  return c.drop.parameters.limits.empty()
             ? ""
             : "the case's [limits] are those of a drop (rotordrop run): none of them is assessed here\n";
}

}  // namespace rotordrop
