#include "case/recorded_growth.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/errors.h"
#include "io/hdf5/recorded_series.h"
#include "machine/build_machine.h"

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

/// Columns of results from before widths were among the surfaces: growth was radial then, so their widths' is zero.
constexpr std::size_t surfaces_without_widths = 5;
/// From before rows grew apart: all rows' raceways grew alike.
constexpr std::size_t surfaces_without_rows = 7;

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
    if (shape.size() != 2 || (shape[1] != growth_surfaces.size() && shape[1] != surfaces_without_rows &&
                              shape[1] != surfaces_without_widths))
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
      row[k] = {};
      for (std::size_t c = 0; c < columns; ++c) row[k].*growth_surfaces[c] = growth[k].values[i * columns + c];
    }
    history->append(times[i], row);
  }
  return history;
}

}  // namespace

std::shared_ptr<const GrowthHistory> recorded_growth(const Case& c) {
  const auto& thermal = c.parameters.thermal;
  if (driver_of(thermal) != recorded_driver) return nullptr;
  try {
    return read_growth(*thermal.recorded, touchdown_names(c.parameters));
  } catch (const InputError& error) {
    const Fault& fault = error.faults().front();
    throw InputError(position_of_value(*c.tree.find("thermal"), "recorded"),
                     fmt::format("thermal.recorded = \"{}\": {}", *thermal.recorded, fault.message), fault.advice);
  }
}

}  // namespace rotordrop
