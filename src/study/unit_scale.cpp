#include "study/unit_scale.h"

#include "base/units.h"

namespace rotordrop {
namespace {

/// SI units of the series that a drop has, or parts of others may give it; those of most come first, since J and N m are of one dimension.
constexpr const char* units_of_series[] = {
    "m",   "s",   "N",     "K",    "rad/s",   "rad",       "m/s",  "W",    "J",   "Pa",      "N m",      "1",
    "N s", "N/m", "N s/m", "m/s2", "rad/s2",  "1/s",       "W/m2", "W/K",  "K/W", "W/(m K)", "W/(m2 K)", "J/K",
    "kg",  "m2",  "m3",    "1/m",  "N m/rad", "N m s/rad", "m2/s", "Pa s", "K/s", "A",       "V"};

}  // namespace

std::optional<UnitScale> scale_in_si(const std::string& unit) {
  if (unit.empty() || unit == "1") return UnitScale{unit, 0., 1.};
  for (const char* si : units_of_series) {
    const auto kind = kind_of(si);
    const auto zero = convert_to_si("0 " + unit, si, kind, "unit"), one = convert_to_si("1 " + unit, si, kind, "unit");
    if (zero && one) return UnitScale{si, zero.value, one.value - zero.value};
  }
  return {};
}

}  // namespace rotordrop
