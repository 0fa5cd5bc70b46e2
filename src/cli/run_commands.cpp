#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/facts/bearing_report.h"
#include "analysis/facts/first_touch.h"
#include "analysis/facts/rotor_report.h"
#include "base/errors.h"
#include "base/memory.h"
#include "base/rotation.h"
#include "base/version.h"
#include "case/built_machine.h"
#include "case/case.h"
#include "cli/commands.h"
#include "cli/progress_line.h"
#include "cli/signals.h"
#include "io/text/parameter_keys.h"
#include "machine/balance.h"
#include "machine/build_machine.h"
#include "study/drop/drop_run.h"
#include "study/drop/warning_summary.h"
#include "study/finished_run.h"
#include "study/heat/bearing_heat_run.h"
#include "study/heat/heat_run.h"
#include "study/rerun/rerun.h"
#include "study/result_limits.h"
#include "study/statics/shoulder_words.h"

namespace rotordrop {
namespace {

std::string driver_in_words(const ThermalParameters& t) {
  if (!t.growth) return "none (thermal.growth = false)";
  const std::string driver = driver_of(t);
  if (driver == recorded_driver) return "recorded by an earlier run";
  const ThermalKind* kind = thermal_kind(driver);
  if (kind) return kind->title;
  return t.models.empty() ? "none (thermal.models = [])" : fmt::format("none (thermal.driver = \"{}\")", driver);
}

std::string header(const Case& c) {
  const auto& p = c.parameters;
  std::string bearings;
  for (const auto& entry : p.bearings) bearings += (bearings.empty() ? "" : ", ") + entry.name;
  return fmt::format(
      "rotordrop {} ({})   case {}{}\nrotor {:.4g} kg at {:.6g} rpm; supports {}; thermal growth fed back: {}\n",
      version(), git_revision(), c.name, p.title ? ": " + *p.title : "", rotor_report(p.rotor).body.mass,
      p.run.initial_speed * to_rpm, bearings, driver_in_words(p.thermal));
}

int check_heat_case(const std::filesystem::path& file, const std::vector<std::string>& overrides, bool strict) {
  std::string text;
  if (is_bearing_heat_case(file)) {
    const auto heat_case = read_bearing_heat_case(file, overrides);
    tell_warnings(heat_case->drop.warnings, strict);
    text = bearing_heat_case_text(*heat_case);
  } else {
    const HeatCase heat_case = read_heat_case(file, overrides);
    tell_warnings(heat_case.warnings, strict);
    text = heat_case_text(heat_case);
  }
  fmt::print("rotordrop {} ({})   heat conduction, case {}\n{}", version(), git_revision(), file.stem().string(), text);
  fmt::print("{}: no errors found. Run it with `rotordrop heat`. Not checked: whether the mesh is fine enough{}.\n",
             file.string(), is_bearing_heat_case(file) ? ", and what only a drop needs" : "");
  return 0;
}

/// What a quiet run still says: warnings, and why it ends with not_as_asked.
std::string warnings_and_limits(const RunCommand& command, const DropSummary& s) {
  const auto warnings = warnings_json(s.warnings);
  const bool is_told = command.accept && s.limits && accepted(*s.limits) != true;
  return warnings_text(warnings) +
         (is_told ? limits_text(*s.limits, s.second_opinion.value_or(nullptr), warnings.size()) : "");
}

int exit_code_of(const RunCommand& command, const nlohmann::ordered_json& summary) {
  return command.accept && !(summary.contains("accepted") && summary["accepted"] == true) ? not_as_asked : 0;
}

}  // namespace

void tell_warnings(const std::vector<Fault>& warnings, bool strict) {
  if (strict) {
    Faults faults;
    for (Fault warning : warnings) {
      warning.advice += "\nWithout --strict this is a warning.";
      faults.add(std::move(warning));
    }
    faults.throw_if_any();
  }
  for (const auto& warning : warnings)
    fmt::print(stderr, "warning{}\n", rendered(warning).substr(std::string_view("error").size()));
}

Case read_case_and_tell(const std::filesystem::path& file, const std::vector<std::string>& overrides, bool strict) {
  Case c = read_case(file, overrides);
  tell_warnings(c.warnings, strict);
  return c;
}

int run_command(const RunCommand& command) {
  make_heap_ready(heap_of_a_drop);
  const Case drop_case = read_case_and_tell(command.file, command.overrides, command.strict);
  if (drop_case.parameters.thermal.models.size() > 1) make_heap_ready(heap_of_a_comparison);
  if (command.accept && drop_case.parameters.limits.empty())
    throw InputError({"--accept", 0, 0}, "the case has no [limits] that a run could meet.",
                     "For example: --set 'limits.bearings.TB1.peak_contact_force.max=\"6 kN\"'");
  RunOptions options;
  options.directory = command.directory.empty() ? std::filesystem::path("out") / drop_case.name : command.directory;
  if (command.resume)
    if (const auto summary = finished_summary(options.directory, drop_case); !summary.is_null()) {
      if (!command.quiet)
        fmt::print("the run in {} is finished, at t = {:.6g} s: there is nothing to resume\n{}{}",
                   options.directory.string(), summary["run"]["end_time"].get<double>(),
                   warnings_text(summary["warnings"]),
                   limits_text(summary.value("limits", nlohmann::ordered_json::array()),
                               summary.value("second_opinion", nlohmann::ordered_json()), summary["warnings"].size()));
      stop_at_fatal_warnings(drop_case.parameters.run, summary["warnings"]);
      return exit_code_of(command, summary);
    }
  options.force = command.force;
  options.resume = command.resume;
  options.in_lanes = command.in_lanes;
  options.stop = &caught_signal();
  options.tell = [](const std::string& text) { fmt::print(stderr, "note: {}\n", text); };
  ProgressLine line;
  if (line.is_shown() && !command.quiet) options.report = [&](const Progress& p) { line.show(p); };

  BuiltMachine built(drop_case);
  options.elements = &built.elements();
  if (!command.quiet) fmt::print("{}", header(drop_case));
  std::fflush(stdout);
  catch_signals();
  FinishedDrop result;
  try {
    result = run_drop(drop_case, built.machine(), options);
  } catch (...) {
    line.finish();
    throw;
  }
  line.finish();
  if (command.quiet)
    fmt::print(stderr, "{}", warnings_and_limits(command, result.summary));
  else {
    fmt::print("{}", summary_text(result.summary));
    fmt::print("{} steps, {:.3g} s; results in {}\n", result.statistics.steps, result.wall_time,
               options.directory.string());
  }
  if (result.completed) {
    const auto files = write_files_of_finished_run(options.directory, *result.recorded, command.resume, options.tell);
    if (!command.quiet) {
      for (const auto& sentence : files.comparison) fmt::print("{}\n", sentence);
      if (!files.page.empty()) fmt::print("report of {} in {}\n", drop_case.name, files.page.string());
    }
    return exit_code_of(command, summary_json(result.summary));
  }
  std::string again = fmt::format("rotordrop run {} -o {} --resume", shell_quoted(command.file.string()),
                                  shell_quoted(options.directory.string()));
  for (const auto& assignment : command.overrides) again += " --set " + shell_quoted(assignment);
  fmt::print(stderr, "interrupted at t = {:.6g} s; results so far are in {}. Continue with: {}\n", result.end_time,
             options.directory.string(), again);
  return 128 + static_cast<int>(caught_signal());
}

int check_command(const std::filesystem::path& file, const std::vector<std::string>& overrides, bool strict) {
  if (is_heat_case(file)) return check_heat_case(file, overrides, strict);
  const Case c = read_case_and_tell(file, overrides, strict);
  BuiltMachine built(c);
  require_known_limits(c, built.machine(), &built.elements());
  fmt::print("{}", header(c));
  const auto report = rotor_report(c.parameters.rotor);
  fmt::print("rotor: {:.4f} kg, Ip {:.6g} kg m2, Id {:.6g} kg m2, centre of gravity at {:.4f} m\n", report.body.mass,
             report.body.Ip, report.body.Id, report.body.centre_of_gravity);
  fmt::print("{}", balance_text(c.parameters));
  for (const auto& entry : c.parameters.bearings)
    if (entry.touchdown()) {
      fmt::print("{}", conventions_text(c.parameters, entry.name));
      fmt::print("{}", shoulder_text(shoulder_json(c.parameters, entry.name), entry.name.size() + 2));
    }
  fmt::print("{}", bearing_report(c.parameters));
  fmt::print("{}", first_touch_text(c.parameters));
  fmt::print(
      "{}: no errors found{}. Not checked: whether the time step is short enough for the stiffest contact.\n",
      file.string(),
      c.warnings.empty() ? "" : fmt::format(", {} warning{}", c.warnings.size(), c.warnings.size() > 1 ? "s" : ""));
  return 0;
}

}  // namespace rotordrop
