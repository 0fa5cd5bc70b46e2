#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "model/ports.h"

namespace rotordrop {

/// A quantity that a part can report: becomes a dataset of the results.
struct Observable {
  std::string name;                  ///< dataset name, e.g. "contact_force"
  std::string unit;                  ///< UDUNITS text of the SI unit
  std::string long_name;             ///< what it is, in a sentence
  std::size_t size = 1;              ///< numbers per instant
  std::vector<std::string> columns;  ///< names of the columns if size > 1
};

/// Growth of the surfaces of a bearing.
[[nodiscard]] inline Observable growth_observable(const std::string& name, const std::string& long_name) {
  return {name, "m", long_name, growth_surfaces.size(), {growth_surface_names.begin(), growth_surface_names.end()}};
}

/// How many numbers a list of observables writes.
[[nodiscard]] inline std::size_t observed_size(const std::vector<Observable>& list) {
  std::size_t size = 0;
  for (const auto& o : list) size += o.size;
  return size;
}

}  // namespace rotordrop
