#include "study/heat/heat_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "analysis/facts/material_slips.h"
#include "base/cpu_time.h"
#include "base/errors.h"
#include "base/version.h"
#include "case/modules/fe_module.h"
#include "case/program_files.h"
#include "case/slips/kinds_of_files.h"
#include "case/usual_values.h"
#include "io/checkpoint.h"
#include "io/hdf5/field_series.h"
#include "io/hdf5/hdf5_version.h"
#include "io/hdf5/recorder.h"
#include "io/results_folder.h"
#include "io/text/parameter_writers.h"
#include "io/text/toml_reader.h"
#include "machine/machine_parameters.h"
#include "study/heat/heat_balance.h"
#include "study/heat/heat_displacements.h"
#include "study/heat/recorded_heat.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

int number_in(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : otherwise;
}

Recorder make_recorder(const HeatCase& heat_case, const HeatRunOptions& options) {
  SeriesGroup series{"/time", {}};
  for (const auto& probe : heat_case.study.probes)
    series.channels.push_back({"/probes/" + probe.name,
                               "K",
                               probe.boundary ? "mean temperature of a boundary" : "temperature at a point",
                               1,
                               {}});
  if (heat_case.study.elastic) append_displacement_channels(*heat_case.study.elastic, series.channels);
  const RecordHeader header{{{"program", program_name()},
                             {"git_revision", git_revision()},
                             {"hdf5_version", hdf5_version()},
                             {"case", heat_case.name}},
                            {{"/parameters", heat_case.resolved}}};
  RecorderOptions recorder_options;
  recorder_options.overwrite = options.force;
  return {options.directory / "results.h5", header, {series}, recorder_options};
}

std::vector<double> probe_values(const HeatConductionSolver& solver, const std::vector<HeatProbe>& probes) {
  std::vector<double> values;
  for (const auto& probe : probes)
    values.push_back(probe.boundary ? solver.mean_temperature(*probe.boundary)
                                    : solver.temperature(probe.body, probe.x, probe.r));
  return values;
}

/// Fluxes name results beside the file that names them, or in the working folder on the command line. The full path is kept, so that the case as
/// resolved runs from anywhere.
void complete_recorded_paths(Node& tree) {
  Node* fluxes = tree.find("flux");
  if (!fluxes || !fluxes->is_array()) return;
  for (Node& flux : fluxes->items()) {
    const Node* file = flux.is_table() ? flux.find("recorded") : nullptr;
    if (!file || !file->is_text()) continue;
    const SourcePosition where = file->where(), key = position_of(flux, "recorded");
    fs::path path = file->text();
    if (path.is_relative() && where.line != 0) path = fs::path(where.file.text()).parent_path() / path;
    std::error_code ignored;
    flux.set("recorded", Node(fs::absolute(path, ignored).lexically_normal().string(), where), key);
  }
}

}  // namespace

bool is_first_rank() { return number_in("OMPI_COMM_WORLD_RANK", number_in("PMI_RANK", 0)) == 0; }

std::vector<ErasedSection> heat_sections() { return {heat_section(default_materials()).erased()}; }

bool is_heat_case(const fs::path& file) {
  look_for_file(file);
  const Node tree = read_toml(file);
  return tree.has("heat") || kind_of_file(tree) == FileKind::heat;
}

HeatCase read_heat_case(const fs::path& file, const std::vector<std::string>& overrides) {
  HeatCase result;
  result.file = file;
  result.name = file.stem().string();
  Node tree = read_toml(file);
  for (const auto& assignment : overrides) apply_override(tree, assignment);
  // Of the built-in materials, what a case says replaces key by key.
  if (const Node* materials = tree.find("materials"); materials && materials->is_table()) {
    const SourcePosition where = position_of(tree, "materials");
    tree.set("materials", merged(default_materials(), *materials), where);
  }
  complete_recorded_paths(tree);
  Faults faults;
  const auto section = heat_section(default_materials());
  const auto parameters = section.read(tree, faults);
  faults.throw_if_any();
  result.study = make_heat_study(parameters, tree, read_recorded_heat, faults);
  faults.throw_if_any();
  look_for_unusual_values(*section.erased(), tree, result.warnings);
  for (const auto& [name, m] : parameters.materials)
    for (const auto& slip : material_slips("the material " + name, {m.rho, m.E, m.k, m.c, m.nu, m.alpha})) {
      const Node* table = tree.find("materials") ? tree.find("materials")->find(name) : nullptr;
      result.warnings.push_back(
          {table ? position_of_value(*table, slip.key) : tree.where(), slip.message, slip.advice});
    }
  result.resolved = resolve({section.erased()}, tree).text;
  return result;
}

Json run_heat(const HeatCase& heat_case, const HeatRunOptions& options) {
  const auto& study = heat_case.study;
  // The module first: where it is missing, nothing is written.
  const double start_0 = cpu_seconds();
  const auto solver = make_heat_solver(study.problem);
  static_cast<void>(solver->energy());  // sets it up, if it kept what it is asked first
  std::optional<HeatDisplacements> displacements;
  if (study.elastic) displacements.emplace(*study.elastic, *solver);
  std::optional<Recorder> recorder;
  std::optional<FieldSeries> fields;
  const FieldTimes field_times(study.field_times, study.field_interval);
  std::optional<ResultsFolder> folder;
  if (is_first_rank()) {
    folder.emplace(options.directory, ResultsFolder::existing_results(false, options.force));
    recorder.emplace(make_recorder(heat_case, options));
    write_text_atomically(options.directory / "parameters.toml", heat_case.resolved);
    if (!field_times.empty()) fields.emplace(options.directory / "fields", "temperature");
  }
  const auto write_field = [&](double t) {
    if (fields) fields->add(t, [&](const std::string& file) { solver->write_vtu(file); });
  };

  Json j;
  j["program"] = program_name();
  j["case"] = heat_case.name;
  std::vector<double> times;
  std::vector<std::vector<double>> series(study.probes.size());
  const double start = cpu_seconds();
  bool completed = true;
  double next_field = field_times.after(-1.);
  if (next_field == 0.) {
    write_field(0.);
    next_field = field_times.after(0.);
  }
  solver->ask_between_steps([&] {
    if (solver->on_any_rank(options.stop && *options.stop)) throw HeatStopped();
  });
  try {
    for (const double t : study.output_times) {
      while (next_field <= t) {
        solver->advance_to(next_field);
        write_field(next_field);
        next_field = field_times.after(next_field);
      }
      solver->advance_to(t);
      auto values = probe_values(*solver, study.probes);
      times.push_back(t);
      for (std::size_t i = 0; i < values.size(); ++i) series[i].push_back(values[i]);
      if (displacements) displacements->observe(*solver, values);
      if (recorder) recorder->append(0, t, values);
    }
  } catch (const HeatStopped&) {
    completed = false;
  }
  const double end = cpu_seconds();
  if (recorder) recorder->close();
  if (folder) folder->require_there();

  j["probes"] = Json::object();
  for (std::size_t i = 0; i < study.probes.size(); ++i)
    j["probes"][study.probes[i].name] = {{"time", times}, {"temperature", series[i]}};
  if (displacements) displacements->report(times, j);
  const HeatEnergy e = solver->energy();
  j["energy"] = heat_balance(e.input, e.stored, e.lost);
  j["warnings"] = heat_balance_warnings("", j["energy"]);
  const HeatStatistics s = solver->statistics();
  j["solver"] = s.solver == HeatLinearSolver::multigrid ? "multigrid" : "direct";
  j["ranks"] = ranks_of_mpirun();
  j["unknowns"] = s.unknowns;
  j["cells"] = s.cells;
  j["steps"] = s.steps;
  j["rejected_steps"] = s.rejected_steps;
  j["factorisations"] = s.factorisations;
  j["cpu_time"] = end - start;
  j["setup_cpu_time"] = start - start_0;
  j["end_time"] = solver->time();
  j["completed"] = completed;
  if (recorder) write_text_atomically(options.directory / "summary.json", j.dump(2) + "\n");
  return j;
}

std::string heat_case_text(const HeatCase& heat_case) {
  const auto& problem = heat_case.study.problem;
  std::string bodies;
  for (const auto& body : problem.bodies) bodies += (bodies.empty() ? "" : ", ") + body.name;
  std::size_t n_steps = 0;
  for (const auto& flux : problem.fluxes) n_steps += flux.times.size();
  return fmt::format(
      "bodies: {}; {} fluxes in {} steps, {} convections, {} fixed temperatures, {} interfaces\n{} probes at {} times "
      "up to {:.6g} s\n",
      bodies, problem.fluxes.size(), n_steps, problem.convections.size(), problem.fixed.size(),
      problem.interfaces.size(), heat_case.study.probes.size(), heat_case.study.output_times.size(),
      heat_case.study.output_times.back());
}

std::string heat_summary_text(const Json& j) {
  std::string text;
  for (const auto& [name, probe] : j["probes"].items())
    if (!probe["time"].empty())
      text += fmt::format("{}: {:.4f} K at {:.6g} s\n", name, probe["temperature"].back().get<double>(),
                          probe["time"].back().get<double>());
  if (j.contains("displacements"))
    for (const auto& [name, place] : j["displacements"].items())
      if (!place["time"].empty())
        text += fmt::format("{}: moved {:.4g} um along the axis, {:.4g} um by radius at {:.6g} s\n", name,
                            place["axial"].back().get<double>() * 1e6, place["radial"].back().get<double>() * 1e6,
                            place["time"].back().get<double>());
  if (j.contains("fits"))
    for (const auto& [name, fit] : j["fits"].items())
      if (!fit["time"].empty())
        text += fmt::format("{}: mean pressure {:.4g} MPa, {:.3g} % open at {:.6g} s\n", name,
                            fit["mean_pressure"].back().get<double>() * 1e-6,
                            fit["open_fraction"].back().get<double>() * 100., fit["time"].back().get<double>());
  text += heat_balance_text("", j["energy"]);
  text += fmt::format("{} unknowns, {} steps, {:.3g} s of CPU after {:.3g} s of set-up\n", j["unknowns"].get<long>(),
                      j["steps"].get<long>(), j["cpu_time"].get<double>(), j["setup_cpu_time"].get<double>());
  return text;
}

}  // namespace rotordrop
