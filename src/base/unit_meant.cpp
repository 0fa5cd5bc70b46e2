#include "base/unit_meant.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/trimmed.h"

namespace rotordrop {
namespace {

/// Spellings of units that are mistyped: "MM", "RPM", "Nm".
constexpr const char* usual_spellings[] = {
    "m",     "mm",    "um",    "in",   "s",      "ms",   "us",   "min",   "h",   "Hz",      "kHz",      "rpm",
    "deg",   "rad",   "N",     "kN",   "Pa",     "MPa",  "GPa",  "bar",   "kg",  "g",       "t",        "K",
    "W",     "kW",    "J",     "kJ",   "N m",    "kN m", "g mm", "kg m2", "N/m", "N/mm",    "N/um",     "kN/mm",
    "m/s",   "m2/s",  "mm2/s", "mm/s", "N s/m",  "Pa s", "degC", "degF",  "J/K", "W/(m K)", "W/(m2 K)", "J/(kg K)",
    "kg/m3", "g/cm3", "rad/s", "m/s2", "kg mm2", "GN/m", "MN/m", "kN s/m"};

/// What mistyped units have in common: letters in lower case, without spaces.
std::string letters_of(std::string_view unit) {
  std::string letters;
  for (const char c : unit)
    if (c != ' ' && c != '.' && c != '*') letters += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return letters;
}

/// "[0, -9.81, 0]" of "0,-9.81,0".
std::string list_in_brackets(std::string_view values) {
  std::string list;
  for (const char c : values)
    if (c == ',')
      list += ", ";
    else if (c != ' ' || !list.ends_with(' '))
      list += c;
  return "[" + list + "]";
}

}  // namespace

std::optional<NumberSlip> number_slip(double value, std::string_view rest) {
  constexpr std::string_view digits = "0123456789";
  if (rest.front() == ',') {
    const bool may_be_thousands = std::min(rest.find_first_not_of(digits, 1), rest.size()) == 4;  // "11,000 rpm"
    const auto next = rest.find_first_not_of(' ', 1);
    const bool may_be_list = !may_be_thousands && next != std::string_view::npos &&
                             (rest.find(',', 1) != std::string_view::npos || rest[next] == '-' || rest[next] == '+');
    return NumberSlip{"is not a number with a unit",
                      may_be_thousands
                          ? "Write thousands without a comma (11000), and a decimal point as a point (11.0)."
                      : may_be_list ? "Several values are a list in brackets, where the key takes one: " +
                                          list_in_brackets(fmt::format("{}{}", shortest(value), rest)) + "."
                                    : "Write a decimal point, not a comma."};
  }
  if (rest.front() == '/')
    if (const auto divisor = bare_number(rest.substr(1)); divisor && *divisor != 0.)
      return NumberSlip{"is a fraction", fmt::format("Write it as a decimal number: {}.", shortest(value / *divisor))};
  if (rest.front() == 'e' || rest.front() == 'E') {
    const auto first =
        std::min(rest.size(), std::size_t{rest.size() > 1 && (rest[1] == '-' || rest[1] == '+') ? 2U : 1U});
    if (const auto end = std::min(rest.find_first_not_of(digits, first), rest.size()); end > first)
      return NumberSlip{"has a space within its number",
                        fmt::format("Write it without: \"{}{}\".", shortest(value), rest)};
  }
  return std::nullopt;
}

std::string unit_meant(std::string_view given, std::string_view si_unit, QuantityKind kind) {
  const auto fits = [&](std::string_view unit) {
    return given != unit && static_cast<bool>(convert_to_si(fmt::format("1 {}", unit), si_unit, kind));
  };
  const std::string letters = letters_of(given);
  for (const char* spelling : usual_spellings)
    if (letters_of(spelling) == letters && fits(spelling)) return spelling;
  const bool is_temperature = kind == QuantityKind::temperature || kind == QuantityKind::temperature_difference;
  if (is_temperature && (given == "C" || given == "F")) return given == "C" ? "degC" : "degF";
  // "W/m2 K": all that stands behind the stroke is meant to be below it.
  const auto stroke = given.find('/');
  if (stroke == std::string_view::npos || given.find('(') != std::string_view::npos) return "";
  const std::string below = fmt::format("{}/({})", given.substr(0, stroke), trimmed(given.substr(stroke + 1)));
  return fits(below) ? below : "";
}

}  // namespace rotordrop
