#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/parameters/declaration.h"

namespace rotordrop {

/// Whether cases and results can call something so: letters, digits, _ and -.
[[nodiscard]] bool is_plain_name(std::string_view name);

/// What is wrong with the keys that others declared, tables in them included: names that no case can have, the same name twice, units that are unknown,
/// texts that are no UTF-8. Empty: nothing.
/// @param taken  keys that stand beside them
[[nodiscard]] std::string fault_of_keys(const SectionDeclaration& section, const std::vector<std::string>& taken);

}  // namespace rotordrop
