#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/errors.h"
#include "base/node.h"

namespace rotordrop {

/// One allowed band of a result.
struct Limit {
  std::string pattern;             ///< of a result's name, "*" stands for any text without a dot
  std::optional<double> min, max;  ///< SI
  std::string min_text, max_text;  ///< as given, resolved when the result's unit is known
  SourcePosition where;
};

/// Reads [limits]: RESULT = { max = "6 kN" }, { min = 1 } or both.
void read_limits(const Node& table, std::vector<Limit>& limits, Faults& faults);

}  // namespace rotordrop
