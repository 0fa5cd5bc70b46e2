#include "base/parameters/usual_magnitudes.h"

#include <algorithm>
#include <iterator>
#include <numbers>
#include <utility>

namespace rotordrop {
namespace {

constexpr double day = 86400.;

/// Estimates: of a 100 t rotor with a margin; what is beyond them is a wrong unit or a typing error more often than a machine.
/// 6500 rad/s are 62 000 rpm: 15 200 rad/s are meant as rpm.
constexpr std::pair<std::string_view, double> largest[] = {
    {"m", 10.},
    {"s", 30. * day},
    {"Hz", 1e6},
    {"1/s", 1e6},
    {"rad/s", 6500.},
    {"m/s", 500.},
    {"rad", 2. * std::numbers::pi},
    {"N", 1e8},
    {"N m", 1e6},
    {"N/m", 1e13},
    {"N s/m", 1e8},
    {"kg", 1e5},
    {"kg m2", 1e5},
    {"kg m", 0.1},
    {"kg/m3", 2.3e4},
    {"Pa", 1.3e12},
    {"Pa s", 10.},
    {"m2/s", 0.01},
    {"s/m", 5.},
    {"W", 1e7},
    {"W/K", 1e5},
    {"K/W", 100.},
    {"W/(m2 K)", 1e5},
    {"J/K", 1e7},
    {"W/(m K)", 2500.},
    {"J/(kg K)", 5e3},
    {"m2/N", 1e-10},
};

}  // namespace

Range usual_magnitudes(std::string_view unit, QuantityKind kind, const Range& allowed) {
  const auto known =
      std::find_if(std::begin(largest), std::end(largest), [&](const auto& u) { return u.first == unit; });
  if (kind == QuantityKind::temperature || kind == QuantityKind::temperature_difference || known == std::end(largest))
    return any();
  const double magnitude = known->second;
  if (allowed.lower >= -magnitude && allowed.upper <= magnitude) return any();
  return allowed.lower >= 0. ? at_most(magnitude) : between(-magnitude, magnitude);
}

}  // namespace rotordrop
