#include "base/parameters/other_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/units.h"

namespace rotordrop {
namespace {

const std::pair<const char*, std::vector<std::string>> known_units[] = {
    {"rad/s", {"rpm"}},        {"m", {"mm", "um"}},   {"s", {"ms", "us"}}, {"K", {"degC"}},
    {"Pa", {"MPa", "GPa"}},    {"kg m", {"g mm"}},    {"N", {"kN"}},       {"kg", {"g", "t"}},
    {"N/m", {"N/mm", "N/um"}}, {"kg m2", {"kg mm2"}}, {"m2/s", {"mm2/s"}}, {"J/(kg K)", {"kJ/(kg K)"}},
    {"rad", {"deg"}},          {"Hz", {"kHz"}},       {"Pa s", {"mPa s"}}, {"N s/m", {"N s/mm"}},
};

}  // namespace

std::vector<std::string> units_in_mind(const std::string& si_unit) {
  const auto known =
      std::find_if(std::begin(known_units), std::end(known_units), [&](const auto& u) { return si_unit == u.first; });
  return known == std::end(known_units) ? std::vector<std::string>{} : known->second;
}

std::string other_unit_meant(const Declaration& d, double value, const Range& range) {
  // What is usual, too, goes before what is only allowed.
  for (const Range& usual : {d.usual, any()})
    for (const std::string& unit : units_in_mind(d.unit)) {
      const auto same = convert_to_si(fmt::format("{} {}", shortest(value), unit), d.unit, d.quantity_kind, d.key);
      if (same && usual.contains(same.value) && range.contains(same.value) && d.range.contains(same.value))
        return fmt::format("If {} is meant, write \"{:.6g} {}\".  ", unit, value, unit);
    }
  return "";
}

}  // namespace rotordrop
