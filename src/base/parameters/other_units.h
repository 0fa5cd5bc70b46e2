#pragma once

#include <string>
#include <vector>

#include "base/parameters/declaration.h"

namespace rotordrop {

/// Units in which people think of a quantity, beside its SI unit: a bare number is often meant in one of them.
[[nodiscard]] std::vector<std::string> units_in_mind(const std::string& si_unit);

/// 'If rpm is meant, write "9000 rpm".  ' of a bare number; empty where in no other unit it would be within a range.
[[nodiscard]] std::string other_unit_meant(const Declaration& d, double value, const Range& range);

}  // namespace rotordrop
