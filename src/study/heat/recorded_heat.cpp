#include "study/heat/recorded_heat.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "base/errors.h"
#include "base/parameters/suggestion.h"
#include "io/hdf5/recorded_series.h"
#include "io/read_files.h"

namespace rotordrop {

std::optional<RecordedHeat> read_recorded_heat(const RecordedHeatName& wanted, const Node& table,
                                               const std::string& name, Faults& faults) {
  const std::filesystem::path file = wanted.file;
  const std::string prefix = "/ledger/", suffix = "/" + wanted.ledger, dataset = prefix + wanted.bearing + suffix;
  try {
    const auto datasets = list_datasets(file);
    if (std::find(datasets.begin(), datasets.end(), dataset) == datasets.end()) {
      std::vector<std::string> bearings;
      for (const auto& path : datasets)
        if (path.starts_with(prefix) && path.ends_with(suffix))
          bearings.push_back(path.substr(prefix.size(), path.size() - prefix.size() - suffix.size()));
      if (bearings.empty())
        faults.add(position_of_value(table, "recorded"),
                   fmt::format("{}.recorded: \"{}\" holds no {} heat of any bearing.", name, file.string(),
                               wanted.ledger.substr(0, wanted.ledger.find('_'))),
                   "It should be the results.h5 of a drop, with datasets /ledger/BEARING/rub_heat and so on.");
      else
        faults.add(position_of_value(table, "bearing"),
                   fmt::format("{}.bearing = \"{}\": no such bearing in \"{}\".", name, wanted.bearing, file.string()),
                   suggestion(wanted.bearing, bearings));
      return {};
    }
    remember_read(file);
    // Of a file that is being written, a series may have rows whose times are not there yet.
    RecordedHeat heat{read_series(file, read_attribute(file, dataset, "time")).values,
                      read_series(file, dataset).values};
    const std::size_t n = std::min(heat.times.size(), heat.joules.size());
    heat.times.resize(n);
    heat.joules.resize(n);
    if (n < 2)
      faults.add(position_of_value(table, "recorded"),
                 fmt::format("{}.recorded: {} of \"{}\" has {} rows; two at least are needed.", name, dataset,
                             file.string(), n));
    return n < 2 ? std::nullopt : std::optional(heat);
  } catch (const InputError& error) {
    for (const auto& fault : error.faults())
      faults.add(position_of_value(table, "recorded"),
                 fmt::format("{}.recorded = \"{}\": {}", name, file.string(), fault.message), fault.advice);
    return {};
  }
}

}  // namespace rotordrop
