#pragma once
#include <string>

#include "base/dataset_name.h"
#include "base/parameters/section.h"

namespace rotordrop {

/// Reports the name of a quantity that HDF5 does not take for a dataset. @param path  of the table that has it
inline void require_result_name(const std::string& name, const Node& table, const std::string& path, Faults& faults) {
  if (!is_dataset_name(name))
    faults.add(position_of_value(table, "name"),
               path + ".name = \"" + name + "\" is empty, only a dot, or has a slash in it.");
}

}  // namespace rotordrop
