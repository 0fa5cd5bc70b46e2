#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rotordrop {

/// What a quantity means beyond its dimension; it decides which units a user may write.
enum class QuantityKind {
  plain,                  ///< anything without a special rule
  angle,                  ///< rad; "25 deg" is pi/180 rad each
  angular_speed,          ///< rad/s; "rpm" is 2 pi/60 rad/s; Hz and 1/s are refused: radians or revolutions?
  temperature,            ///< K, absolute: "20 degC" is 293.15 K
  temperature_difference  ///< K, without an offset: "5 degC" is 5 K
};

/// The kind that a declared SI unit implies: "rad" angle, "rad/s" angular_speed, "K" temperature (absolute), else
/// plain.
QuantityKind kind_of(std::string_view si_unit);

/// A value in SI, or the reason why there is none.
struct Conversion {
  double value = 0.0;
  std::string error;   ///< a sentence without a full stop; empty if the conversion succeeded
  std::string advice;  ///< may be empty

  explicit operator bool() const { return error.empty(); }
};

/// Reads "15200 rpm", "250 um", "20 degC" or "1.144e9" (a bare number is SI) into the unit that a declaration names.
///
/// Angles are a dimension of their own here: "5 rad" is no number without dimension and "30 1/s" is no angular speed.
/// A declared unit with a symbolic or non-integer exponent, such as "N/m^n", takes bare numbers only.
/// NaN and infinite values are refused, and absolute temperatures below 0 K.
///
/// @param text     number and unit as the user wrote them
/// @param si_unit  unit of the declaration, e.g. "m", "rad/s", "N", "W/(m K)", "kg m2", "1/s", "1"
/// @param name     how messages call the quantity ("air_gap needs a length such as 250 um")
Conversion convert_to_si(std::string_view text, std::string_view si_unit, QuantityKind kind,
                         std::string_view name = "this quantity");

/// As convert_to_si; throws an InputError without a source position.
double to_si(std::string_view text, std::string_view si_unit, QuantityKind kind);
double to_si(std::string_view text, std::string_view si_unit);

/// Checks a bare number in SI as convert_to_si does: finite, and not below 0 K for an absolute temperature.
Conversion checked_si(double value, QuantityKind kind, std::string_view name = "this quantity");

/// "a length such as 250 um", "an angular speed such as 15200 rpm", "a number in N/m^n such as 1e9".
std::string described(std::string_view si_unit, QuantityKind kind);

/// "length", "angular speed"; the unit itself where the dimension has no name here.
std::string dimension_name(std::string_view si_unit, QuantityKind kind);

/// "250 um": a value that a user could write for this unit.
std::string example_of(std::string_view si_unit, QuantityKind kind);

/// Whether a text can be the unit of a declaration.
bool is_unit(std::string_view si_unit);

/// True for units such as "N/m^n" that cannot be converted.
bool takes_bare_numbers_only(std::string_view si_unit);

/// The number that the whole text is, if it is one ("1.144e9"; not "5 m"). Accepts inf and nan.
std::optional<double> bare_number(std::string_view text);

/// The shortest text that reads back to the same double: "0.1", "1e-06", "1144000000".
std::string shortest(double value);

}  // namespace rotordrop
