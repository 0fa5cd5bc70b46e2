#pragma once

#include <limits>
#include <string>
#include <string_view>

namespace rotordrop {

/// Allowed values, in SI.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_is_open = false;
  bool upper_is_open = false;
  bool has_zero = false;  ///< zero, too, which may lie outside

  bool contains(double value) const;
  bool is_any() const;
  /// The same range without its lower or upper end: between(0, 1).without_upper() is [0, 1).
  Range without_lower() const;
  Range without_upper() const;
};
Range any();
Range positive();                   ///< > 0
Range at_least(double a);           ///< >= a
Range above(double a);              ///< > a
Range at_most(double b);            ///< <= b
Range below(double b);              ///< < b
Range between(double a, double b);  ///< a <= . <= b
Range or_zero(Range range);         ///< 0 or in the range: what zero switches off

/// "> 0 m", "between 0 and 1", ">= 0 and < 1", "any value".
std::string to_string(const Range& range, std::string_view unit = "1");

}  // namespace rotordrop
