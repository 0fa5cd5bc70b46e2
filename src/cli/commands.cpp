#include "cli/commands.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "analysis/facts/bearing_report.h"
#include "analysis/facts/rotor_report.h"
#include "base/errors.h"
#include "base/version.h"
#include "base/wide_vectors.h"
#include "case/bearing_mesh.h"
#include "case/case.h"
#include "case/fe_module.h"
#include "case/new_case.h"
#include "case/recorded_growth.h"
#include "cli/progress_line.h"
#include "cli/signals.h"
#include "integrate/sundials_version.h"
#include "io/checkpoint.h"
#include "io/hdf5/hdf5_version.h"
#include "io/text/parameter_writers.h"
#include "machine/build_machine.h"
#include "study/compare/calibration.h"
#include "study/compare/comparison.h"
#include "study/compare/measured_report.h"
#include "study/drop/drop_run.h"
#include "study/drop/summary.h"
#include "study/heat/bearing_heat_run.h"
#include "study/heat/heat_run.h"
#include "study/many/study_file.h"
#include "study/modes/critical_speeds_report.h"
#include "study/modes/modes_report.h"
#include "study/preload/preload_run.h"
#include "study/report/report.h"
#include "study/statics/shoulder_words.h"
#include "study/statics/statics_report.h"

namespace rotordrop {
namespace {

/// As a shell takes it.
std::string quoted(const std::string& word) {
  if (word.find_first_of(" \t'\"\\$&|;<>()*?[]{}!#~`") == std::string::npos) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string driver_in_words(const ThermalParameters& t) {
  if (!t.growth) return "none (thermal.growth = false)";
  switch (driver_of(t)) {
    case GrowthDriver::lumped:
      return "lumped thermal circuit";
    case GrowthDriver::fe:
      return "finite elements";
    case GrowthDriver::recorded:
      return "recorded by an earlier run";
    default:
      return "none (thermal.driver = \"none\")";
  }
}

std::string header(const Case& c) {
  const auto& p = c.parameters;
  std::string bearings;
  for (const auto& entry : p.bearings) bearings += (bearings.empty() ? "" : ", ") + entry.name;
  return fmt::format(
      "rotordrop {} ({})   case {}\nrotor {:.4g} kg at {:.6g} rpm; supports {}; thermal growth fed back: {}\n",
      version(), git_revision(), c.name, rotor_report(p.rotor).body.mass, p.run.initial_speed * 30. / std::numbers::pi,
      bearings, driver_in_words(p.thermal));
}

/// What is unusual in a case; faults if `strict`.
void tell_warnings(const Case& c, bool strict) {
  if (strict) {
    Faults faults;
    for (const auto& warning : c.warnings)
      faults.add(warning.where, warning.message, warning.advice + "\nWithout --strict this is a warning.");
    faults.throw_if_any();
  }
  for (const auto& warning : c.warnings)
    fmt::print(stderr, "warning{}\n", rendered(warning).substr(std::string_view("error").size()));
}

double parse_time(const char* option, const std::string& text) {
  const auto time = convert_to_si(text, "s", QuantityKind::plain, "a time");
  if (!time) throw InputError({option, 0, 0}, time.error, time.advice);
  return time.value;
}

int check_heat_case(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const std::string text = is_bearing_heat_case(file) ? bearing_heat_case_text(*read_bearing_heat_case(file, overrides))
                                                      : heat_case_text(read_heat_case(file, overrides));
  fmt::print("rotordrop {} ({})   heat conduction, case {}\n{}", version(), git_revision(), file.stem().string(), text);
  fmt::print("{}: no errors found. Run it with `rotordrop heat`. Not checked: whether the mesh is fine enough{}.\n",
             file.string(), is_bearing_heat_case(file) ? ", and what only a drop needs" : "");
  return 0;
}

/// Of a run with both thermal models: the comparison beside its results.
void compare_after_run(const Case& drop_case, const RunCommand& command, const std::filesystem::path& directory,
                       const RecordedDrop& drop) {
  const auto& thermal = drop_case.parameters.thermal;
  if (!thermal.has_lumped || !thermal.has_fe || drop.bearings().empty()) return;
  Comparison comparison;
  try {
    comparison = compare_models(drop, nullptr, {});
  } catch (const InputError& error) {
    // The input was good: what came of it is not.
    throw SolverError(std::string("the run is complete, but its thermal models cannot be compared.\n") + error.what());
  }
  write_comparison(comparison, directory / "comparison.json");
  if (command.quiet) return;
  for (const auto& line : comparison.report["in_short"]) fmt::print("{}\n", line.get<std::string>());
}

ComparisonOptions comparison_options(const CompareCommand& command) {
  ComparisonOptions options;
  if (!command.tolerance.empty()) options.temperature = parse_temperature_tolerance(command.tolerance);
  if (!command.floor.empty()) options.floor = parse_floor(command.floor);
  if (!command.growth_tolerance.empty()) options.growth = parse_length(command.growth_tolerance, "--growth-tolerance");
  if (!command.times.empty()) options.instants = parse_instants(command.times);
  if (!command.band_length.empty()) options.band_length = parse_length(command.band_length, "--band-length");
  return options;
}

/// Its own comparison a directory of results may lose; other files only with --force.
std::filesystem::path comparison_file(const CompareCommand& command) {
  if (command.output.empty()) return command.directory / "comparison.json";
  const auto& file = command.output;
  if (file.extension() == ".h5")
    throw InputError({"--output", 0, 0},
                     "the report is JSON; its time series go to a file of the same name ending in .h5",
                     "Give a name such as comparison.json.");
  for (const auto& path : {file, comparison_series_file(file)})
    if (!command.force && std::filesystem::exists(path))
      throw InputError({path.string(), 0, 0}, "the file exists",
                       "Choose another with -o FILE, or replace it with --force.");
  return file;
}

std::vector<ErasedSection> sections_of(InputKind kind) {
  if (kind == InputKind::heat) return heat_sections();
  return kind == InputKind::study ? study_sections() : case_sections();
}

}  // namespace

std::string version_text() {
  return fmt::format("rotordrop {} (revision {}; SUNDIALS {}, HDF5 {}; instruction set {})", version(), git_revision(),
                     sundials_version(), hdf5_version(), name_of(vector_level));
}

int run_command(const RunCommand& command) {
  const Case drop_case = read_case(command.file, command.overrides);
  tell_warnings(drop_case, command.strict);
  RunOptions options;
  options.directory = command.directory.empty() ? std::filesystem::path("out") / drop_case.name : command.directory;
  options.force = command.force;
  options.resume = command.resume;
  options.stop = &caught_signal();
  options.tell = [](const std::string& text) { fmt::print(stderr, "note: {}\n", text); };
  ProgressLine line;
  if (line.is_shown() && !command.quiet) options.report = [&](const Progress& p) { line.show(p); };

  FiniteElements elements = finite_elements_of(drop_case);
  const auto machine = build_machine(drop_case.parameters, drop_case.tree, &elements, recorded_growth(drop_case));
  options.elements = &elements;
  if (!command.quiet) fmt::print("{}", header(drop_case));
  std::fflush(stdout);
  catch_signals();
  FinishedDrop result;
  try {
    result = run_drop(drop_case, *machine, options);
  } catch (...) {
    line.finish();
    throw;
  }
  line.finish();
  if (!command.quiet) {
    fmt::print("{}", summary_text(result.summary));
    fmt::print("{} steps, {:.3g} s; results in {}\n", result.statistics.steps, result.wall_time,
               options.directory.string());
  }
  if (result.completed) {
    compare_after_run(drop_case, command, options.directory, *result.recorded);
    return 0;
  }
  std::string again =
      fmt::format("rotordrop run {} -o {} --resume", quoted(command.file.string()), quoted(options.directory.string()));
  for (const auto& assignment : command.overrides) again += " --set " + quoted(assignment);
  fmt::print(stderr, "interrupted at t = {:.6g} s; results so far are in {}. Continue with: {}\n", result.end_time,
             options.directory.string(), again);
  return 128 + static_cast<int>(caught_signal());
}

int check_command(const std::filesystem::path& file, const std::vector<std::string>& overrides, bool strict) {
  if (is_heat_case(file)) return check_heat_case(file, overrides);
  const Case c = read_case(file, overrides);
  tell_warnings(c, strict);
  FiniteElements elements = finite_elements_of(c);
  build_machine(c.parameters, c.tree, &elements, recorded_growth(c));
  fmt::print("{}", header(c));
  const auto report = rotor_report(c.parameters.rotor);
  fmt::print("rotor: {:.4f} kg, Ip {:.6g} kg m2, Id {:.6g} kg m2, centre of gravity at {:.4f} m\n", report.body.mass,
             report.body.Ip, report.body.Id, report.body.centre_of_gravity);
  for (const auto& entry : c.parameters.bearings)
    if (entry.touchdown()) {
      fmt::print("{}", conventions_text(c.parameters, entry.name));
      fmt::print("{}", shoulder_text(shoulder_json(c.parameters, entry.name), entry.name.size() + 2));
    }
  fmt::print("{}", bearing_report(c.parameters));
  fmt::print(
      "{}: no errors found{}. Not checked: whether the time step is short enough for the stiffest contact.\n",
      file.string(),
      c.warnings.empty() ? "" : fmt::format(", {} warning{}", c.warnings.size(), c.warnings.size() > 1 ? "s" : ""));
  return 0;
}

int defaults_command(InputKind kind) {
  fmt::print("{}", write_defaults(sections_of(kind)));
  return 0;
}

int schema_command(InputKind kind) {
  fmt::print("{}", write_json_schema(sections_of(kind)));
  return 0;
}

int new_command(const std::filesystem::path& directory) {
  const auto file = new_case(directory);
  write_text_atomically(directory / "schema.json", write_json_schema(case_sections()));
  fmt::print("New case: {}\nRun it with: rotordrop run {}\n", file.string(), file.string());
  return 0;
}

int heat_command(const HeatCommand& command) {
  // Of the processes that mpirun starts one talks; all meet the same faults.
  if (!is_first_rank() && (!std::freopen("/dev/null", "w", stdout) || !std::freopen("/dev/null", "w", stderr)))
    return 1;
  HeatRunOptions options;
  options.directory =
      command.directory.empty() ? std::filesystem::path("out") / command.file.stem() : command.directory;
  options.force = command.force;
  options.stop = &caught_signal();
  nlohmann::ordered_json summary;
  const bool is_of_a_bearing = is_bearing_heat_case(command.file);
  if (is_of_a_bearing) {
    const auto heat_case = read_bearing_heat_case(command.file, command.overrides);
    catch_signals();
    summary = run_bearing_heat(*heat_case, options);
  } else {
    const HeatCase heat_case = read_heat_case(command.file, command.overrides);
    catch_signals();
    summary = run_heat(heat_case, options);
  }
  if (!command.quiet) {
    fmt::print("rotordrop {} ({})   heat conduction, case {}\n{}", version(), git_revision(),
               summary["case"].get<std::string>(),
               is_of_a_bearing ? bearing_heat_summary_text(summary) : heat_summary_text(summary));
    fmt::print("results in {}\n", options.directory.string());
  }
  if (summary["completed"].get<bool>()) return 0;
  fmt::print(stderr, "interrupted; results so far are in {}\n", options.directory.string());
  return 128 + static_cast<int>(caught_signal());
}

namespace {

int compare_measured_command(const CompareCommand& command) {
  const auto file = command.output.empty() ? command.directory / "measured.json" : command.output;
  if (!command.output.empty() && !command.force && std::filesystem::exists(file))
    throw InputError({file.string(), 0, 0}, "the file already exists",
                     "Choose another with -o FILE, or replace it with --force.");
  const auto measured = read_measured_file(command.measured);
  const RecordedDrop drop(command.directory);
  const MeasuredComparison comparison = compare_with_measured(drop, measured);
  const auto page = std::filesystem::path(file).replace_extension(".html");
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  write_text_atomically(file, comparison.report.dump(2) + "\n");
  write_text_atomically(page, comparison.page);
  if (!command.quiet)
    fmt::print("{}numbers in {}, figures in {}\n", measured_text(comparison.report["measured"]), file.string(),
               page.string());
  return 0;
}

}  // namespace

int compare_command(const CompareCommand& command) {
  if (!command.measured.empty()) return compare_measured_command(command);
  const ComparisonOptions options = comparison_options(command);
  const RecordedDrop drop(command.directory);
  std::optional<RecordedDrop> against;
  if (!command.against.empty()) against.emplace(command.against);
  const auto file = comparison_file(command);
  const Comparison comparison = compare_models(drop, against ? &*against : nullptr, options);
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  write_comparison(comparison, file);
  if (!command.quiet)
    fmt::print("rotordrop {} ({})   comparison, case {}\n{}report in {}\n", version(), git_revision(), drop.case_name(),
               comparison_text(comparison.report), file.string());
  return 0;
}

int report_command(const ReportCommand& command) {
  const RecordedDrop drop(command.directory);
  const auto file = command.output.empty() ? command.directory / "report.html" : command.output;
  if (!command.force && std::filesystem::exists(file))
    throw InputError({file.string(), 0, 0}, "the file already exists",
                     "Choose another with -o FILE, or replace it with --force.");
  const std::string page = report_page(report_data(drop));
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  write_text_atomically(file, page);
  if (!command.quiet) fmt::print("report of {} in {}\n", drop.case_name(), file.string());
  return 0;
}

int mesh_command(const MeshCommand& command) {
  const Case drop_case = read_case(command.file, command.overrides);
  MeshOptions options;
  options.file = command.output.empty() ? std::filesystem::path("out") / drop_case.name / "mesh.msh" : command.output;
  options.bearing = command.bearing;
  options.force = command.force;
  options.format = command.format == "2.2" ? MeshFileFormat::msh_2_2 : MeshFileFormat::msh_4_1;
  const auto text = write_bearing_meshes(drop_case, options);
  if (!command.quiet)
    fmt::print("rotordrop {} ({})   meshed sections, case {}\n{}", version(), git_revision(), drop_case.name, text);
  return 0;
}

int calibrate_command(const CalibrateCommand& command) {
  const Case c = read_case(command.file, command.overrides);
  CalibrationSettings settings;
  if (!command.until.empty()) settings.until = parse_time("--until", command.until);
  if (settings.until <= 2. * settings.from)
    throw InputError({"--until", 0, 0}, "responses are compared from 1 ms on; --until must be 2 ms at least.");
  const auto file =
      command.output.empty() ? command.file.parent_path() / (c.name + "-calibrated.toml") : command.output;
  if (!command.force && std::filesystem::exists(file))
    throw InputError({file.string(), 0, 0}, "the file already exists.",
                     "Choose another with -o FILE, or replace it with --force.");
  const auto bearings = calibrate(c, settings);
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  write_text_atomically(file, calibration_file(c, file, bearings, settings));
  if (!command.quiet)
    fmt::print("rotordrop {} ({})   circuits fitted to finite elements, case {}\n{}written to {}\n", version(),
               git_revision(), c.name, calibration_text(bearings), file.string());
  return 0;
}

int modes_command(const ModesCommand& command) {
  const Case c = read_case(command.file, command.overrides);
  const auto speeds =
      command.speeds.empty() ? std::vector<double>{0., c.parameters.run.initial_speed} : parse_speeds(command.speeds);
  const auto report = find_modes(c, speeds);
  if (command.json)
    fmt::print("{}\n", to_json(report, command.n_modes).dump(2));
  else
    fmt::print("{}", to_table(report, command.n_modes));
  const auto shapes = command.shapes.empty() ? std::filesystem::path("out") / c.name / "modes.h5" : command.shapes;
  if (shapes.has_parent_path()) std::filesystem::create_directories(shapes.parent_path());
  write_mode_shapes(report, command.n_modes, shapes);
  // Not on standard output, where the JSON may go into another program.
  fmt::print(stderr, "mode shapes in {}\n", shapes.string());
  return 0;
}

int critical_speeds_command(const CriticalSpeedsCommand& command) {
  const Case c = read_case(command.file, command.overrides);
  auto options = critical_speed_options(c, {command.up_to, command.stiffness, command.map});
  options.n_speeds = 61;
  if (!command.diagram.empty() && !command.force && std::filesystem::exists(command.diagram))
    throw InputError({command.diagram.string(), 0, 0}, "the file exists already.",
                     "Choose another with --diagram FILE, or replace it with --force.");
  const auto report = critical_speeds(c.parameters, options);
  const auto json = critical_speeds_json(c, report, options);
  if (command.json)
    fmt::print("{}\n", json.dump(2));
  else
    fmt::print("rotordrop {} ({})   critical speeds, case {}\n{}", version(), git_revision(), c.name,
               critical_speeds_text(json));
  const auto file = command.diagram.empty() ? std::filesystem::path("out") / c.name / "campbell.svg" : command.diagram;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  write_text_atomically(file, campbell_picture(report, options.up_to, json["operating_speed"].get<double>()));
  fmt::print(stderr, "Campbell diagram in {}\n", file.string());
  return 0;
}

/// The paper's growth takes uniform heating for preload.
void warn_of_growth(const CaseParameters& p) {
  const auto& s = p.statics;
  const bool is_warm = s.inner_rise != 0. || s.outer_rise != 0. || s.ball_rise != 0.;
  if (p.thermal.expansion == GrowthSource::paper && is_warm)
    fmt::print(
        stderr,
        "warning: thermal.expansion = \"paper\": rings grow at their shoulders and radially only, so that uniform "
        "heating changes the preload. Set thermal.expansion = \"formula\" for growth where balls touch.\n");
}

int statics_command(const StaticsCommand& command) {
  auto overrides = command.overrides;
  if (!command.bearing.empty()) overrides.emplace_back("statics.subject=bearings");
  const Case c = read_case(command.file, overrides);
  warn_of_growth(c.parameters);
  const auto report = find_rest(c, command.bearing);
  if (command.json)
    fmt::print("{}\n", report.dump(2));
  else
    fmt::print("rotordrop {} ({})   statics, case {}\n{}", version(), git_revision(), c.name, statics_text(report));
  return 0;
}

int preload_command(const PreloadCommand& command) {
  const Case c = read_case(command.file, command.overrides);
  PreloadOptions options;
  options.directory =
      command.directory.empty() ? std::filesystem::path("out") / (c.name + "-preload") : command.directory;
  options.bearing = command.bearing;
  options.results = command.results;
  options.force = command.force;
  const auto report = run_preload(c, options);
  if (command.json)
    fmt::print("{}\n", report.dump(2));
  else if (!command.quiet)
    fmt::print("rotordrop {} ({})   thermal preload, case {}\n{}results in {}\n", version(), git_revision(), c.name,
               preload_text(report), options.directory.string());
  return 0;
}

}  // namespace rotordrop
