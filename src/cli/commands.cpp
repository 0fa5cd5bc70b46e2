#include "cli/commands.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include <fcntl.h>
#include <unistd.h>

#include "base/errors.h"
#include "base/trimmed.h"
#include "base/version.h"
#include "base/wide_vectors.h"
#include "case/bearing_mesh.h"
#include "case/case.h"
#include "case/new_case.h"
#include "case/usual_values.h"
#include "cli/output_files.h"
#include "cli/signals.h"
#include "integrate/sundials_version.h"
#include "io/checkpoint.h"
#include "io/hdf5/hdf5_version.h"
#include "io/text/parameter_writers.h"
#include "study/compare/comparison.h"
#include "study/compare/measured_report.h"
#include "study/drop/warning_summary.h"
#include "study/heat/bearing_heat_run.h"
#include "study/heat/heat_run.h"
#include "study/many/study_file.h"
#include "study/report/report.h"

namespace rotordrop {
namespace {

ComparisonOptions comparison_options(const CompareCommand& command) {
  ComparisonOptions options;
  if (!command.tolerance.empty()) options.temperature = parse_temperature_tolerance(command.tolerance);
  if (!command.floor.empty()) options.floor = parse_floor(command.floor);
  if (!command.growth_tolerance.empty()) options.growth = parse_length(command.growth_tolerance, "--growth-tolerance");
  if (!command.times.empty()) options.instants = parse_instants(command.times);
  if (!command.band_length.empty()) options.band_length = parse_band_length(command.band_length, "--band-length");
  return options;
}

/// Bare numbers are SI, and most often are not meant so.
void warn_of_unusual_options(const CompareCommand& command) {
  const auto look = [](const char* option, const std::string& text, const char* unit, QuantityKind kind,
                       const Range& usual) {
    if (!text.empty()) tell_warnings(look_at_option(option, text, unit, kind, usual));
  };
  look("--growth-tolerance", command.growth_tolerance, "m", QuantityKind::plain, between(1e-10, 5e-6));
  look("--band-length", command.band_length, "m", QuantityKind::plain, between(1e-5, 0.1));  // as its key
  look("--floor", command.floor, "K", QuantityKind::temperature_difference, between(1e-6, 10.));
  const auto number = bare_number(trimmed(command.tolerance));
  if (!number) return;
  Fault warning;
  warning.where.file = "--tolerance";
  warning.message = fmt::format("{0:.6g} has no unit and is taken as {0:.6g} K.", *number);
  warning.advice = fmt::format("Write \"{:.6g} K\" if that is meant, \"{:.6g} %\" for a part of the rise.", *number,
                               *number < 1. ? 100. * *number : *number);
  tell_warnings({warning});
}

/// What a comparison writes: by its usual name it is written again, by another only with --force. Never over what it reads, nor over what someone else wrote
/// and the user has not named.
void require_outputs(const CompareCommand& command, std::initializer_list<std::filesystem::path> outputs) {
  for (const auto& path : outputs) {
    if (!command.output.empty()) require_new(path, command.force);
    for (const auto& directory : {command.directory, command.against})
      if (!directory.empty()) require_none_of_run(path, directory);
    if (path != command.output) require_own_or_new(path);
  }
}

void warn_of_times_beyond(const ComparisonOptions& options, const RecordedDrop& drop,
                          const std::optional<RecordedDrop>& against) {
  double end = drop.table("/time").values.back();
  if (against) end = std::min(end, against->table("/time").values.back());
  for (const double time : options.instants)
    if (time > end)
      fmt::print(stderr, "warning: --times: {:.6g} ms lies beyond the end at {:.6g} ms and is left out.\n", time * 1e3,
                 end * 1e3);
}

std::filesystem::path comparison_file(const CompareCommand& command) {
  const auto file = command.output.empty() ? command.directory / "comparison.json" : command.output;
  if (file.extension() == ".h5")
    throw InputError({"--output", 0, 0},
                     "the report is JSON; its time series go to a file of the same name ending in .h5",
                     "Give a name such as comparison.json.");
  const auto series = comparison_series_file(file);
  if (!command.output.empty() && std::filesystem::exists(series) && !std::filesystem::exists(file))
    throw InputError({series.string()},
                     "the comparison's time series would go to this file, which is of something else.",
                     "It is left as it is. Choose another name with -o FILE.");
  require_outputs(command, {file, series});
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

int defaults_command(InputKind kind) {
  fmt::print("{}", write_defaults(sections_of(kind)));
  return 0;
}

int schema_command(InputKind kind) {
  fmt::print("{}", write_json_schema(sections_of(kind)));
  return 0;
}

int new_command(const NewCommand& command) {
  const auto file = command.is_own || !command.shaft.empty() ? new_own_case(command.directory, command.shaft)
                                                             : new_case(command.directory);
  fmt::print("New case: {}\nRun it with: rotordrop run {}\n", file.string(), file.string());
  return 0;
}

int heat_command(const HeatCommand& command) {
  // Of the processes that mpirun starts one talks; all meet the same faults.
  if (!is_first_rank()) {
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0 || ::dup2(nowhere, STDOUT_FILENO) < 0 || ::dup2(nowhere, STDERR_FILENO) < 0) return 1;
  }
  HeatRunOptions options;
  options.directory =
      command.directory.empty() ? std::filesystem::path("out") / command.file.stem() : command.directory;
  options.force = command.force;
  options.stop = &caught_signal();
  nlohmann::ordered_json summary;
  std::string left_out;
  const bool is_of_a_bearing = is_bearing_heat_case(command.file);
  if (is_of_a_bearing) {
    const auto heat_case = read_bearing_heat_case(command.file, command.overrides);
    tell_warnings(heat_case->drop.warnings);
    left_out = limits_left_out_text(*heat_case);
    catch_signals();
    summary = run_bearing_heat(*heat_case, options);
  } else {
    const HeatCase heat_case = read_heat_case(command.file, command.overrides);
    tell_warnings(heat_case.warnings);
    catch_signals();
    summary = run_heat(heat_case, options);
  }
  if (!command.quiet) {
    fmt::print("rotordrop {} ({})   heat conduction, case {}\n{}", version(), git_revision(),
               summary["case"].get<std::string>(),
               is_of_a_bearing ? bearing_heat_summary_text(summary) : heat_summary_text(summary));
    fmt::print("{}{}results in {}\n", left_out, warnings_text(summary["warnings"]), options.directory.string());
  }
  if (summary["completed"].get<bool>()) return 0;
  fmt::print(stderr, "interrupted; results so far are in {}\n", options.directory.string());
  return 128 + static_cast<int>(caught_signal());
}

namespace {

int compare_measured_command(const CompareCommand& command) {
  const auto file = command.output.empty() ? command.directory / "measured.json" : command.output;
  const auto page = std::filesystem::path(file).replace_extension(".html");
  for (const auto& path : {file, page}) require_other_file(path, command.measured);
  require_outputs(command, {file, page});
  const auto measured = read_measured_file(command.measured);
  const RecordedDrop drop(command.directory);
  const MeasuredComparison comparison = compare_with_measured(drop, measured);
  require_writable(file);
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
  warn_of_unusual_options(command);
  const RecordedDrop drop(command.directory);
  std::optional<RecordedDrop> against;
  if (!command.against.empty()) against.emplace(command.against);
  const auto file = comparison_file(command);
  require_writable(file);
  if (!command.times.empty()) warn_of_times_beyond(options, drop, against);
  const Comparison comparison = compare_models(drop, against ? &*against : nullptr, options);
  write_comparison(comparison, file);
  if (!command.quiet)
    fmt::print("rotordrop {} ({})   comparison, case {}\n{}report in {}\n", version(), git_revision(), drop.case_name(),
               comparison_text(comparison.report), file.string());
  return 0;
}

int report_command(const ReportCommand& command) {
  const RecordedDrop drop(command.directory);
  const auto file = command.output.empty() ? command.directory / "report.html" : command.output;
  require_new(file, command.force);
  require_page_or_nothing(file);
  require_writable(file);
  const std::string page = report_page(report_data(drop));
  write_text_atomically(file, page);
  if (!command.quiet) fmt::print("report of {} in {}\n", drop.case_name(), file.string());
  return 0;
}

int mesh_command(const MeshCommand& command) {
  const Case drop_case = read_case_and_tell(command.file, command.overrides);
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

}  // namespace rotordrop
