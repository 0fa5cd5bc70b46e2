#include "study/many/evaluate_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <nlohmann/json.hpp>

#include "base/parameters/suggestion.h"
#include "case/fe_module.h"
#include "case/recorded_growth.h"
#include "machine/build_machine.h"
#include "study/drop/drop_run.h"
#include "study/result_limits.h"

namespace rotordrop {
namespace {

PointSeries series_of(const Machine& machine, const RecordedDrop& drop, const std::string& path) {
  if (drop.has(path)) {
    const auto& table = drop.table(path);
    return {path, table.unit, table.long_name, table.n_columns, drop.table(table.time_path).values, table.values};
  }
  std::vector<std::string> known = drop.datasets();
  for (const auto* list : {&machine.step_observables(), &machine.state_observables(), &machine.detail_observables()})
    for (const Observable& o : *list) known.push_back(o.name);
  const std::string guess = closest_name(path, known);
  throw InputError({"keep.series", 0, 0}, fmt::format("a drop of this case has no series {}.", path),
                   guess.empty() ? "docs/reference/results.md lists them." : fmt::format("Did you mean {}?", guess));
}

}  // namespace

PointResult evaluate_point(const PointRequest& request) {
  PointResult result;
  const Case& c = request.drop_case;
  try {
    FiniteElements elements;
    std::unique_ptr<Machine> machine;
    {
      std::unique_lock<std::mutex> lock(section_lock(), std::defer_lock);
      if (c.parameters.thermal.has_fe) lock.lock();
      elements = finite_elements_of(c);
      machine = build_machine(c.parameters, c.tree, &elements, recorded_growth(c));
    }
    MemoryRunOptions options;
    options.elements = &elements;
    options.is_stopped = [&] { return request.stop && *request.stop; };
    options.is_kept = [&](const std::string& path) {
      return std::find(request.series.begin(), request.series.end(), path) != request.series.end();
    };
    const FinishedDrop run = run_drop_in_memory(c, *machine, options);
    result.is_done = run.completed;
    result.is_interrupted = !run.completed;
    result.end_time = run.end_time;
    result.scalars = numbers_of(run.summary);
    for (const auto& path : request.series) result.series.push_back(series_of(*machine, *run.recorded, path));
  } catch (const std::exception& error) {
    result = {};
    result.reason = error.what();
  }
  return result;
}

}  // namespace rotordrop
