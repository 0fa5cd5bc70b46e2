#include "study/recorded_growth.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/errors.h"
#include "io/recorder.h"
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

std::shared_ptr<GrowthHistory> read_growth(const std::filesystem::path& file,
                                           const std::vector<std::string>& bearings) {
  const auto known = recorded_bearings(file);
  std::vector<double> times;
  std::vector<std::vector<double>> growth;
  for (const auto& name : bearings) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError({}, fmt::format("it has no growth of a bearing \"{}\".", name),
                       known.empty() ? "It should be the results.h5 of a drop."
                                     : fmt::format("It has those of {}.", fmt::join(known, ", ")));
    const std::string dataset = prefix + name + suffix;
    times = read_series(file, read_attribute(file, dataset, "time")).values;
    growth.push_back(read_series(file, dataset).values);
  }
  // Of a file that is being written, a series may have rows whose times are not there yet.
  std::size_t n = times.size();
  for (const auto& values : growth) n = std::min(n, values.size() / growth_surfaces.size());
  if (n == 0) throw InputError({}, "it holds no growth.", "It should be the results.h5 of a drop.");
  auto history = std::make_shared<GrowthHistory>(growth.size());
  std::vector<Expansion> row(growth.size());
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < growth.size(); ++k)
      row[k] = expansion_of(std::span(growth[k]).subspan(i * growth_surfaces.size(), growth_surfaces.size()));
    history->append(times[i], row);
  }
  return history;
}

}  // namespace

std::shared_ptr<const GrowthHistory> recorded_growth(const Case& c) {
  const auto& thermal = c.parameters.thermal;
  if (driver_of(thermal) != GrowthDriver::recorded) return nullptr;
  try {
    return read_growth(*thermal.recorded, touchdown_names(c.parameters));
  } catch (const InputError& error) {
    const Fault& fault = error.faults().front();
    throw InputError(position_of_value(*c.tree.find("thermal"), "recorded"),
                     fmt::format("thermal.recorded = \"{}\": {}", *thermal.recorded, fault.message), fault.advice);
  }
}

}  // namespace rotordrop
