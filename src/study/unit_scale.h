#pragma once
#include <optional>
#include <string>

namespace rotordrop {

/// How numbers in a unit become SI: zero + factor * number.
struct UnitScale {
  std::string unit;  ///< SI
  double zero = 0, factor = 1;
};

/// "um" is a length: tried against the units that results and series have. None if it is not a unit of theirs.
std::optional<UnitScale> scale_in_si(const std::string& unit);

}  // namespace rotordrop
