#include "study/recorded_drop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.h"
#include "machine/build_machine.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

/// @throws InputError unless the directory holds results
fs::path results_in(const fs::path& directory) {
  std::error_code ignored;
  const std::string where = directory.string();
  if (!fs::exists(directory, ignored)) throw InputError({where, 0, 0}, "there is no such directory");
  if (!fs::is_directory(directory, ignored))
    throw InputError({where, 0, 0}, "this is not a directory", "Give the directory into which `rotordrop run` wrote.");
  for (const char* name : {"results.h5", "parameters.toml"})
    if (!fs::is_regular_file(directory / name, ignored))
      throw InputError({where, 0, 0}, fmt::format("the directory does not contain {}", name),
                       "Give the directory into which `rotordrop run` wrote.");
  return directory / "results.h5";
}

bool is_text(const std::string& dataset) {
  return dataset == "/parameters" || dataset == "/given" || dataset == "/inputs";
}

}  // namespace

RecordedDrop::RecordedDrop(const fs::path& directory) : directory_(directory), file_(results_in(directory)) {
  open();  // before the parameters, which are of another kind beside results of another kind
  parameters_ = read_case(directory / "parameters.toml").parameters;
}

RecordedDrop::RecordedDrop(const fs::path& directory, const Case& drop_case)
    : directory_(directory), file_(results_in(directory)), parameters_(drop_case.parameters) {
  open();
}

RecordedDrop::RecordedDrop(const Case& drop_case, MemorySeries series, fs::path directory)
    : directory_(std::move(directory)), parameters_(drop_case.parameters), case_name_(drop_case.name) {
  memory_ = series.take();
  for (const auto& group : memory_) {
    if (group.kept.empty()) continue;
    datasets_.push_back(group.path);
    for (const auto& kept : group.kept) datasets_.push_back(kept.path);
    is_windowed_ = is_windowed_ || group.path == "/windows/time";
  }
  std::sort(datasets_.begin(), datasets_.end());
}

void RecordedDrop::open() {
  identity_ = identity_of(file_);
  for (auto& path : list_datasets(file_)) (is_text(path) ? texts_ : datasets_).push_back(std::move(path));
  if (!has("/energy/mechanical"))
    throw InputError({directory_.string(), 0, 0}, "these are heat-only results; they contain no drop",
                     "Give the directory into which `rotordrop run` wrote.");
  case_name_ = read_attribute(file_, "/", "case");
  is_windowed_ = has("/windows/time");
}

template <class Read>
auto RecordedDrop::from_same_file(const Read& read, const std::string& dataset) const {
  auto found = read(file_, dataset);
  if (identity_of(file_) != identity_)
    throw InputError({file_.string(), 0, 0}, "this file is another one than when its drop was opened.",
                     "A later run has replaced it, or it was removed. Read the results again, or give each run a "
                     "directory of its own.");
  return found;
}

std::string RecordedDrop::driver() const { return driver_of(parameters_.thermal); }

std::vector<std::pair<std::string, TouchdownParameters>> RecordedDrop::bearings() const {
  std::vector<std::pair<std::string, TouchdownParameters>> list;
  for (const auto& entry : parameters_.bearings)
    if (const auto* b = entry.touchdown(); b && has("/bearings/" + entry.name + "/contact_force"))
      list.emplace_back(entry.name, *b);
  return list;
}

bool RecordedDrop::has(const std::string& dataset) const {
  return std::binary_search(datasets_.begin(), datasets_.end(), dataset);
}

bool RecordedDrop::has(const ThermalKind& model) const {
  return std::any_of(parameters_.bearings.begin(), parameters_.bearings.end(), [&](const SupportEntry& entry) {
    return entry.touchdown() && has(node_path(model, entry.name, "inner_ring"));
  });
}

std::vector<const ThermalKind*> RecordedDrop::models() const {
  auto kinds = thermal_kinds();
  std::erase_if(kinds, [&](const ThermalKind* kind) { return !has(*kind); });
  return kinds;
}

std::optional<std::string> RecordedDrop::text(const std::string& dataset) const {
  if (!std::binary_search(texts_.begin(), texts_.end(), dataset)) return {};
  return from_same_file(read_text, dataset);
}

std::optional<RecordedDrop::Table> RecordedDrop::table_in_memory(const std::string& dataset) const {
  for (const auto& group : memory_) {
    if (group.kept.empty()) continue;
    if (dataset == group.path) return Table{group.times, 1, {"s", "time", {}, {}}};
    for (const auto& kept : group.kept)
      if (kept.path == dataset)
        return Table{group.values(kept), kept.size, {kept.unit, kept.long_name, group.path, kept.columns}};
  }
  return {};
}

const RecordedDrop::Table& RecordedDrop::table(const std::string& dataset) const {
  const auto found = tables_.find(dataset);
  if (found != tables_.end()) return found->second;
  if (auto in_memory = table_in_memory(dataset)) return tables_[dataset] = std::move(*in_memory);
  auto [raw, meaning] = from_same_file(read_series_with_meaning, dataset);
  if (meaning.time_path.empty() && !dataset.ends_with("/time"))
    throw InputError({file_.string(), 0, 0}, dataset + " does not name its times", "Is this a drop's series?");
  const std::size_t n_columns = raw.shape.size() > 1 ? raw.shape[1] : 1;
  return tables_[dataset] = {std::move(raw.values), n_columns, std::move(meaning)};
}

SeriesMeaning RecordedDrop::meaning(const std::string& dataset) const {
  if (file_.empty() || tables_.contains(dataset)) return table(dataset).meaning;
  return from_same_file(read_meaning, dataset);
}

TimeSeries RecordedDrop::series(const std::string& dataset, std::size_t column) const {
  const Table& t = table(dataset);
  const Table& times = table(t.meaning.time_path);
  // While it is being written, or after it was killed, a series may have rows whose times are not there yet.
  const std::size_t n = std::min(times.values.size(), t.values.size() / t.n_columns);
  if (column >= t.n_columns)
    throw InputError({file_.string(), 0, 0}, fmt::format("{} has {} columns, not {}", dataset, t.n_columns, column + 1),
                     "Do these results belong to this case?");
  if (n == 0)
    throw InputError({file_.string(), 0, 0}, dataset + " has no rows yet", "Let the run continue, or run it again.");
  TimeSeries result;
  result.times.assign(times.values.begin(), times.values.begin() + static_cast<std::ptrdiff_t>(n));
  result.values.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (!(i == 0 ? std::isfinite(result.times[0]) : result.times[i] > result.times[i - 1]))
      throw InputError({file_.string(), 0, 0},
                       fmt::format("this file is damaged: {} does not rise after its row {}", t.meaning.time_path, i),
                       "A run that was interrupted can be resumed from a checkpoint; otherwise run the case again.");
    const double value = t.values[i * t.n_columns + column];
    if (!std::isfinite(value))
      throw InputError({file_.string(), 0, 0},
                       fmt::format("{} is not a number at t = {:.6g} ms", dataset, result.times[i] * 1e3),
                       "Such a run cannot be evaluated. Look at what it recorded before that time.");
    result.values.push_back(value);
  }
  return result;
}

TimeSeries RecordedDrop::growth(const std::string& dataset, std::size_t surface) const {
  const std::size_t n_columns = table(dataset).n_columns;
  if (surface < n_columns || !is_number_of_surfaces(n_columns)) return series(dataset, surface);
  TimeSeries none = series(dataset);
  std::fill(none.values.begin(), none.values.end(), 0.);
  return none;
}

std::string RecordedDrop::node_path(const ThermalKind& model, const std::string& bearing,
                                    const std::string& node) const {
  const std::string group = model.meshes_sections && is_windowed_ ? "/windows/" : model.group;
  return group + bearing + "/" + node;
}

std::string RecordedDrop::growth_path(const ThermalKind& model, const std::string& bearing) const {
  if (model.meshes_sections && is_windowed_) return "/windows/" + bearing + "/growth";
  return "/growth/" + model.name + "/" + bearing;
}

std::vector<std::string> RecordedDrop::pressure_paths(const std::string& bearing) const {
  std::vector<std::string> paths;
  for (const auto& path : datasets_)
    if (path.starts_with("/bearings/" + bearing + "/") && path.find("pressure") != std::string::npos &&
        meaning(path).unit == "Pa")
      paths.push_back(path);
  return paths;
}

}  // namespace rotordrop
