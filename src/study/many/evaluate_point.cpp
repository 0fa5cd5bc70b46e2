#include "study/many/evaluate_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/drop_lanes.h"
#include "base/cpu_time.h"
#include "base/parameters/suggestion.h"
#include "case/built_machine.h"
#include "model/lane_system.h"
#include "study/drop/drop_run.h"
#include "study/result_limits.h"

namespace rotordrop {
namespace {

PointSeries series_of(const Machine& machine, const RecordedDrop& drop, const std::string& path) {
  if (drop.has(path)) {
    const auto& table = drop.table(path);
    const auto& meaning = table.meaning;
    return {path, meaning.unit, meaning.long_name, table.n_columns, drop.table(meaning.time_path).values, table.values};
  }
  std::vector<std::string> known = drop.datasets();
  for (const auto* list : {&machine.step_observables(), &machine.state_observables(), &machine.detail_observables()})
    for (const Observable& o : *list) known.push_back(o.name);
  throw InputError({"keep.series", 0, 0}, fmt::format("a drop of this case has no series {}.", path),
                   suggestion(path, known, "docs/reference/results.md lists them."));
}

MemoryRunOptions options_of(const PointRequest& request, BuiltMachine& built) {
  const Case& c = request.drop_case;
  MemoryRunOptions options;
  options.elements = &built.elements();
  options.is_stopped = [stop = request.stop] { return stop && *stop; };
  // What a case judges by itself may be of any part.
  const bool is_judged = !c.parameters.run.fatal_warnings.empty() || !c.parameters.limits.empty();
  options.parts = is_judged ? SummaryParts{} : request.parts;
  options.is_kept = [&request](const std::string& path) {
    return std::find(request.series.begin(), request.series.end(), path) != request.series.end();
  };
  return options;
}

PointResult result_of(const PointRequest& request, const Machine& machine, const FinishedDrop& run) {
  PointResult result;
  result.is_done = run.completed;
  result.is_interrupted = !run.completed;
  result.end_time = run.end_time;
  result.scalars = numbers_of(summary_json(run.summary));
  for (const auto& path : request.series) result.series.push_back(series_of(machine, *run.recorded, path));
  return result;
}

PointResult failed(const std::exception& error) {
  PointResult result;
  result.reason = error.what();
  return result;
}

PointResult run_alone(const PointRequest& request, BuiltMachine& built) {
  return result_of(request, built.machine(),
                   run_drop_in_memory(request.drop_case, built.machine(), options_of(request, built)));
}

/// A drop that runs in lanes.
struct LaneDrop {
  std::size_t request;
  std::unique_ptr<BuiltMachine> built;
  std::unique_ptr<MemoryDrop> run;
};

/// Runs drops that are alike.
void run_alike(std::span<LaneDrop> group, std::span<const PointRequest> requests, std::vector<PointResult>& results) {
  std::vector<Drop*> drops;
  for (const LaneDrop& one : group) drops.push_back(&one.run->drop());
  const auto* stop = requests[group.front().request].stop;
  const auto start = std::chrono::steady_clock::now();
  const double cpu_start = thread_cpu_seconds();
  const auto failures = run_in_lanes(drops, [stop] { return stop && *stop; });
  const auto n = static_cast<double>(group.size());
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / n;
  const double cpu = (thread_cpu_seconds() - cpu_start) / n;
  for (std::size_t k = 0; k < group.size(); ++k) {
    const PointRequest& request = requests[group[k].request];
    PointResult& result = results[group[k].request];
    try {
      if (failures[k]) std::rethrow_exception(failures[k]);
      result = result_of(request, group[k].built->machine(), group[k].run->finished(wall, cpu));
    } catch (const std::exception& error) {
      result = failed(error);
    }
  }
}

}  // namespace

PointResult evaluate_point(const PointRequest& request) {
  try {
    BuiltMachine built(request.drop_case);
    return run_alone(request, built);
  } catch (const std::exception& error) {
    return failed(error);
  }
}

std::vector<PointResult> evaluate_together(std::span<const PointRequest> requests) {
  std::vector<PointResult> results(requests.size());
  std::vector<std::vector<LaneDrop>> groups;
  for (std::size_t i = 0; i < requests.size(); ++i) try {
      const Case& c = requests[i].drop_case;
      const auto& integration = c.parameters.integration;
      LaneDrop one{i, std::make_unique<BuiltMachine>(c), nullptr};
      const Machine& machine = one.built->machine();
      if (!why_not_in_lanes(machine, integration).empty()) {
        results[i] = run_alone(requests[i], *one.built);
        continue;
      }
      one.run = std::make_unique<MemoryDrop>(c, machine, options_of(requests[i], *one.built));
      const auto is_alike = [&](const std::vector<LaneDrop>& group) {
        const auto& first = group.front();
        return group.size() < LaneSystem::width &&
               are_alike(first.built->machine(), requests[first.request].drop_case.parameters.integration, machine,
                         integration);
      };
      auto group = std::find_if(groups.begin(), groups.end(), is_alike);
      if (group == groups.end()) group = groups.emplace(groups.end());
      group->push_back(std::move(one));
    } catch (const std::exception& error) {
      results[i] = failed(error);
    }
  for (auto& group : groups) run_alike(group, requests, results);
  return results;
}

}  // namespace rotordrop
