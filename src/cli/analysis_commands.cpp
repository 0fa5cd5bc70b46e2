#include "cli/commands.h"
#include "cli/output_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/version.h"
#include "case/case.h"
#include "case/plausibility.h"
#include "io/checkpoint.h"
#include "io/picture_file.h"
#include "study/compare/calibration.h"
#include "study/modes/critical_speeds_report.h"
#include "study/modes/modes_report.h"
#include "study/preload/preload_run.h"
#include "study/statics/statics_report.h"

// Commands that ask something of a machine without a drop.
namespace rotordrop {

namespace {

double parse_time(const char* option, const std::string& text) {
  const auto time = convert_to_si(text, "s", QuantityKind::plain, "a time");
  if (!time) throw InputError({option, 0, 0}, time.error, time.advice);
  return time.value;
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

}  // namespace

int calibrate_command(const CalibrateCommand& command) {
  const Case c = read_case_and_tell(command.file, command.overrides);
  CalibrationSettings settings;
  if (!command.until.empty()) settings.until = parse_time("--until", command.until);
  if (settings.until <= 2. * settings.from)
    throw InputError({"--until", 0, 0}, "responses are compared from 1 ms on; --until must be 2 ms at least.");
  const auto file =
      command.output.empty() ? command.file.parent_path() / (c.name + "-calibrated.toml") : command.output;
  require_new(file, command.force);
  require_other_file(file, command.file);
  require_writable(file);
  const auto bearings = calibrate(c, settings);
  write_text_atomically(file, calibration_file(c, command.overrides, file, bearings, settings));
  if (!command.quiet)
    fmt::print("rotordrop {} ({})   circuits fitted to finite elements, case {}\n{}written to {}\n", version(),
               git_revision(), c.name, calibration_text(bearings), file.string());
  return 0;
}

int modes_command(const ModesCommand& command) {
  const Case c = read_case_and_tell(command.file, command.overrides);
  const auto speeds =
      command.speeds.empty() ? std::vector<double>{0., c.parameters.run.initial_speed} : parse_speeds(command.speeds);
  const auto fastest = std::max_element(speeds.begin(), speeds.end());
  if (!command.speeds.empty()) tell_warnings(look_at_speed(c.parameters, "--speeds", *fastest));
  const auto report = find_modes(c, speeds);
  if (command.json)
    fmt::print("{}\n", to_json(report, command.n_modes).dump(2));
  else
    fmt::print("{}", to_table(report, command.n_modes));
  const auto shapes = command.shapes.empty() ? std::filesystem::path("out") / c.name / "modes.h5" : command.shapes;
  write_mode_shapes(report, command.n_modes, shapes);
  // Not on standard output, where the JSON may go into another program.
  fmt::print(stderr, "mode shapes in {}\n", shapes.string());
  return 0;
}

int critical_speeds_command(const CriticalSpeedsCommand& command) {
  const Case c = read_case_and_tell(command.file, command.overrides);
  auto options = critical_speed_options(c, {command.up_to, command.stiffness, command.map});
  options.n_speeds = 61;
  if (!command.up_to.empty()) tell_warnings(look_at_speed(c.parameters, "--up-to", options.up_to));
  if (options.stiffness) tell_warnings(look_at_stiffness("--stiffness", *options.stiffness));
  if (!options.map.empty()) tell_warnings(look_at_stiffness("--map", options.map.back()));
  const auto file = command.diagram.empty() ? std::filesystem::path("out") / c.name / "campbell.svg" : command.diagram;
  if (command.diagram.empty()) {
    require_own_or_new(file, "--diagram FILE");
  } else {
    require_picture_name(file);
    require_new(file, command.force, "--diagram FILE");
    require_writable(file);
  }
  const auto report = critical_speeds(c.parameters, options);
  const auto json = critical_speeds_json(c, report, options);
  if (command.json)
    fmt::print("{}\n", json.dump(2));
  else
    fmt::print("rotordrop {} ({})   critical speeds, case {}\n{}", version(), git_revision(), c.name,
               critical_speeds_text(c, json));
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  write_picture(file, campbell_picture(report, options.up_to, json["operating_speed"].get<double>()));
  fmt::print(stderr, "Campbell diagram in {}\n", file.string());
  return 0;
}

int statics_command(const StaticsCommand& command) {
  auto overrides = command.overrides;
  if (!command.bearing.empty()) overrides.emplace_back("statics.subject=bearings");
  const Case c = read_case_and_tell(command.file, overrides);
  warn_of_growth(c.parameters);
  const auto report = find_rest(c, command.bearing);
  if (command.json)
    fmt::print("{}\n", report.dump(2));
  else
    fmt::print("rotordrop {} ({})   statics, case {}\n{}", version(), git_revision(), c.name, statics_text(report));
  return 0;
}

int preload_command(const PreloadCommand& command) {
  const Case c = read_case_and_tell(command.file, command.overrides);
  tell_warnings(look_at_preload(c.parameters, c.tree));
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
  if (is_complete(report)) return 0;
  for (const auto& [name, bearing] : report["bearings"].items())
    if (const auto& running = bearing["running"]; running["verdict"] == "failed")
      fmt::print(stderr, "error: {}: {}\n", name, running["message"].get<std::string>());
  return 1;
}

}  // namespace rotordrop
