#include "base/parameters/range.h"

#include "base/units.h"

#include <fmt/format.h>

#include <cmath>

namespace rotordrop {

bool Range::contains(double value) const {
  if (has_zero && value == 0.) return true;
  return (lower_is_open ? value > lower : value >= lower) && (upper_is_open ? value < upper : value <= upper);
}

bool Range::is_any() const { return std::isinf(lower) && std::isinf(upper); }

Range Range::without_lower() const {
  Range range = *this;
  range.lower_is_open = true;
  return range;
}

Range Range::without_upper() const {
  Range range = *this;
  range.upper_is_open = true;
  return range;
}

Range any() { return {}; }
Range positive() { return above(0.0); }
Range at_least(double a) { return {.lower = a}; }
Range above(double a) { return {.lower = a, .lower_is_open = true}; }
Range at_most(double b) { return {.upper = b}; }
Range below(double b) { return {.upper = b, .upper_is_open = true}; }
Range between(double a, double b) { return {.lower = a, .upper = b}; }
Range or_zero(Range range) {
  range.has_zero = true;
  return range;
}

std::string to_string(const Range& range, std::string_view unit) {
  if (range.has_zero) {
    Range others = range;
    others.has_zero = false;
    return "0 or " + to_string(others, unit);
  }
  const std::string unit_text = unit.empty() || unit == "1" ? "" : fmt::format(" {}", unit);
  const bool has_lower = !std::isinf(range.lower);
  const bool has_upper = !std::isinf(range.upper);
  if (has_lower && has_upper && !range.lower_is_open && !range.upper_is_open)
    return fmt::format("between {} and {}{}", shortest(range.lower), shortest(range.upper), unit_text);
  const std::string lower = fmt::format("{} {}", range.lower_is_open ? ">" : ">=", shortest(range.lower));
  const std::string upper = fmt::format("{} {}", range.upper_is_open ? "<" : "<=", shortest(range.upper));
  if (has_lower && has_upper) return fmt::format("{} and {}{}", lower, upper, unit_text);
  if (has_lower || has_upper) return (has_lower ? lower : upper) + unit_text;
  return "any value";
}

}  // namespace rotordrop
