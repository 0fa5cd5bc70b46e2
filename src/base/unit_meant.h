#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "base/units.h"

namespace rotordrop {

/// What a unit that does not fit is meant as: "mm" of "MM", "W/(m2 K)" of "W/m2 K", "degC" of "C"; empty if nothing is near.
/// @param si_unit  that the quantity needs
[[nodiscard]] std::string unit_meant(std::string_view given, std::string_view si_unit, QuantityKind kind);

/// What is wrong with a number that its text goes on behind, and how it is written.
struct NumberSlip {
  std::string what, advice;
};
/// Of "11,000 rpm", "1/2 mm", "1.07 e-6 kg m". @param value  of the digits before; @param rest  what follows, without blanks before it
[[nodiscard]] std::optional<NumberSlip> number_slip(double value, std::string_view rest);

}  // namespace rotordrop
