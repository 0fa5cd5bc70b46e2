#include "study/compare/comparison_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "base/quantity_list.h"
#include "base/trimmed.h"
#include "base/units.h"

namespace rotordrop {
namespace {

double positive_si(const std::string& text, const char* unit, QuantityKind kind, const std::string& option,
                   const char* name) {
  const auto value = convert_to_si(text, unit, kind, name);
  if (!value) throw InputError({option, 0, 0}, value.error, value.advice);
  if (!(value.value > 0.)) throw InputError({option, 0, 0}, fmt::format("\"{}\" must be above zero", text));
  return value.value;
}

}  // namespace

TemperatureTolerance parse_temperature_tolerance(const std::string& text) {
  const auto percent = text.find('%');
  if (percent != std::string::npos) {
    const auto value = bare_number(std::string(trimmed(std::string_view(text).substr(0, percent))));
    if (!value || !(*value > 0.) || !std::isfinite(*value) ||
        text.find_first_not_of(' ', percent + 1) != std::string::npos)
      throw InputError({"--tolerance", 0, 0}, fmt::format("\"{}\" is not a percentage above zero", text),
                       "Write \"5 %\" of the rise at the time, or \"0.5 K\".");
    return {*value / 100., true};
  }
  return {positive_si(text, "K", QuantityKind::temperature_difference, "--tolerance", "a tolerance"), false};
}

double parse_floor(const std::string& text) {
  return positive_si(text, "K", QuantityKind::temperature_difference, "--floor", "a tolerance");
}

double parse_length(const std::string& text, const std::string& option) {
  return positive_si(text, "m", QuantityKind::plain, option, "it");
}

double parse_band_length(const std::string& text, const std::string& option) {
  const double length = parse_length(text, option);
  if (length < 1e-6)
    throw InputError({option, 0, 0}, fmt::format("{} is out of range: it must be 1 um at least.", text),
                     "It is the width of the contact along the surfaces, some millimetres.");
  return length;
}

std::vector<double> parse_instants(const std::string& text) {
  const auto instants = quantities_in(text, "--times", "s", QuantityKind::plain, "a time");
  if (!std::all_of(instants.begin(), instants.end(), [](double time) { return time > 0.; }))
    throw InputError({"--times", 0, 0}, fmt::format("\"{}\": every time must be above zero", text));
  return instants;
}

}  // namespace rotordrop
