#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "base/errors.h"
#include "base/memory.h"
#include "base/parameters/declaration.h"
#include "base/wide_vectors.h"
#include "case/case.h"
#include "cli/commands.h"
#include "cli/completion.h"
#include "cli/mistakes.h"
#include "cli/no_memory.h"
#include "cli/option_values.h"
#include "cli/study_commands.h"
#include "io/read_files.h"
#include "study/heat/heat_run.h"

namespace {

enum ExitCode { done = 0, run_failed = 1, bad_input = 2 };

// Options that several commands have.
template <class File>
void add_case(CLI::App& command, File& file) {
  command.add_option("case", file, "Parameter file")->required();
}

void add_overrides(CLI::App& command, std::vector<std::string>& overrides, const std::string& example = "") {
  command.add_option("--set", overrides, "Override a parameter" + (example.empty() ? "" : ": " + example))
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_force(CLI::App& command, bool& force, const std::string& what) {
  command.add_flag("--force", force, "Replace " + what);
}

void add_strict(CLI::App& command, bool& strict) {
  command.add_flag("--strict", strict, "Treat warnings about the case as faults");
}

void add_quiet(CLI::App& command, bool& quiet) { command.add_flag("--quiet", quiet, "Print only warnings and errors"); }

/// Declarations of all keys that some command takes with --set.
std::vector<rotordrop::ErasedSection> sections_of_keys() {
  auto sections = rotordrop::case_sections();
  for (auto& section : rotordrop::heat_sections()) sections.push_back(std::move(section));
  return sections;
}

int run_program(int argc, char** argv) {
  using namespace rotordrop;
  check_vector_level();
  CLI::App app("Drop of a magnetically levitated rotor onto its touchdown bearings.", "rotordrop");
  app.require_subcommand(1);
  app.set_version_flag("--version", version_text);  // asks HDF5, which has to begin for that

  RunCommand run;
  auto* run_app =
      app.add_subcommand("run", "Run a case; write results.h5, summary.json and parameters.toml to a directory.");
  add_case(*run_app, run.file);
  run_app->add_option("-o,--output", run.directory, "Directory for the results; default out/CASE");
  add_overrides(*run_app, run.overrides, "contact.friction_coefficient=0.05");
  add_force(*run_app, run.force, "existing results in the directory");
  run_app->add_flag("--resume", run.resume, "Continue an interrupted run");
  add_strict(*run_app, run.strict);
  run_app->add_flag("--accept", run.accept, "End with exit code 3 if a limit of the case is not met, or not assessed");
  add_quiet(*run_app, run.quiet);

  std::string check_file;
  std::vector<std::string> check_overrides;
  auto* check = app.add_subcommand("check", "Read and check a case (a drop or heat only) without running it.");
  add_case(*check, check_file);
  bool check_strict = false;
  add_strict(*check, check_strict);
  add_overrides(*check, check_overrides);

  ModesCommand modes;
  auto* modes_app =
      app.add_subcommand("modes", "Compute natural modes with the case's linear supports and magnets, or free-free.");
  add_case(*modes_app, modes.file);
  modes_app->add_option("--speeds", modes.speeds,
                        "Spin speeds, such as \"0 rpm,15200 rpm\"; default: 0 and the initial speed");
  modes_app->add_option("--modes", modes.n_modes, "Number of modes to report")->check(CLI::Range(1, 10000));
  modes_app->add_flag("--json", modes.json, "Print the report as JSON");
  modes_app->add_option("--shapes", modes.shapes, "HDF5 file for the mode shapes; default out/CASE/modes.h5");
  add_overrides(*modes_app, modes.overrides);

  CriticalSpeedsCommand critical;
  auto* critical_app = app.add_subcommand(
      "critical-speeds", "Critical speeds on the case's linear supports or on given springs; Campbell diagram.");
  add_case(*critical_app, critical.file);
  critical_app->add_option("--up-to", critical.up_to,
                           "Highest spin speed, such as \"20000 rpm\"; default: twice the initial speed");
  critical_app->add_option("--stiffness", critical.stiffness,
                           "Isotropic springs at the linear supports, or at all bearings of a case that has none");
  critical_app->add_option("--map", critical.map,
                           "Critical-speed map over the springs' stiffness, such as \"1e6 N/m, 1e9 N/m\"");
  critical_app->add_option("--diagram", critical.diagram,
                           "Picture, FILE.svg or FILE.png; default out/CASE/campbell.svg");
  critical_app->add_flag("--json", critical.json, "Report as JSON, with units");
  add_force(*critical_app, critical.force, "the picture given with --diagram");
  add_overrides(*critical_app, critical.overrides);

  HeatCommand heat;
  auto* heat_app = app.add_subcommand("heat",
                                      "Compute temperatures for prescribed heat input, without dynamics: plain "
                                      "sections (finite elements) or a touchdown bearing (circuit and section).");
  add_case(*heat_app, heat.file);
  heat_app->add_option("-o,--output", heat.directory, "Directory for the results; default out/CASE");
  add_overrides(*heat_app, heat.overrides, "fe.cells=16");
  add_force(*heat_app, heat.force, "existing results in the directory");
  add_quiet(*heat_app, heat.quiet);

  CompareCommand compare;
  auto* compare_app = app.add_subcommand("compare",
                                         "Compare the lumped circuit with the finite elements of a drop, or two drops, "
                                         "to see when the circuit can be trusted.");
  compare_app->add_option("directory", compare.directory, "Directory of a run's results")->required();
  compare_app->add_option("--against", compare.against, "Directory of another run");
  compare_app
      ->add_option("--measured", compare.measured,
                   "Measured series beside the drop: a table whose columns are called such as "
                   "\"/bearings/TB1/orbit[0] [um]\", or a TOML file with [[measured]]")
      ->excludes("--against");
  compare_app->add_option("--tolerance", compare.tolerance,
                          "Tolerance of temperatures: \"0.5 K\", or a part of the rise at the time; default \"5 %\"");
  compare_app->add_option("--floor", compare.floor,
                          "Smallest tolerance of temperatures if it is a part of the rise; default \"10 mK\"");
  compare_app->add_option("--growth-tolerance", compare.growth_tolerance,
                          "Tolerance for thermal growth and clearances; default \"0.1 um\"");
  compare_app->add_option("--times", compare.times,
                          "Times to report in addition to the peak of the first impact and the end; default \"10 ms\"");
  compare_app->add_option("--band-length", compare.band_length,
                          "Length of the rub contact along the surface; default: the case's thermal.rub_band_length");
  compare_app->add_option("-o,--output", compare.output,
                          "Report; default DIR/comparison.json, of measured series DIR/measured.json");
  add_force(*compare_app, compare.force, "the file given with -o");
  add_quiet(*compare_app, compare.quiet);

  ReportCommand report;
  auto* report_app = app.add_subcommand("report", "Write a run as one self-contained HTML page with figures.");
  report_app->add_option("directory", report.directory, "Directory of a run's results")->required();
  report_app->add_option("-o,--output", report.output, "File; default DIR/report.html");
  add_force(*report_app, report.force, "an existing file");
  add_quiet(*report_app, report.quiet);

  RerunCommand rerun;
  auto* rerun_app = app.add_subcommand(
      "rerun", "Run a recorded drop once more, from its result file alone, and compare the two bit by bit.");
  rerun_app->add_option("results", rerun.file, "results.h5 of a drop, or its directory")->required();
  rerun_app->add_option("-o,--output", rerun.directory, "Directory for the results; default out/CASE-rerun");
  add_force(*rerun_app, rerun.force, "existing results in the directory");
  add_quiet(*rerun_app, rerun.quiet);

  MeshCommand mesh;
  auto* mesh_app = app.add_subcommand("mesh", "Mesh the sections of the touchdown bearings; write a gmsh .msh file.");
  add_case(*mesh_app, mesh.file);
  mesh_app->add_option("-o,--output", mesh.output,
                       "File; default out/CASE/mesh.msh; with several bearings, one FILE-NAME.msh for each");
  mesh_app->add_option("--bearing", mesh.bearing, "Only this bearing");
  mesh_app->add_option("--format", mesh.format, "Version of the format")->check(CLI::IsMember({"4.1", "2.2"}));
  add_overrides(*mesh_app, mesh.overrides, "thermal.fe.refinement=2");
  add_force(*mesh_app, mesh.force, "existing files");
  add_quiet(*mesh_app, mesh.quiet);

  CalibrateCommand calibrate;
  auto* calibrate_app = app.add_subcommand(
      "calibrate", "Fit the lumped circuits to the finite elements; write a parameter file based on the case.");
  add_case(*calibrate_app, calibrate.file);
  calibrate_app->add_option("-o,--output", calibrate.output, "File; default CASE-calibrated.toml beside the case");
  calibrate_app->add_option("--until", calibrate.until, "Responses are compared up to this time; default 10 s");
  add_overrides(*calibrate_app, calibrate.overrides, "thermal.fe.refinement=2");
  add_force(*calibrate_app, calibrate.force, "an existing file");
  add_quiet(*calibrate_app, calibrate.quiet);

  StaticsCommand statics;
  auto* statics_app = app.add_subcommand("statics",
                                         "Compute the static equilibrium of the rotor on its supports, or of a bearing "
                                         "under load: ball loads, contact pressures, stiffness.");
  add_case(*statics_app, statics.file);
  statics_app->add_option("--bearing", statics.bearing,
                          "Only this touchdown bearing, on its own, loaded as in [statics]");
  statics_app->add_flag("--json", statics.json, "Report as JSON, with every ball");
  add_overrides(*statics_app, statics.overrides, "statics.inner_rise=\"20 K\"");

  PreloadCommand preload;
  auto* preload_app = app.add_subcommand("preload",
                                         "Compute the thermal preload of touchdown bearings: maps, history over a "
                                         "drop, steady running until it settles or runs away.");
  add_case(*preload_app, preload.file);
  preload_app->add_option("--bearing", preload.bearing, "Only this touchdown bearing");
  preload_app->add_option("--results", preload.results,
                          "Directory of a drop's results, for the preload history over that drop");
  preload_app->add_option("-o,--output", preload.directory, "Directory for the results; default out/CASE-preload");
  preload_app->add_flag("--json", preload.json, "Print the report as JSON");
  add_overrides(*preload_app, preload.overrides, "preload.speed=\"3000 rpm\"");
  add_force(*preload_app, preload.force, "existing results in the directory");
  add_quiet(*preload_app, preload.quiet);

  StudyCommands study(app);

  auto* defaults =
      app.add_subcommand("defaults", "Print every parameter with unit, range, default and source, as TOML.");
  bool heat_defaults = false, heat_schema = false, study_defaults = false, study_schema = false;
  defaults->add_flag("--heat", heat_defaults, "Parameters of a heat-only case (rotordrop heat)");
  defaults->add_flag("--study", study_defaults, "Parameters of a study file (rotordrop study)");
  auto* schema = app.add_subcommand("schema", "JSON Schema of case files, for editors.");
  schema->add_flag("--heat", heat_schema, "Schema of a heat-only case (rotordrop heat)");
  schema->add_flag("--study", study_schema, "Schema of a study file (rotordrop study)");
  NewCommand own;
  auto* fresh = app.add_subcommand("new", "Create a folder with a case to start from.");
  fresh->add_option("directory", own.directory, "Folder")->required();
  fresh->add_flag("--own", own.is_own,
                  "A machine of your own: a shaft as a table, bearings of the catalogue on ribbons, limits");
  fresh->add_option("--from", own.shaft, "The same with the shaft of a file: a table (.csv), TOML or JSON");

  std::string shell;
  auto* completion =
      app.add_subcommand("completion", "Print a script that completes commands, options and keys of --set in a shell.");
  completion->add_option("shell", shell, "Shell: bash, zsh or fish")
      ->required()
      ->type_name("SHELL")
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  std::string topic;
  auto* manual = app.add_subcommand("man", "Print a manual page in the format of man(7).");
  manual->add_option("topic", topic, "A command, or \"case\" for the parameters; default: the program")
      ->type_name("TOPIC");

  add_checks_of_values(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      app.exit(error);
      return done;
    }
    fmt::print(stderr, "{}", explained(app, error, {argv + 1, argv + argc}, sections_of_keys()));
    return bad_input;
  }
  if (*completion) {
    fmt::print("{}", completion_script(app, shell, case_sections()));
    return done;
  }
  if (*manual) {
    fmt::print("{}", manual_page(app, topic, case_sections()));
    return done;
  }
  const auto kind = [](bool of_heat, bool of_study) {
    return of_heat ? InputKind::heat : of_study ? InputKind::study : InputKind::drop;
  };
  const auto run_chosen = [&]() -> int {
    if (*run_app) return run_command(run);
    if (*rerun_app) return rerun_command(rerun);
    if (*check) return check_command(check_file, check_overrides, check_strict);
    if (*heat_app) return heat_command(heat);
    if (*compare_app) return compare_command(compare);
    if (*report_app) return report_command(report);
    if (*mesh_app) return mesh_command(mesh);
    if (*calibrate_app) return calibrate_command(calibrate);
    if (*modes_app) return modes_command(modes);
    if (*critical_app) return critical_speeds_command(critical);
    if (*preload_app) return preload_command(preload);
    if (*statics_app) return statics_command(statics);
    if (study.is_asked()) return study.run();
    if (*defaults) return defaults_command(kind(heat_defaults, study_defaults));
    if (*schema) return schema_command(kind(heat_schema, study_schema));
    if (*fresh) return new_command(own);
    return bad_input;
  };
  const auto* set = app.get_subcommands().front()->get_option_no_throw("--set");
  const auto overrides = set ? set->results() : std::vector<std::string>{};
  try {
    return run_chosen();
  } catch (const InputError& error) {
    throw with_right_forms(error, overrides, sections_of_keys());
  }
}

/// What names and permissions make impossible is for the user to change; the rest is the machine's.
int exit_code_of(const std::error_code& error) {
  for (const auto by_name :
       {std::errc::filename_too_long, std::errc::too_many_symbolic_link_levels, std::errc::permission_denied,
        std::errc::operation_not_permitted, std::errc::read_only_file_system, std::errc::not_a_directory,
        std::errc::is_a_directory, std::errc::file_exists})
    if (error == by_name) return bad_input;
  return run_failed;
}

int run_guarded(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const rotordrop::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return bad_input;
  } catch (const rotordrop::SolverError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return run_failed;
  } catch (const rotordrop::PartError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return run_failed;
  } catch (const std::filesystem::filesystem_error& error) {
    fmt::print(stderr, "error: {}: {}.\n       Check the name and the permissions.\n", error.path1().string(),
               error.code().message());
    return exit_code_of(error.code());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "{}", rotordrop::no_memory);
    return run_failed;
  } catch (const std::system_error& error) {
    fmt::print(stderr, "error: {}.\n", error.what());
    return run_failed;
  } catch (const std::exception& error) {
    fmt::print(stderr,
               "error: {}\n       This is a bug in the program, not an error in the input; please report it with the "
               "parameter file.\n",
               error.what());
    return run_failed;
  }
}

/// What is said on standard error may get lost, for it is full or closed; the command goes on all the same.
void let_standard_error_fail() {
  if (::fcntl(STDERR_FILENO, F_GETFD) < 0 && ::open("/dev/null", O_WRONLY) < 0) return;
  cookie_io_functions_t functions{};
  functions.write = [](void*, const char* text, std::size_t size) {
    for (std::size_t at = 0; at < size;) {
      const ssize_t written = ::write(STDERR_FILENO, text + at, size - at);
      if (written <= 0 && errno != EINTR) break;
      if (written > 0) at += static_cast<std::size_t>(written);
    }
    return static_cast<ssize_t>(size);
  };
  std::FILE* const forgiving = ::fopencookie(nullptr, "w", functions);
  if (!forgiving) return;
  std::setvbuf(forgiving, nullptr, _IONBF, 0);
  stderr = forgiving;
}

/// Where memory is short, libraries would fail at the end of the process: they make threads to end their own.
int leave(int code) {
  if (code == run_failed && rotordrop::memory_left() < rotordrop::memory_of_libraries) std::_Exit(code);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  let_standard_error_fail();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is a failed write, which is reported
  std::set_terminate(rotordrop::end_without_handler);
  rotordrop::protect_inputs();
  const int code = run_guarded(argc, argv);
  // Only closing tells whether all of it was written.
  errno = 0;
  if (std::ferror(stdout) != 0 || std::fclose(stdout) != 0) {
    fmt::print(stderr, "error: standard output cannot be written: {}.\n",
               errno != 0 ? std::generic_category().message(errno) : "an earlier write failed");
    return leave(code == done ? run_failed : code);
  }
  return leave(code);
}
