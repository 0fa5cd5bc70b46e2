#include "study/many/evaluate_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>

#include "base/parameters/suggestion.h"
#include "case/fe_module.h"
#include "case/recorded_growth.h"
#include "machine/build_machine.h"
#include "study/drop/drop_run.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// Numbers of a summary by their dotted names. What the clock says differs from run to run and is left out.
void collect(const Json& value, const std::string& path, std::vector<std::pair<std::string, double>>& to) {
  if (path == "run.wall_time" || path == "run.cpu_time" || path == "input_warnings") return;
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items()) collect(inner, path.empty() ? key : path + "." + key, to);
  } else if (value.is_array()) {
    std::size_t i = 0;
    for (const auto& inner : value) collect(inner, fmt::format("{}[{}]", path, i++), to);
  } else if (value.is_boolean()) {
    to.emplace_back(path, value.get<bool>() ? 1. : 0.);
  } else if (value.is_number()) {
    to.emplace_back(path, value.get<double>());
  } else if (value.is_null()) {
    to.emplace_back(path, std::numeric_limits<double>::quiet_NaN());
  } else if (const auto text = value.is_string() ? value.get<std::string>() : ""; text == "yes" || text == "no") {
    to.emplace_back(path, text == "yes" ? 1. : 0.);
  }
}

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
    collect(run.summary, "", result.scalars);
    for (const auto& path : request.series) result.series.push_back(series_of(*machine, *run.recorded, path));
  } catch (const std::exception& error) {
    result = {};
    result.reason = error.what();
  }
  return result;
}

}  // namespace rotordrop
