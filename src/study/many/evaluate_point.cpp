#include "study/many/evaluate_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/parameters/suggestion.h"
#include "case/built_machine.h"
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

}  // namespace

PointResult evaluate_point(const PointRequest& request) {
  PointResult result;
  const Case& c = request.drop_case;
  try {
    BuiltMachine built(c);
    MemoryRunOptions options;
    options.elements = &built.elements();
    options.is_stopped = [&] { return request.stop && *request.stop; };
    // What a case judges by itself may be a local temperature.
    options.has_local_rub =
        request.has_local_rub || !c.parameters.run.fatal_warnings.empty() || !c.parameters.limits.empty();
    options.is_kept = [&](const std::string& path) {
      return std::find(request.series.begin(), request.series.end(), path) != request.series.end();
    };
    const FinishedDrop run = run_drop_in_memory(c, built.machine(), options);
    result.is_done = run.completed;
    result.is_interrupted = !run.completed;
    result.end_time = run.end_time;
    result.scalars = numbers_of(summary_json(run.summary));
    for (const auto& path : request.series) result.series.push_back(series_of(built.machine(), *run.recorded, path));
  } catch (const std::exception& error) {
    result = {};
    result.reason = error.what();
  }
  return result;
}

}  // namespace rotordrop
