#include "case/built_machine.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <mutex>

#include "base/errors.h"
#include "case/modules/fe_module.h"
#include "io/hdf5/recorded_series.h"
#include "io/read_files.h"
#include "machine/build_machine.h"
#include "machine/heat/growth_history.h"

namespace rotordrop {
namespace {

const std::string prefix = "/bearings/", suffix = "/expansion";

std::vector<std::string> recorded_bearings(const std::filesystem::path& file) {
  std::vector<std::string> names;
  for (const auto& path : list_datasets(file))
    if (path.starts_with(prefix) && path.ends_with(suffix))
      names.push_back(path.substr(prefix.size(), path.size() - prefix.size() - suffix.size()));
  return names;
}

std::shared_ptr<GrowthHistory> read_growth(const std::filesystem::path& file,
                                           const std::vector<std::string>& bearings) {
  const auto known = recorded_bearings(file);
  std::vector<double> times;
  std::vector<Series> growth;
  for (const auto& name : bearings) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError({}, fmt::format("it has no growth of a bearing \"{}\".", name),
                       known.empty() ? "It should be the results.h5 of a drop."
                                     : fmt::format("It has those of {}.", fmt::join(known, ", ")));
    const std::string dataset = prefix + name + suffix;
    times = read_series(file, read_attribute(file, dataset, "time")).values;
    growth.push_back(read_series(file, dataset));
    const auto& shape = growth.back().shape;
    if (shape.size() != 2 || !is_number_of_surfaces(shape[1]))
      throw InputError(
          {},
          fmt::format("its growth of {} has {} columns instead of {}: {}.", name, shape.size() == 2 ? shape[1] : 1,
                      growth_surfaces.size(), fmt::join(growth_surface_names, ", ")),
          "It should be the results.h5 of a drop.");
  }
  // Of a file that is being written, a series may have rows whose times are not there yet.
  std::size_t n = times.size();
  for (const auto& series : growth) n = std::min(n, series.shape[0]);
  if (n == 0) throw InputError({}, "it holds no growth.", "It should be the results.h5 of a drop.");
  auto history = std::make_shared<GrowthHistory>(growth.size());
  std::vector<Expansion> row(growth.size());
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < growth.size(); ++k) {
      const std::size_t columns = growth[k].shape[1];
      row[k] = expansion_of(std::span(growth[k].values).subspan(i * columns, columns));
    }
    history->append(times[i], row);
  }
  return history;
}

/// Growth that an earlier run fed back (/bearings/NAME/expansion), if thermal.driver requires it; null otherwise. Linear between that
/// run's records; what it recorded last holds on.
std::shared_ptr<const GrowthHistory> recorded_growth(const Case& c) {
  const auto& thermal = c.parameters.thermal;
  if (driver_of(thermal) != recorded_driver) return nullptr;
  try {
    remember_read(*thermal.recorded);
    return read_growth(*thermal.recorded, touchdown_names(c.parameters));
  } catch (const InputError& error) {
    const Fault& fault = error.faults().front();
    throw InputError(position_of_value(*c.tree.find("thermal"), "recorded"),
                     fmt::format("thermal.recorded = \"{}\": {}", *thermal.recorded, fault.message), fault.advice);
  }
}

}  // namespace

BuiltMachine::BuiltMachine(const Case& c) {
  // Modes and critical speeds need none.
  if (c.parameters.bearings.empty())
    throw InputError(position_of(c.tree, "bearings"), "the case has no bearings.",
                     "Add at least one table [bearings.NAME] with type = \"touchdown\" or \"linear\".");
  std::unique_lock<std::mutex> lock(section_lock(), std::defer_lock);
  if (c.parameters.thermal.runs_sections()) lock.lock();
  elements_ = finite_elements_of(c);
  machine_ = build_machine(c.parameters, c.tree, &elements_, recorded_growth(c));
}

}  // namespace rotordrop
