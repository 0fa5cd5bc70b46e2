#include "study/heat/bearing_heat_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/facts/given_conduction.h"
#include "base/cpu_time.h"
#include "base/errors.h"
#include "base/parameters/suggestion.h"
#include "base/version.h"
#include "case/bearing_mesh.h"
#include "case/fe_module.h"
#include "io/checkpoint.h"
#include "io/hdf5/field_series.h"
#include "io/hdf5/hdf5_version.h"
#include "io/hdf5/recorder.h"
#include "io/results_folder.h"
#include "io/text/toml_reader.h"
#include "study/heat/recorded_heat.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

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
  c.parts = build_thermal_models(p, c.drop.tree, c.bearing, c.elements, c.ball_conduction);
  FiniteElements::Section* section = c.elements.sections.empty() ? nullptr : &c.elements.sections.front();
  for (const auto& part : c.parts.models) {
    const bool is_fe = part.name == "fe";
    c.models.push_back({part.name, heated_model(*part.model, {.bearing = c.bearing,
                                                              .n_places = c.parts.n_places,
                                                              .place = c.parts.place,
                                                              .ambient = p.run.ambient,
                                                              .turnover = c.history.turnover(c.end_time),
                                                              .time_tolerance = p.heat->time_tolerance,
                                                              .section = is_fe ? section : nullptr})});
  }
  if (section && c.elements.coupling == FeCoupling::windowed) c.models.push_back({"fe", heated_mesh(*section)});
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
    while (fe < case_.models.size() && case_.models[fe].name != "fe") ++fe;
    if (fe == case_.models.size()) {
      fault(p, p.boundary ? "boundary" : "x",
            "points and boundaries need the finite elements, which are not among the models.",
            "Add \"fe\" to heat.models, or give a node of the circuit.");
      return;
    }
    BearingHeatCase::Probe probe{p.name, fe, {}, {}, 0, 0., 0.};
    if (p.boundary ? find_boundary(p, probe) : find_point(p, probe)) case_.probes.push_back(probe);
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
      fault(p, "node", fmt::format("both models have a \"{}\".", *p.node), "Add model = \"lumped\" or model = \"fe\".");
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

Recorder make_recorder(const BearingHeatCase& c, const HeatRunOptions& options) {
  SeriesGroup series{"/time", {}};
  for (const auto& probe : c.probes)
    series.channels.push_back({"/probes/" + probe.name,
                               "K",
                               probe.node       ? "temperature of a node or mean, model " + c.models[probe.model].name
                               : probe.boundary ? "mean temperature of a boundary"
                                                : "temperature at a point",
                               1,
                               {}});
  for (const auto& model : c.models)
    series.channels.push_back({"/growth/" + model.name,
                               "m",
                               "thermal growth by model " + model.name,
                               growth_surfaces.size(),
                               {growth_surface_names.begin(), growth_surface_names.end()}});
  const RecordHeader header{{{"program", std::string("rotordrop ") + version()},
                             {"git_revision", git_revision()},
                             {"hdf5_version", hdf5_version()},
                             {"case", c.drop.name}},
                            {{"/parameters", c.drop.resolved}}};
  RecorderOptions recorder_options;
  recorder_options.overwrite = options.force;
  return {options.directory / "results.h5", header, {series}, recorder_options};
}

/// One computation from start to end.
class BearingHeatRun {
 public:
  BearingHeatRun(BearingHeatCase& c, const HeatRunOptions& options) : case_(c), options_(options) {
    const auto& fe = c.drop.parameters.thermal.fe;
    if (has_section()) field_times_ = FieldTimes(fe.field_times, fe.field_interval.value_or(0.));
  }

  Json run() {
    if (is_first_rank()) {
      folder_.emplace(options_.directory,
                      options_.force ? ResultsFolder::Existing::replace : ResultsFolder::Existing::refuse);
      recorder_.emplace(make_recorder(case_, options_));
      write_text_atomically(options_.directory / "parameters.toml", case_.drop.resolved);
      if (!field_times_.empty()) fields_.emplace(options_.directory / "fields", case_.bearing);
    }
    probes_.resize(case_.probes.size());
    growth_.resize(case_.models.size());
    const double start = cpu_seconds();
    const bool is_complete = advance_all();
    const double end = cpu_seconds();
    if (recorder_) recorder_->close();
    if (folder_) folder_->require_there();
    Json j = summary();
    j["cpu_time"] = end - start;
    j["end_time"] = time_;
    j["completed"] = is_complete;
    if (recorder_) write_text_atomically(options_.directory / "summary.json", j.dump(2) + "\n");
    return j;
  }

 private:
  [[nodiscard]] bool has_section() const { return !case_.elements.sections.empty(); }
  [[nodiscard]] bool is_stopped() const {
    const bool own = options_.stop && *options_.stop;
    return has_section() ? case_.elements.sections.front().solver->on_any_rank(own) : own;
  }

  /// Heat changes its course at some times, and something is wanted at others: all are met exactly.
  bool advance_all() {
    const auto changes = case_.history.changes();
    auto next_change = changes.begin();
    auto next_output = case_.output_times.begin();
    double next_field = field_times_.after(-1.);
    while (true) {
      if (time_ >= next_field) {
        write_fields();
        next_field = field_times_.after(time_);
      }
      if (next_output != case_.output_times.end() && time_ >= *next_output) {
        record();
        ++next_output;
      }
      if (next_output == case_.output_times.end()) return true;
      if (is_stopped()) return false;
      next_change = std::upper_bound(next_change, changes.end(), time_);
      double until = std::min(*next_output, next_field);
      if (next_change != changes.end()) until = std::min(until, *next_change);
      for (auto& model : case_.models)
        model.heated->advance(until, case_.history.heat(time_), case_.history.rate(time_));
      time_ = until;
    }
  }

  void record() {
    std::vector<double> row;
    std::vector<std::vector<double>> nodes;
    for (auto& model : case_.models) nodes.push_back(model.heated->temperatures());
    for (std::size_t i = 0; i < case_.probes.size(); ++i) {
      const auto& probe = case_.probes[i];
      auto& heated = *case_.models[probe.model].heated;
      row.push_back(probe.node       ? nodes[probe.model][*probe.node]
                    : probe.boundary ? heated.section()->mean_temperature(*probe.boundary)
                                     : heated.section()->temperature(probe.body, probe.x, probe.r));
      probes_[i].push_back(row.back());
    }
    for (std::size_t m = 0; m < case_.models.size(); ++m) {
      growth_[m].push_back(case_.models[m].heated->growth());
      for (const double value : growth_values(growth_[m].back())) row.push_back(value);
    }
    times_.push_back(time_);
    if (recorder_) recorder_->append(0, time_, row);
  }

  void write_fields() {
    if (!fields_) return;
    for (auto& model : case_.models)
      if (const auto* section = model.heated->section())
        fields_->add(time_, [&](const std::string& file) { section->write_vtu(file); });
  }

  [[nodiscard]] Json summary() {
    Json j;
    j["case"] = case_.drop.name;
    j["bearing"] = case_.bearing;
    j["probes"] = Json::object();
    for (std::size_t i = 0; i < probes_.size(); ++i)
      j["probes"][case_.probes[i].name] = {{"time", times_}, {"temperature", probes_[i]}};
    const auto joules = [&](HeatedPort port) { return case_.history.joules(port, time_); };
    j["heat"] = {{"rub_into_ring", joules(HeatedPort::ring)},
                 {"rub_into_shaft", joules(HeatedPort::shaft)},
                 {"inner", joules(HeatedPort::inner)},
                 {"outer", joules(HeatedPort::outer)}};
    if (const auto& G = case_.ball_conduction)
      j["ball_conduction"] = {{"inner_to_ball", G->inner_to_ball},
                              {"outer_to_ball", G->outer_to_ball},
                              {"inner_to_outer", G->inner_to_outer}};
    double input = 0.;
    for (const auto& entry : j["heat"].items()) input += entry.value().get<double>();
    for (std::size_t m = 0; m < case_.models.size(); ++m) {
      const auto& [name, heated] = case_.models[m];
      Json& growth = j["growth"][name];
      growth["time"] = times_;
      for (std::size_t k = 0; k < growth_surfaces.size(); ++k) {
        Json& values = growth[growth_surface_keys.at(k)] = Json::array();
        for (const auto& expansion : growth_[m]) values.push_back(expansion.*growth_surfaces[k]);
      }
      const double stored = heated->stored(), lost = heated->lost();
      j["energy"][name] = {{"input", input}, {"stored", stored}, {"lost", lost}, {"residual", input - stored - lost}};
      heated->report(j["models"][name]);
    }
    return j;
  }

  BearingHeatCase& case_;
  const HeatRunOptions& options_;
  FieldTimes field_times_;
  std::optional<ResultsFolder> folder_;
  std::optional<Recorder> recorder_;
  std::optional<FieldSeries> fields_;
  double time_ = 0;
  std::vector<double> times_;
  std::vector<std::vector<double>> probes_;
  std::vector<std::vector<Expansion>> growth_;
};

}  // namespace

bool is_bearing_heat_case(const std::filesystem::path& file) {
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
  if (p.heat->models) {
    p.thermal.has_lumped = p.heat->models->has_lumped;
    p.thermal.has_fe = p.heat->models->has_fe;
  }
  // Nobody's growth is fed back into anything.
  p.thermal.driver = GrowthDriver::none;
  if (!p.thermal.has_fe && p.thermal.expansion == GrowthSource::elastic) p.thermal.expansion = GrowthSource::formula;
  Faults faults;
  check_machine(p, c->drop.tree, faults);
  c->bearing = chosen_bearing(c->drop, *p.heat, table, faults);
  c->history = make_heat_history(*p.heat, table, p.thermal, c->bearing, read_recorded_heat, faults);
  faults.throw_if_any();
  c->output_times = p.heat->output_times;
  c->end_time = p.heat->end_time.value_or(c->output_times.empty() ? 0. : c->output_times.back());
  if (c->output_times.empty() || c->output_times.back() < c->end_time) c->output_times.push_back(c->end_time);
  build_models(*c);
  ProbeFinder(*c, table, faults).find_all();
  faults.throw_if_any();
  return c;
}

Json run_bearing_heat(BearingHeatCase& heat_case, const HeatRunOptions& options) {
  return BearingHeatRun(heat_case, options).run();
}

std::string bearing_heat_case_text(const BearingHeatCase& c) {
  std::string models;
  for (const auto& model : c.models) models += (models.empty() ? "" : ", ") + model.name;
  return fmt::format("bearing {}: models {}; {:.6g} J in {} changes; {} probes at {} times up to {:.6g} s\n", c.bearing,
                     models, c.history.turnover(c.end_time), c.history.changes().size(), c.probes.size(),
                     c.output_times.size(), c.end_time);
}

std::string bearing_heat_summary_text(const Json& j) {
  std::string text;
  for (const auto& [name, probe] : j["probes"].items())
    if (!probe["time"].empty())
      text += fmt::format("{}: {:.4f} K at {:.6g} s\n", name, probe["temperature"].back().get<double>(),
                          probe["time"].back().get<double>());
  for (const auto& [name, e] : j["energy"].items())
    text += fmt::format("Energy, {}: {:.6g} J in, {:.6g} J stored, {:.6g} J lost, residual {:.1e} J\n", name,
                        e["input"].get<double>(), e["stored"].get<double>(), e["lost"].get<double>(),
                        e["residual"].get<double>());
  for (const auto& [name, growth] : j["growth"].items())
    if (!growth["time"].empty())
      text += fmt::format("Growth, {}: bore {:.4g} um, inner race {:.4g} um, outer race {:.4g} um\n", name,
                          growth["bore"].back().get<double>() * 1e6, growth["inner_race"].back().get<double>() * 1e6,
                          growth["outer_race"].back().get<double>() * 1e6);
  return text;
}

}  // namespace rotordrop
