#pragma once
#include <string_view>

namespace rotordrop {

/// Whether HDF5 takes a name for a dataset in a group.
inline bool is_dataset_name(std::string_view name) {
  return !name.empty() && name != "." && name.find('/') == std::string_view::npos;
}

}  // namespace rotordrop
