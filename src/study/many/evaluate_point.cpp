#include "study/many/evaluate_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>

#include "io/recorded_series.h"
#include "machine/build_machine.h"
#include "study/drop_run.h"
#include "study/fe_module.h"
#include "study/recorded_growth.h"

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

/// The message without the place of the saved state, which is removed with the scratch folder.
std::string reason_of(const std::exception& error) {
  std::string text = error.what();
  for (const char* end : {"\n       The last good state", "\n       The state could not be saved"})
    if (const auto at = text.find(end); at != std::string::npos) text.resize(at);
  return text;
}

PointSeries series_of(const std::filesystem::path& file, const std::string& path) {
  const auto known = list_datasets(file);
  if (std::find(known.begin(), known.end(), path) == known.end()) {
    const std::string guess = closest_name(path, known);
    throw InputError({"keep.series", 0, 0}, fmt::format("a drop of this case has no series {}.", path),
                     guess.empty() ? "docs/reference/results.md lists them." : fmt::format("Did you mean {}?", guess));
  }
  PointSeries series;
  series.path = path;
  series.unit = read_attribute(file, path, "units");
  series.long_name = read_attribute(file, path, "long_name");
  series.time = read_series(file, read_attribute(file, path, "time")).values;
  series.values = read_series(file, path).values;
  series.width = series.time.empty() ? 1 : series.values.size() / series.time.size();
  return series;
}

/// Meshes come from one generator for the whole process.
std::mutex& mesh_lock() {
  static std::mutex lock;
  return lock;
}

}  // namespace

PointResult evaluate_point(const PointRequest& request) {
  PointResult result;
  const Case& c = request.drop_case;
  try {
    FiniteElements elements;
    std::unique_ptr<Machine> machine;
    {
      std::unique_lock<std::mutex> lock(mesh_lock(), std::defer_lock);
      if (c.parameters.thermal.has_fe) lock.lock();
      elements = finite_elements_of(c);
      machine = build_machine(c.parameters, c.tree, &elements, recorded_growth(c));
    }
    RunOptions options;
    options.directory = request.scratch;
    options.force = true;
    options.stop = request.stop;
    options.elements = &elements;
    const DropResult run = run_drop(c, *machine, options);
    result.is_done = run.completed;
    result.is_interrupted = !run.completed;
    result.end_time = run.end_time;
    std::ifstream file(request.scratch / "summary.json");
    collect(Json::parse(file), "", result.scalars);
    if (!request.series.empty()) {
      for (const auto& path : request.series) result.series.push_back(series_of(request.scratch / "results.h5", path));
    }
  } catch (const std::exception& error) {
    result = {};
    result.reason = reason_of(error);
  }
  return result;
}

}  // namespace rotordrop
