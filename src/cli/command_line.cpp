#include "cli/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "case/case.h"
#include "cli/commands.h"
#include "cli/completion.h"
#include "cli/study_commands.h"

namespace rotordrop {
namespace {

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

void offer_run(CLI::App& app, std::vector<OfferedCommand>& offered) {
  const auto values = std::make_shared<RunCommand>();
  auto* command =
      app.add_subcommand("run", "Run a case; write results.h5, summary.json and parameters.toml to a directory.");
  add_case(*command, values->file);
  command->add_option("-o,--output", values->directory, "Directory for the results; default out/CASE");
  add_overrides(*command, values->overrides, "contact.friction_coefficient=0.05");
  add_force(*command, values->force, "existing results in the directory");
  command->add_flag("--resume", values->resume, "Continue an interrupted run");
  add_strict(*command, values->strict);
  command->add_flag("--accept", values->accept,
                    "End with exit code 3 if a limit of the case is not met, or not assessed");
  add_quiet(*command, values->quiet);
  offered.push_back({command, [values] { return run_command(*values); }});
}

void offer_check(CLI::App& app, std::vector<OfferedCommand>& offered) {
  struct Values {
    std::string file;
    std::vector<std::string> overrides;
    bool strict = false;
  };
  const auto values = std::make_shared<Values>();
  auto* command = app.add_subcommand("check", "Read and check a case (a drop or heat only) without running it.");
  add_case(*command, values->file);
  add_strict(*command, values->strict);
  add_overrides(*command, values->overrides);
  offered.push_back({command, [values] { return check_command(values->file, values->overrides, values->strict); }});
}

void offer_modes(CLI::App& app, std::vector<OfferedCommand>& offered) {
  const auto values = std::make_shared<ModesCommand>();
  auto* command =
      app.add_subcommand("modes", "Compute natural modes with the case's linear supports and magnets, or free-free.");
  add_case(*command, values->file);
  command->add_option("--speeds", values->speeds,
                      "Spin speeds, such as \"0 rpm,15200 rpm\"; default: 0 and the initial speed");
  command->add_option("--modes", values->n_modes, "Number of modes to report")->check(CLI::Range(1, 10000));
  command->add_flag("--json", values->json, "Print the report as JSON");
  command->add_option("--shapes", values->shapes, "HDF5 file for the mode shapes; default out/CASE/modes.h5");
  add_overrides(*command, values->overrides);
  offered.push_back({command, [values] { return modes_command(*values); }});
}

void offer_critical_speeds(CLI::App& app, std::vector<OfferedCommand>& offered) {
  const auto values = std::make_shared<CriticalSpeedsCommand>();
  auto* command = app.add_subcommand(
      "critical-speeds", "Critical speeds on the case's linear supports or on given springs; Campbell diagram.");
  add_case(*command, values->file);
  command->add_option("--up-to", values->up_to,
                      "Highest spin speed, such as \"20000 rpm\"; default: twice the initial speed");
  command->add_option("--stiffness", values->stiffness,
                      "Isotropic springs at the linear supports, or at all bearings of a case that has none");
  command->add_option("--map", values->map,
                      "Critical-speed map over the springs' stiffness, such as \"1e6 N/m, 1e9 N/m\"");
  command->add_option("--diagram", values->diagram, "Picture, FILE.svg or FILE.png; default out/CASE/campbell.svg");
  command->add_flag("--json", values->json, "Report as JSON, with units");
  add_force(*command, values->force, "the picture given with --diagram");
  add_overrides(*command, values->overrides);
  offered.push_back({command, [values] { return critical_speeds_command(*values); }});
}

void offer_heat(CLI::App& app, std::vector<OfferedCommand>& offered) {
  const auto values = std::make_shared<HeatCommand>();
  auto* command = app.add_subcommand("heat",
                                     "Compute temperatures for prescribed heat input, without dynamics: plain "
                                     "sections (finite elements) or a touchdown bearing (circuit and section).");
  add_case(*command, values->file);
  command->add_option("-o,--output", values->directory, "Directory for the results; default out/CASE");
  add_overrides(*command, values->overrides, "fe.cells=16");
  add_force(*command, values->force, "existing results in the directory");
  add_quiet(*command, values->quiet);
  offered.push_back({command, [values] { return heat_command(*values); }});
}

void offer_compare(CLI::App& app, std::vector<OfferedCommand>& offered) {
  const auto values = std::make_shared<CompareCommand>();
  auto* command = app.add_subcommand("compare",
                                     "Compare the lumped circuit with the finite elements of a drop, or two drops, "
                                     "to see when the circuit can be trusted.");
  command->add_option("directory", values->directory, "Directory of a run's results")->required();
  command->add_option("--against", values->against, "Directory of another run");
  command
      ->add_option("--measured", values->measured,
                   "Measured series beside the drop: a table whose columns are called such as "
                   "\"/bearings/TB1/orbit[0] [um]\", or a TOML file with [[measured]]")
      ->excludes("--against");
  command->add_option("--tolerance", values->tolerance,
                      "Tolerance of temperatures: \"0.5 K\", or a part of the rise at the time; default \"5 %\"");
  command->add_option("--floor", values->floor,
                      "Smallest tolerance of temperatures if it is a part of the rise; default \"10 mK\"");
  command->add_option("--growth-tolerance", values->growth_tolerance,
                      "Tolerance for thermal growth and clearances; default \"0.1 um\"");
  command->add_option("--times", values->times,
                      "Times to report in addition to the peak of the first impact and the end; default \"10 ms\"");
  command->add_option("--band-length", values->band_length,
                      "Length of the rub contact along the surface; default: the case's thermal.rub_band_length");
  command->add_option("-o,--output", values->output,
                      "Report; default DIR/comparison.json, of measured series DIR/measured.json");
  add_force(*command, values->force, "the file given with -o");
  add_quiet(*command, values->quiet);
  offered.push_back({command, [values] { return compare_command(*values); }});
}

void offer_report(CLI::App& app, std::vector<OfferedCommand>& offered) {
  const auto values = std::make_shared<ReportCommand>();
  auto* command = app.add_subcommand("report", "Write a run as one self-contained HTML page with figures.");
  command->add_option("directory", values->directory, "Directory of a run's results")->required();
  command->add_option("-o,--output", values->output, "File; default DIR/report.html");
  add_force(*command, values->force, "an existing file");
  add_quiet(*command, values->quiet);
  offered.push_back({command, [values] { return report_command(*values); }});
}

void offer_rerun(CLI::App& app, std::vector<OfferedCommand>& offered) {
  const auto values = std::make_shared<RerunCommand>();
  auto* command = app.add_subcommand(
      "rerun", "Run a recorded drop once more, from its result file alone, and compare the two bit by bit.");
  command->add_option("results", values->file, "results.h5 of a drop, or its directory")->required();
  command->add_option("-o,--output", values->directory, "Directory for the results; default out/CASE-rerun");
  add_force(*command, values->force, "existing results in the directory");
  add_quiet(*command, values->quiet);
  offered.push_back({command, [values] { return rerun_command(*values); }});
}

void offer_mesh(CLI::App& app, std::vector<OfferedCommand>& offered) {
  const auto values = std::make_shared<MeshCommand>();
  auto* command = app.add_subcommand("mesh", "Mesh the sections of the touchdown bearings; write a gmsh .msh file.");
  add_case(*command, values->file);
  command->add_option("-o,--output", values->output,
                      "File; default out/CASE/mesh.msh; with several bearings, one FILE-NAME.msh for each");
  command->add_option("--bearing", values->bearing, "Only this bearing");
  command->add_option("--format", values->format, "Version of the format")->check(CLI::IsMember({"4.1", "2.2"}));
  add_overrides(*command, values->overrides, "thermal.fe.refinement=2");
  add_force(*command, values->force, "existing files");
  add_quiet(*command, values->quiet);
  offered.push_back({command, [values] { return mesh_command(*values); }});
}

void offer_calibrate(CLI::App& app, std::vector<OfferedCommand>& offered) {
  const auto values = std::make_shared<CalibrateCommand>();
  auto* command = app.add_subcommand(
      "calibrate", "Fit the lumped circuits to the finite elements; write a parameter file based on the case.");
  add_case(*command, values->file);
  command->add_option("-o,--output", values->output, "File; default CASE-calibrated.toml beside the case");
  command->add_option("--until", values->until, "Responses are compared up to this time; default 10 s");
  add_overrides(*command, values->overrides, "thermal.fe.refinement=2");
  add_force(*command, values->force, "an existing file");
  add_quiet(*command, values->quiet);
  offered.push_back({command, [values] { return calibrate_command(*values); }});
}

void offer_statics(CLI::App& app, std::vector<OfferedCommand>& offered) {
  const auto values = std::make_shared<StaticsCommand>();
  auto* command = app.add_subcommand("statics",
                                     "Compute the static equilibrium of the rotor on its supports, or of a bearing "
                                     "under load: ball loads, contact pressures, stiffness.");
  add_case(*command, values->file);
  command->add_option("--bearing", values->bearing, "Only this touchdown bearing, on its own, loaded as in [statics]");
  command->add_flag("--json", values->json, "Report as JSON, with every ball");
  add_overrides(*command, values->overrides, "statics.inner_rise=\"20 K\"");
  offered.push_back({command, [values] { return statics_command(*values); }});
}

void offer_preload(CLI::App& app, std::vector<OfferedCommand>& offered) {
  const auto values = std::make_shared<PreloadCommand>();
  auto* command = app.add_subcommand("preload",
                                     "Compute the thermal preload of touchdown bearings: maps, history over a "
                                     "drop, steady running until it settles or runs away.");
  add_case(*command, values->file);
  command->add_option("--bearing", values->bearing, "Only this touchdown bearing");
  command->add_option("--results", values->results,
                      "Directory of a drop's results, for the preload history over that drop");
  command->add_option("-o,--output", values->directory, "Directory for the results; default out/CASE-preload");
  command->add_flag("--json", values->json, "Print the report as JSON");
  add_overrides(*command, values->overrides, "preload.speed=\"3000 rpm\"");
  add_force(*command, values->force, "existing results in the directory");
  add_quiet(*command, values->quiet);
  offered.push_back({command, [values] { return preload_command(*values); }});
}

void offer_study(CLI::App& app, std::vector<OfferedCommand>& offered) {
  const auto study = std::make_shared<StudyCommands>(app);
  offered.push_back({app.get_subcommand("study"), [study] { return study->run(); }});
}

/// `defaults` or `schema`, of one kind of input.
void offer_keys(CLI::App& app, std::vector<OfferedCommand>& offered, const std::string& name, const std::string& help,
                const std::string& what, int (*print)(InputKind)) {
  struct Values {
    bool of_heat = false, of_study = false;
  };
  const auto values = std::make_shared<Values>();
  auto* command = app.add_subcommand(name, help);
  command->add_flag("--heat", values->of_heat, what + " of a heat-only case (rotordrop heat)");
  command->add_flag("--study", values->of_study, what + " of a study file (rotordrop study)");
  offered.push_back(
      {command, [values, print] {
         return print(values->of_heat ? InputKind::heat : values->of_study ? InputKind::study : InputKind::drop);
       }});
}

void offer_new(CLI::App& app, std::vector<OfferedCommand>& offered) {
  const auto values = std::make_shared<NewCommand>();
  auto* command = app.add_subcommand("new", "Create a folder with a case to start from.");
  command->add_option("directory", values->directory, "Folder")->required();
  command->add_flag("--own", values->is_own,
                    "A machine of your own: a shaft as a table, bearings of the catalogue on ribbons, limits");
  command->add_option("--from", values->shaft, "The same with the shaft of a file: a table (.csv), TOML or JSON");
  offered.push_back({command, [values] { return new_command(*values); }});
}

void offer_completion(CLI::App& app, std::vector<OfferedCommand>& offered) {
  const auto shell = std::make_shared<std::string>();
  auto* command =
      app.add_subcommand("completion", "Print a script that completes commands, options and keys of --set in a shell.");
  command->add_option("shell", *shell, "Shell: bash, zsh or fish")
      ->required()
      ->type_name("SHELL")
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  offered.push_back({command, [&app, shell] {
                       fmt::print("{}", completion_script(app, *shell, case_sections()));
                       return 0;
                     }});
}

void offer_manual(CLI::App& app, std::vector<OfferedCommand>& offered) {
  const auto topic = std::make_shared<std::string>();
  auto* command = app.add_subcommand("man", "Print a manual page in the format of man(7).");
  command->add_option("topic", *topic, "A command, or \"case\" for the parameters; default: the program")
      ->type_name("TOPIC");
  offered.push_back({command, [&app, topic] {
                       fmt::print("{}", manual_page(app, *topic, case_sections()));
                       return 0;
                     }});
}

}  // namespace

std::vector<OfferedCommand> offer_commands(CLI::App& app) {
  std::vector<OfferedCommand> offered;
  offer_run(app, offered);
  offer_check(app, offered);
  offer_modes(app, offered);
  offer_critical_speeds(app, offered);
  offer_heat(app, offered);
  offer_compare(app, offered);
  offer_report(app, offered);
  offer_rerun(app, offered);
  offer_mesh(app, offered);
  offer_calibrate(app, offered);
  offer_statics(app, offered);
  offer_preload(app, offered);
  offer_study(app, offered);
  offer_keys(app, offered, "defaults", "Print every parameter with unit, range, default and source, as TOML.",
             "Parameters", defaults_command);
  offer_keys(app, offered, "schema", "JSON Schema of case files, for editors.", "Schema", schema_command);
  offer_new(app, offered);
  offer_completion(app, offered);
  offer_manual(app, offered);
  return offered;
}

}  // namespace rotordrop
