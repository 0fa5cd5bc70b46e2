#include "cli/commands.h"

#include <fmt/format.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/version.h"
#include "cli/progress_line.h"
#include "integrate/sundials_version.h"
#include "io/checkpoint.h"
#include "io/hdf5_version.h"
#include "io/parameter_writers.h"
#include "machine/build_machine.h"
#include "machine/rotor_report.h"
#include "study/bearing_mesh.h"
#include "study/case.h"
#include "study/drop_run.h"
#include "study/fe_module.h"
#include "study/heat_run.h"
#include "study/modes_report.h"
#include "study/new_case.h"
#include "study/statics_report.h"
#include "study/summary.h"

namespace rotordrop {
namespace {

volatile std::sig_atomic_t caught_signal = 0;

extern "C" void remember_signal(int signal) { caught_signal = signal; }

// A first signal ends the run after the current step; a second one kills the program.
void catch_signals() {
  struct sigaction action = {};
  action.sa_handler = remember_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

/// As a shell takes it.
std::string quoted(const std::string& word) {
  if (word.find_first_of(" \t'\"\\$&|;<>()*?[]{}!#~`") == std::string::npos) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string driver_in_words(const ThermalParameters& t) {
  if (!t.growth) return "nothing (thermal.growth = false)";
  switch (driver_of(t)) {
    case GrowthDriver::lumped:
      return "lumped thermal circuit";
    case GrowthDriver::fe:
      return "finite elements";
    case GrowthDriver::recorded:
      return "growth that an earlier run recorded";
    default:
      return "nothing (thermal.driver = \"none\")";
  }
}

std::string header(const Case& c) {
  const auto& p = c.parameters;
  std::string bearings;
  for (const auto& entry : p.bearings) bearings += (bearings.empty() ? "" : ", ") + entry.name;
  return fmt::format(
      "rotordrop {} ({})   case {}\nrotor {:.4g} kg at {:.6g} rpm; supports {}; expansion driven by the {}\n",
      version(), git_revision(), c.name, rotor_report(p.rotor).body.mass, p.run.initial_speed * 30. / std::numbers::pi,
      bearings, driver_in_words(p.thermal));
}

int check_heat_case(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const HeatCase heat_case = read_heat_case(file, overrides);
  fmt::print("rotordrop {} ({})   heat conduction, case {}\n{}", version(), git_revision(), heat_case.name,
             heat_case_text(heat_case));
  fmt::print("{}: no faults. Run it with `rotordrop heat`. Not checked: whether the mesh is fine enough.\n",
             file.string());
  return 0;
}

}  // namespace

std::string version_text() {
  return fmt::format("rotordrop {} (revision {}; SUNDIALS {}, HDF5 {})", version(), git_revision(), sundials_version(),
                     hdf5_version());
}

int run_command(const RunCommand& command) {
  const Case drop_case = read_case(command.file, command.overrides);
  RunOptions options;
  options.directory = command.directory.empty() ? std::filesystem::path("out") / drop_case.name : command.directory;
  options.force = command.force;
  options.resume = command.resume;
  options.stop = &caught_signal;
  options.tell = [](const std::string& text) { fmt::print(stderr, "note: {}\n", text); };
  ProgressLine line;
  if (line.is_shown() && !command.quiet) options.report = [&](const Progress& p) { line.show(p); };

  FiniteElements elements = finite_elements_of(drop_case);
  const auto machine = build_machine(drop_case.parameters, drop_case.tree, &elements);
  options.elements = &elements;
  if (!command.quiet) fmt::print("{}", header(drop_case));
  std::fflush(stdout);
  catch_signals();
  DropResult result;
  try {
    result = run_drop(drop_case, *machine, options);
  } catch (...) {
    line.finish();
    throw;
  }
  line.finish();
  if (!command.quiet) {
    std::ifstream file(options.directory / "summary.json");
    fmt::print("{}", summary_text(nlohmann::ordered_json::parse(file)));
    fmt::print("{} steps, {:.3g} s; results in {}\n", result.statistics.steps, result.wall_time,
               options.directory.string());
  }
  if (result.completed) return 0;
  std::string again =
      fmt::format("rotordrop run {} -o {} --resume", quoted(command.file.string()), quoted(options.directory.string()));
  for (const auto& assignment : command.overrides) again += " --set " + quoted(assignment);
  fmt::print(stderr, "interrupted at t = {:.6g} s; what was computed is in {}. Go on with: {}\n", result.end_time,
             options.directory.string(), again);
  return 128 + static_cast<int>(caught_signal);
}

int check_command(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  if (is_heat_case(file)) return check_heat_case(file, overrides);
  const Case c = read_case(file, overrides);
  FiniteElements elements = finite_elements_of(c);
  build_machine(c.parameters, c.tree, &elements);
  fmt::print("{}", header(c));
  const auto report = rotor_report(c.parameters.rotor);
  fmt::print("rotor: {:.4f} kg, Ip {:.6g} kg m2, Id {:.6g} kg m2, centre of gravity at {:.4f} m\n", report.body.mass,
             report.body.Ip, report.body.Id, report.body.centre_of_gravity);
  fmt::print("{}: no faults. Not checked: whether the step suits the stiffest contact.\n", file.string());
  return 0;
}

int defaults_command(bool heat) {
  fmt::print("{}", write_defaults(heat ? heat_sections() : case_sections()));
  return 0;
}

int schema_command(bool heat) {
  fmt::print("{}", write_json_schema(heat ? heat_sections() : case_sections()));
  return 0;
}

int new_command(const std::filesystem::path& directory) {
  const auto file = new_case(directory);
  write_text_atomically(directory / "schema.json", write_json_schema(case_sections()));
  fmt::print("A case to start from: {}\nRun it with: rotordrop run {}\n", file.string(), file.string());
  return 0;
}

int heat_command(const HeatCommand& command) {
  const HeatCase heat_case = read_heat_case(command.file, command.overrides);
  HeatRunOptions options;
  options.directory = command.directory.empty() ? std::filesystem::path("out") / heat_case.name : command.directory;
  options.force = command.force;
  options.stop = &caught_signal;
  catch_signals();
  const auto summary = run_heat(heat_case, options);
  if (!command.quiet) {
    fmt::print("rotordrop {} ({})   heat conduction, case {}\n{}", version(), git_revision(), heat_case.name,
               heat_summary_text(summary));
    fmt::print("results in {}\n", options.directory.string());
  }
  if (summary["completed"].get<bool>()) return 0;
  fmt::print(stderr, "interrupted; what was computed is in {}\n", options.directory.string());
  return 128 + static_cast<int>(caught_signal);
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

int statics_command(const StaticsCommand& command) {
  auto overrides = command.overrides;
  if (!command.bearing.empty()) overrides.emplace_back("statics.subject=bearings");
  const Case c = read_case(command.file, overrides);
  const auto report = find_rest(c, command.bearing);
  if (command.json)
    fmt::print("{}\n", report.dump(2));
  else
    fmt::print("rotordrop {} ({})   statics, case {}\n{}", version(), git_revision(), c.name, statics_text(report));
  return 0;
}

}  // namespace rotordrop
