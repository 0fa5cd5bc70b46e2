#include "study/heat/bearing_heat_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/cpu_time.h"
#include "base/errors.h"
#include "base/version.h"
#include "io/checkpoint.h"
#include "io/hdf5/field_series.h"
#include "io/hdf5/hdf5_version.h"
#include "io/hdf5/recorder.h"
#include "io/results_folder.h"
#include "study/drop/warning_summary.h"
#include "study/heat/heat_balance.h"
#include "study/heat/heat_guards.h"
#include "study/heat/recorded_heat.h"

namespace rotordrop {

namespace {

using Json = nlohmann::ordered_json;

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
  const RecordHeader header{{{"program", program_name()},
                             {"git_revision", git_revision()},
                             {"hdf5_version", hdf5_version()},
                             {"case", c.drop.name}},
                            {{"/parameters", c.drop.resolved.text}}};
  RecorderOptions recorder_options;
  recorder_options.overwrite = options.force;
  return {options.directory / "results.h5", header, {series}, recorder_options};
}

/// One computation from start to end.
class BearingHeatRun {
 public:
  BearingHeatRun(BearingHeatCase& c, const HeatRunOptions& options) : case_(c), options_(options), guards_(c) {
    const auto& fe = c.drop.parameters.thermal.fe;
    if (has_section()) field_times_ = FieldTimes(fe.field_times, fe.field_interval.value_or(0.));
  }

  Json run() {
    if (is_first_rank()) {
      folder_.emplace(options_.directory, ResultsFolder::existing_results(false, options_.force));
      recorder_.emplace(make_recorder(case_, options_));
      write_text_atomically(options_.directory / "parameters.toml", case_.drop.resolved.text);
      if (!field_times_.empty()) fields_.emplace(options_.directory / "fields", case_.bearing);
    }
    probes_.resize(case_.probes.size());
    growth_.resize(case_.models.size());
    const double start = cpu_seconds();
    for (auto& model : case_.models) model.heated->ask_between_steps([this] { stop_if_asked(); });
    bool is_complete = true;
    try {
      advance_all();
    } catch (const HeatStopped&) {
      is_complete = false;
    }
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
  /// @throws HeatStopped
  void stop_if_asked() const {
    const bool own = options_.stop && *options_.stop;
    if (has_section() ? case_.elements.sections.front().solver->on_any_rank(own) : own) throw HeatStopped();
  }

  /// Heat changes its course at some times, and something is wanted at others: all are met exactly.
  void advance_all() {
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
      if (next_output == case_.output_times.end()) return;
      stop_if_asked();
      next_change = std::upper_bound(next_change, changes.end(), time_);
      double until = std::min(*next_output, next_field);
      if (next_change != changes.end()) until = std::min(until, *next_change);
      for (auto& model : case_.models)
        model.heated->advance(until, case_.history.heat(time_), case_.history.rate(time_));
      time_ = until;
      for (std::size_t m = 0; m < case_.models.size(); ++m)
        guards_.look(m, time_, case_.models[m].heated->temperatures());
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
    j["program"] = program_name();
    j["case"] = case_.drop.name;
    j["bearing"] = case_.bearing;
    j["probes"] = Json::object();
    for (std::size_t i = 0; i < probes_.size(); ++i)
      j["probes"][case_.probes[i].name] = {{"time", times_}, {"temperature", probes_[i]}};
    const auto joules = [&](HeatedPort port) { return case_.history.joules(port, time_); };
    const auto input_until = [&](double t) {
      double sum = 0.;
      for (const auto port : {HeatedPort::ring, HeatedPort::shaft, HeatedPort::inner, HeatedPort::outer})
        sum += case_.history.joules(port, t);
      return sum;
    };
    j["heat"] = {{"rub_into_ring", joules(HeatedPort::ring)},
                 {"rub_into_shaft", joules(HeatedPort::shaft)},
                 {"inner", joules(HeatedPort::inner)},
                 {"outer", joules(HeatedPort::outer)}};
    if (const auto& G = case_.ball_conduction)
      j["ball_conduction"] = {{"inner_to_ball", G->inner_to_ball},
                              {"outer_to_ball", G->outer_to_ball},
                              {"inner_to_outer", G->inner_to_outer}};
    j["warnings"] = warnings_json(guards_.found());
    for (std::size_t m = 0; m < case_.models.size(); ++m) {
      const auto& [name, heated] = case_.models[m];
      Json& growth = j["growth"][name];
      growth["time"] = times_;
      for (std::size_t k = 0; k < growth_surfaces.size(); ++k) {
        Json& values = growth[growth_surface_keys.at(k)] = Json::array();
        for (const auto& expansion : growth_[m]) values.push_back(expansion.*growth_surfaces[k]);
      }
      // One that was stopped within its steps stands elsewhere than the others.
      const Json& balance = j["energy"][name] =
          heat_balance(input_until(heated->time()), heated->stored(), heated->lost());
      for (auto& warning : heat_balance_warnings(name, balance)) j["warnings"].push_back(std::move(warning));
      heated->report(j["models"][name]);
    }
    return j;
  }

  BearingHeatCase& case_;
  const HeatRunOptions& options_;
  HeatGuards guards_;
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

Json run_bearing_heat(BearingHeatCase& heat_case, const HeatRunOptions& options) {
  return BearingHeatRun(heat_case, options).run();
}

std::string bearing_heat_summary_text(const Json& j) {
  std::string text;
  for (const auto& [name, probe] : j["probes"].items())
    if (!probe["time"].empty())
      text += fmt::format("{}: {:.4f} K at {:.6g} s\n", name, probe["temperature"].back().get<double>(),
                          probe["time"].back().get<double>());
  for (const auto& [name, balance] : j["energy"].items()) text += heat_balance_text(", " + name, balance);
  for (const auto& [name, growth] : j["growth"].items())
    if (!growth["time"].empty())
      text += fmt::format("Growth, {}: bore {:.4g} um, inner race {:.4g} um, outer race {:.4g} um\n", name,
                          growth["bore"].back().get<double>() * 1e6, growth["inner_race"].back().get<double>() * 1e6,
                          growth["outer_race"].back().get<double>() * 1e6);
  return text;
}

}  // namespace rotordrop
