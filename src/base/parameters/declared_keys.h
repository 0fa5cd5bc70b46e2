#pragma once
#include <string>
#include <vector>

#include "base/parameters/declaration.h"

namespace rotordrop {

/// "a key cannot be called "a.b": ...": what cases and results cannot call so. Empty: they can.
[[nodiscard]] std::string fault_of_name(const std::string& what, const std::string& name);

/// What is wrong with the keys that others declared, tables in them included: names that no case can have, the same name twice, units that are unknown,
/// texts that are no UTF-8. Empty: nothing.
/// @param taken  keys that stand beside them
[[nodiscard]] std::string fault_of_keys(const SectionDeclaration& section, const std::vector<std::string>& taken);

}  // namespace rotordrop
