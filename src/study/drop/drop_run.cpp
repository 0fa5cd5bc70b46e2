#include "study/drop/drop_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

#include "analysis/drop_lanes.h"
#include "base/cpu_time.h"
#include "base/errors.h"
#include "io/checkpoint.h"
#include "io/results_folder.h"
#include "study/compare/comparison.h"
#include "study/drop/drop_checkpoints.h"
#include "study/drop/drop_fields.h"
#include "study/drop/drop_record.h"
#include "study/drop/warning_summary.h"
#include "study/opinion/second_opinion.h"
#include "study/result_limits.h"
#include "study/rub/bore_report.h"
#include "study/rub/impact.h"

namespace rotordrop {
namespace {

/// Tells whether a series is one of which the summary tells: orbits and rubs of the bearings, and all of meshed sections; or of further groups.
class SummarySeries {
 public:
  explicit SummarySeries(const Case& c, const SummaryParts& parts = {}, std::vector<std::string> groups = {})
      : groups_(std::move(groups)) {
    const auto add = [&](const std::vector<std::string>& series) {
      paths_.insert(paths_.end(), series.begin(), series.end());
    };
    for (const auto& bearing : touchdown_names(c.parameters)) {
      if (parts.local_rub) add(series_of_rub(bearing));
      if (parts.whirl) add(series_of_whirl(bearing));
      if (c.parameters.run.second_opinion) add(series_of_impact(bearing));
    }
    if (const ThermalKind* kind = section_kind(c.parameters.thermal))
      groups_.insert(groups_.end(), {kind->group, "/windows/"});
  }
  bool operator()(const std::string& path) const {
    return std::find(paths_.begin(), paths_.end(), path) != paths_.end() ||
           std::any_of(groups_.begin(), groups_.end(), [&](const auto& group) { return path.starts_with(group); });
  }

 private:
  std::vector<std::string> paths_, groups_;
};

[[noreturn]] void fail(const SolverError& error, const Drop& drop, DropCheckpoints& checkpoints, DropRecord& record) {
  std::string text = error.what();
  try {
    const auto file = checkpoints.save_failed();
    text += fmt::format("\n       The last good state, at t = {:.6g} ms, is saved in {}.", drop.loop().time() * 1e3,
                        file.string());
  } catch (const std::exception& other) {
    text += fmt::format("\n       The state could not be saved: {}", other.what());
  }
  try {
    record.close();
  } catch (const std::exception& other) {
    // A full disk was told already.
    if (text.find(other.what()) == std::string::npos) text += fmt::format("\n       {}", other.what());
  }
  throw SolverError(text);
}

/// Adds the summary of a drop that has come to its end.
void summarise(const Case& c, const Machine& machine, const Drop& drop, FiniteElements* elements, MemorySeries series,
               const std::filesystem::path& directory, FinishedDrop& result, const SummaryParts& parts = {}) {
  result.recorded = std::make_shared<const RecordedDrop>(c, std::move(series), directory);
  auto& summary = result.summary = summarise(c, machine, drop.scalars(), result, elements, *result.recorded, parts);
  result.warnings = summary.warnings;
  if (const auto& limits = c.parameters.limits; !limits.empty())
    summary.limits = assessed(limits, summary_json(summary), result.completed);
}

void run_in_lane(Drop& drop, const std::function<bool()>& is_stopped) {
  const std::array<Drop*, 1> one = {&drop};
  if (const auto failure = run_in_lanes(one, is_stopped).front()) std::rethrow_exception(failure);
}

}  // namespace

std::vector<std::string> series_of(const Machine& machine) {
  std::vector<std::string> paths = {"/time", "/detail/time"};
  for (const auto* list : {&machine.step_observables(), &machine.state_observables(), &machine.detail_observables()})
    for (const Observable& o : *list) paths.push_back(o.name);
  return paths;
}

MemoryDrop::MemoryDrop(const Case& c, const Machine& machine, MemoryRunOptions options)
    : case_(c),
      machine_(machine),
      options_(std::move(options)),
      drop_(machine, c.parameters, c.parameters.integration, c.parameters.output, options_.elements, options_.tell),
      series_(machine, drop_, choice()) {}

MemorySeries::Choice MemoryDrop::choice() const {
  if (!options_.is_kept) return {};
  return [is_in_summary = SummarySeries(case_, options_.parts), is_kept = options_.is_kept](const std::string& path) {
    return is_in_summary(path) || is_kept(path);
  };
}

FinishedDrop MemoryDrop::finished(double wall_time, double cpu_time) {
  FinishedDrop result{drop_.result(), {}, nullptr};
  result.wall_time = wall_time;
  result.cpu_time = cpu_time;
  summarise(case_, machine_, drop_, options_.elements, std::move(series_), {}, result, options_.parts);
  if (result.completed) stop_at_fatal_warnings(case_.parameters.run, warnings_json(result.summary.warnings));
  return result;
}

FinishedDrop run_drop_in_memory(const Case& c, const Machine& machine, const MemoryRunOptions& options) {
  MemoryDrop run(c, machine, options);
  Drop& drop = run.drop();
  DropProgress progress(machine, drop, drop.sections().growth_in_force(), options.report);
  if (options.report) drop.loop().add(progress);
  progress.begin(drop.loop().time());
  const auto start = std::chrono::steady_clock::now();
  const double cpu_start = cpu_seconds();
  drop.run(options.is_stopped);
  const double wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double cpu_time = cpu_seconds() - cpu_start;
  progress.tell(drop.loop().time(), drop.loop().state());
  return run.finished(wall_time, cpu_time);
}

void require_known_limits(const Case& c, const Machine& machine, FiniteElements* elements) {
  if (c.parameters.limits.empty()) return;
  MemoryRunOptions options;
  options.elements = elements;
  options.is_stopped = [] { return true; };
  options.is_kept = [](const std::string&) { return false; };
  run_drop_in_memory(c, machine, options);
}

FinishedDrop run_drop(const Case& c, const Machine& machine, const RunOptions& options) {
  const auto& p = c.parameters;
  require_known_limits(c, machine, options.elements);
  ResultsFolder folder(options.directory, ResultsFolder::existing_results(options.resume, options.force));
  Drop drop(machine, p, p.integration, p.output, options.elements, options.tell);
  DropRecord record(options.directory, c, machine, drop);
  const bool are_compared = p.thermal.models.size() > 1;
  MemorySeries series(machine, drop,
                      SummarySeries(c, {}, are_compared ? series_of_comparison(p) : std::vector<std::string>{}));
  DropCheckpoints checkpoints(options.directory, c, machine, drop, record, series, folder, options.tell);
  DropProgress progress(machine, drop, drop.sections().growth_in_force(), options.report);
  drop.loop().add(progress);
  drop.loop().add(checkpoints);
  const bool in_lanes = options.in_lanes && !options.resume && why_not_in_lanes(machine, p.integration).empty();
  if (options.resume)
    checkpoints.resume();
  else
    record.open(options.force, in_lanes);
  std::optional<DropFields> fields;
  if (options.elements) {
    fields.emplace(options.directory, *options.elements, p.thermal.fe, drop.loop().time());
    drop.sections().set_fields(*fields);
  }
  write_text_atomically(options.directory / "parameters.toml", c.resolved.text);

  checkpoints.start_clocks();
  progress.begin(drop.loop().time());
  try {
    const auto is_stopped = [&] { return options.stop && *options.stop; };
    if (in_lanes)
      run_in_lane(drop, is_stopped);
    else
      drop.run(is_stopped);
  } catch (const SolverError& error) {
    fail(error, drop, checkpoints, record);
  } catch (const PartError& error) {
    fail(SolverError(error.what()), drop, checkpoints, record);
  }
  FinishedDrop result{drop.result(), {}, nullptr};
  if (!result.completed) checkpoints.save();
  progress.tell(result.end_time, result.state);
  record.close();
  folder.require_there();
  result.wall_time = checkpoints.wall_time();
  result.cpu_time = checkpoints.cpu_time();

  summarise(c, machine, drop, options.elements, std::move(series), options.directory, result);
  if (p.run.second_opinion && result.completed) {
    if (options.tell) options.tell("the drop is done and is computed again for a second opinion");
    result.summary.second_opinion = second_opinion(c, result, options.stop);
  }
  write_text_atomically(options.directory / "summary.json", summary_json(result.summary).dump(2) + "\n");
  if (!result.completed) return result;
  folder.remove_checkpoints();
  stop_at_fatal_warnings(p.run, warnings_json(result.summary.warnings));
  return result;
}

}  // namespace rotordrop
