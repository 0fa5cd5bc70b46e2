#include "base/units.h"

#include "base/errors.h"
#include "base/trimmed.h"
#include "base/unit_meant.h"

#include <fmt/format.h>
#include <udunits2.h>

#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace rotordrop {

namespace {

// -------------------------------------------------------------------------------------------------------------
// UDUNITS-2

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using UnitHandle = std::unique_ptr<ut_unit, FreeUnit>;

/// Powers of base units, by symbol: {"kg": 1, "m": 2, "rad": -1}. The radian is a base unit here.
using Dimension = std::map<std::string, int>;

struct Unit {
  std::shared_ptr<ut_unit> handle;
  Dimension dimension;
};

/// UDUNITS keeps its state in global variables; one lock around every use.
std::recursive_mutex& udunits_lock() {
  static std::recursive_mutex lock;
  return lock;
}

ut_system* unit_system() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    ut_system* const read = ut_read_xml(nullptr);
    if (!read)
      throw std::runtime_error(
          "the unit database of UDUNITS-2 cannot be read; is the package libudunits2-data installed, and "
          "does UDUNITS2_XML_PATH, if set, name its udunits2.xml?");
    // UDUNITS knows "degree" and "°", but not the words that we use.
    const UnitHandle radian(ut_get_unit_by_name(read, "radian"));
    const UnitHandle degree(ut_scale(std::numbers::pi / 180.0, radian.get()));
    const UnitHandle revolution(ut_scale(2.0 * std::numbers::pi, radian.get()));
    ut_map_symbol_to_unit("deg", UT_ASCII, degree.get());
    ut_map_symbol_to_unit("rev", UT_ASCII, revolution.get());
    return read;
  }();
  return system;
}

/// Collects the dimension of a unit. A visitor returns the status for ut_accept_visitor to return.
struct DimensionVisitor {
  static ut_status basic(const ut_unit* unit, void* into) {
    const int power = 1;
    return product(nullptr, 1, &unit, &power, into);
  }
  static ut_status product(const ut_unit*, int count, const ut_unit* const* units, const int* powers, void* into) {
    for (int i = 0; i < count; ++i) (*static_cast<Dimension*>(into))[ut_get_symbol(units[i], UT_ASCII)] = powers[i];
    return UT_SUCCESS;
  }
  static ut_status galilean(const ut_unit*, double, const ut_unit* underlying, double, void* into) {
    return visit(underlying, into);
  }
  static ut_status timestamp(const ut_unit*, const ut_unit*, double, void*) { return UT_MEANINGLESS; }
  static ut_status logarithmic(const ut_unit*, double, const ut_unit*, void*) { return UT_MEANINGLESS; }

  static ut_status visit(const ut_unit* unit, void* into) {
    static const ut_visitor visitor{basic, product, galilean, timestamp, logarithmic};
    return ut_accept_visitor(unit, &visitor, into);
  }
};

// --------------------------------------------------------------------------------------------------- text of units,
// checked

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c & 0x80) != 0; }

enum class UnitText { sound, has_other_exponent, has_number };

/// UDUNITS silently reads "N/m^1.11" as something else and "5 10 um" as a factor: only integer exponents are let
/// through to it, and the 1 of "1/s".
UnitText check_unit_text(std::string_view text) {
  const bool has_power = text.find('^') != std::string_view::npos;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '.' && i + 1 < text.size() && is_digit(text[i + 1])) return UnitText::has_other_exponent;
    if (c == '^') {
      std::size_t next = i + 1;
      if (next < text.size() && (text[next] == '-' || text[next] == '+')) ++next;
      if (next >= text.size() || !is_digit(text[next])) return UnitText::has_other_exponent;
    }
    if (!is_digit(c) || (i > 0 && is_digit(text[i - 1]))) continue;
    std::string_view before = text.substr(0, i);
    if (before.ends_with('-') || before.ends_with('+')) before.remove_suffix(1);
    const bool is_exponent =
        before.ends_with('^') || before.ends_with("**") || (!before.empty() && is_letter(before.back()));
    const bool is_the_one_of_a_reciprocal = c == '1' && i == 0 && trimmed(text.substr(1)).starts_with('/');
    if (!is_exponent && !is_the_one_of_a_reciprocal)
      return has_power ? UnitText::has_other_exponent : UnitText::has_number;
  }
  return UnitText::sound;
}

std::optional<Unit> parsed_anew(std::string_view text) {
  const std::string terminated(text);
  Unit unit;
  unit.handle = std::shared_ptr<ut_unit>(ut_parse(unit_system(), terminated.c_str(), UT_UTF8), [](ut_unit* u) {
    if (u) ut_free(u);
  });
  if (!unit.handle || DimensionVisitor::visit(unit.handle.get(), &unit.dimension) != UT_SUCCESS) return {};
  std::erase_if(unit.dimension, [](const auto& power) { return power.second == 0; });
  return unit;
}

/// The unit of a text that check_unit_text found sound; nothing if UDUNITS does not know it, or if it is logarithmic or
/// a date. A text is parsed once.
std::optional<Unit> parsed(std::string_view text) {
  constexpr std::size_t most = 1000;  // nobody writes so many units; mutated files do
  static std::map<std::string, std::optional<Unit>, std::less<>> known;
  const std::lock_guard guard(udunits_lock());
  if (const auto found = known.find(text); found != known.end()) return found->second;
  if (known.size() >= most) known.clear();
  return known.emplace(text, parsed_anew(text)).first->second;
}

/// The unit of a declaration.
const Unit& declared(std::string_view si_unit) {
  static std::map<std::string, Unit, std::less<>> known;
  const std::lock_guard guard(udunits_lock());
  if (const auto found = known.find(si_unit); found != known.end()) return found->second;
  const bool is_sound = si_unit == "1" || check_unit_text(si_unit) == UnitText::sound;
  const auto unit = is_sound ? parsed(si_unit) : std::nullopt;
  if (!unit) throw std::logic_error(fmt::format("\"{}\" is declared as a unit, but UDUNITS does not know it", si_unit));
  return known.emplace(si_unit, *unit).first->second;
}

// names of dimensions

struct NamedDimension {
  const char* unit;
  const char* name;
  const char* example;
};

/// The first entry of a dimension names it: N m is a torque, N/m a stiffness.
constexpr NamedDimension named_dimensions[] = {
    {"1", "number without unit", "0.1"},
    {"m", "length", "250 um"},
    {"m2", "area", "20 mm2"},
    {"m3", "volume", "5 cm3"},
    {"1/m", "curvature", "20 1/m"},
    {"s", "time", "2 ms"},
    {"1/s", "rate", "30 1/s"},
    {"m/s", "speed", "0.05 m/s"},
    {"s/m", "time per length", "0.08 s/m"},
    {"m/s2", "acceleration", "9.81 m/s2"},
    {"rad", "angle", "25 deg"},
    {"rad/s", "angular speed", "15200 rpm"},
    {"rad/s2", "angular acceleration", "100 rad/s2"},
    {"kg", "mass", "85 kg"},
    {"kg/m", "mass per length", "30 kg/m"},
    {"kg/m3", "density", "7800 kg/m3"},
    {"kg m", "unbalance", "1.07 g mm"},
    {"kg m2", "moment of inertia", "3.4e-4 kg m2"},
    {"kg/s", "damping coefficient", "3.68e3 N s/m"},
    {"N", "force", "290 N"},
    {"N/m", "stiffness", "1.5 GN/m"},
    {"N m", "torque or energy", "0.5 N m"},
    {"N m/rad", "angular stiffness", "1e5 N m/rad"},
    {"N m s/rad", "angular damping coefficient", "10 N m s/rad"},
    {"N s", "impulse", "2 N s"},
    {"Pa", "pressure", "200 GPa"},
    {"1/Pa", "wear coefficient", "1e-14 m2/N"},
    {"Pa s", "dynamic viscosity", "0.01 Pa s"},
    {"m2/s", "kinematic viscosity or diffusivity", "15 mm2/s"},
    {"W", "power", "50 W"},
    {"W/m2", "heat flux", "1 kW/m2"},
    {"W/(m K)", "thermal conductivity", "70 W/(m K)"},
    {"W/(m2 K)", "heat transfer coefficient", "50 W/(m2 K)"},
    {"W/K", "thermal conductance", "200 W/K"},
    {"K/W", "thermal resistance", "0.005 K/W"},
    {"m2 K/W", "thermal resistance of an area", "1e-4 m2 K/W"},
    {"J/K", "heat capacity", "100 J/K"},
    {"J/(kg K)", "specific heat", "510 J/(kg K)"},
    {"1/K", "coefficient of expansion", "11.8e-6 1/K"},
    {"K", "temperature", "20 degC"},
    {"A", "electric current", "2 A"},
    {"A s", "electric charge", "1 C"},
    {"V", "voltage", "48 V"},
};

const NamedDimension* named(const Dimension& dimension) {
  for (const NamedDimension& candidate : named_dimensions)
    if (declared(candidate.unit).dimension == dimension) return &candidate;
  return nullptr;
}

std::string with_article(const std::string& noun) {
  return (std::string_view("aeiou").find(noun.front()) != std::string_view::npos ? "an " : "a ") + noun;
}

std::string in_base_units(const Dimension& dimension) {
  std::string result;
  for (const auto& [symbol, power] : dimension)
    result += (result.empty() ? "" : " ") + symbol + (power == 1 ? "" : std::to_string(power));
  return result;
}

// conversion

/// value times factor; 250 um is 250 / 1e6, which is nearer to 2.5e-4 than 250 * 1e-6.
double scaled(double value, double factor) {
  const double divisor = std::round(1.0 / factor);
  if (factor < 1.0 && std::abs(divisor * factor - 1.0) < 1e-14) return value / divisor;
  const double multiple = std::round(factor);
  if (factor >= 1.0 && std::abs(multiple / factor - 1.0) < 1e-14) return value * multiple;
  return value * factor;
}

/// The number at the start of a text; the text is shortened by it.
std::optional<double> take_number(std::string_view& text, std::errc& status) {
  std::string_view digits = text;
  if (digits.starts_with('+') && !digits.substr(1).starts_with('-')) digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  status = error;
  if (error == std::errc::invalid_argument) return {};
  text = digits.substr(static_cast<std::size_t>(end - digits.data()));
  return value;
}

Conversion failed(std::string error, std::string advice = "") { return {0.0, std::move(error), std::move(advice)}; }

std::string advice_on_dimension(const Unit& given, const Unit& needed, QuantityKind kind) {
  const Dimension rate{{"s", -1}};
  const Dimension angular_speed{{"rad", 1}, {"s", -1}};
  if (needed.dimension == rate && given.dimension == angular_speed)
    return "A rate is per second, without an angle: write it in 1/s.";
  if (kind == QuantityKind::temperature || kind == QuantityKind::temperature_difference)
    return "Temperatures are written in K, degC or degF.";
  if (kind == QuantityKind::angle) return "Angles are written in deg or rad.";
  return "";
}

Conversion convert_unit(double value, std::string_view unit_text, std::string_view text, std::string_view si_unit,
                        QuantityKind kind, std::string_view name) {
  const auto needs = [&] { return fmt::format("{} needs {}", name, described(si_unit, kind)); };
  if (takes_bare_numbers_only(si_unit))
    return failed(
        fmt::format("{} has a unit, but {} takes a bare number in {}", text, name, si_unit),
        fmt::format("Units with such an exponent cannot be converted. Write the value in {} without a unit.", si_unit));
  if (const auto slip = number_slip(value, unit_text))
    return failed(fmt::format("\"{}\" {}; {}", text, slip->what, needs()), slip->advice);
  switch (check_unit_text(unit_text)) {
    case UnitText::has_other_exponent:
      return failed(fmt::format("the unit of \"{}\" has an exponent that is not an integer; {}", text, needs()),
                    "Exponents of units must be integers, as in m2 or s^-1.");
    case UnitText::has_number:
      return failed(fmt::format("the unit of \"{}\" contains a number; {}", text, needs()),
                    "Write one number, then its unit.");
    case UnitText::sound:
      break;
  }
  const Unit& needed = declared(si_unit);
  const auto given = parsed(unit_text);
  const auto meant = [&] {
    const std::string unit = unit_meant(unit_text, si_unit, kind);
    return unit.empty() ? "" : fmt::format("Did you mean \"{} {}\"?  ", shortest(value), unit);
  };
  if (!given)
    return failed(fmt::format("unknown unit \"{}\" in \"{}\"; {}", unit_text, text, needs()),
                  meant() + "Units are written as in \"N m\", \"W/(m K)\" or \"kg/m3\".");

  const Dimension per_second{{"s", -1}};
  if (kind == QuantityKind::angular_speed && given->dimension == per_second)
    return failed(fmt::format("{} does not say whether it counts revolutions or radians; {}", text, needs()),
                  "Write rpm (revolutions per minute) or rad/s instead of Hz or 1/s.");
  if (given->dimension != needed.dimension) {
    const NamedDimension* dimension = named(given->dimension);
    const std::string what =
        dimension ? with_article(dimension->name) : "a value in " + in_base_units(given->dimension);
    return failed(fmt::format("{} is {}; {}", text, what, needs()),
                  meant() + advice_on_dimension(*given, needed, kind));
  }

  const std::lock_guard guard(udunits_lock());
  const std::unique_ptr<cv_converter, void (*)(cv_converter*)> converter(
      ut_get_converter(given->handle.get(), needed.handle.get()), cv_free);
  if (!converter)
    return failed(fmt::format("unit \"{}\" in \"{}\" cannot be converted to {}", unit_text, text, si_unit));
  const double offset = cv_convert_double(converter.get(), 0.0);
  // Of a scale with an offset, the step is the difference between 1 and 0, which costs digits: 100 steps cost two
  // fewer.
  const double factor = offset == 0.0 ? cv_convert_double(converter.get(), 1.0)
                                      : (cv_convert_double(converter.get(), 1e6) - offset) / 1e6;
  const double difference = scaled(value, factor);
  if (kind != QuantityKind::temperature)
    return checked_si(difference, kind, name);  // the offset of degC has no meaning here
  return checked_si(difference + offset, kind, name);
}

}  // namespace

QuantityKind kind_of(std::string_view si_unit) {
  if (si_unit == "rad") return QuantityKind::angle;
  if (si_unit == "rad/s") return QuantityKind::angular_speed;
  if (si_unit == "K") return QuantityKind::temperature;
  return QuantityKind::plain;
}

bool takes_bare_numbers_only(std::string_view si_unit) {
  return si_unit != "1" && check_unit_text(si_unit) == UnitText::has_other_exponent;
}

bool is_unit(std::string_view si_unit) {
  return si_unit == "1" || takes_bare_numbers_only(si_unit) ||
         (check_unit_text(si_unit) == UnitText::sound && parsed(si_unit));
}

std::optional<double> bare_number(std::string_view text) {
  text = trimmed(text);
  std::errc status{};
  const auto value = take_number(text, status);
  if (!value || status != std::errc{} || !text.empty()) return {};
  return value;
}

std::string shortest(double value) { return fmt::format("{}", value); }

std::string dimension_name(std::string_view si_unit, QuantityKind kind) {
  if (kind == QuantityKind::temperature_difference) return "temperature difference";
  if (takes_bare_numbers_only(si_unit)) return std::string(si_unit);
  const NamedDimension* dimension = named(declared(si_unit).dimension);
  return dimension ? dimension->name : std::string(si_unit);
}

std::string example_of(std::string_view si_unit, QuantityKind kind) {
  if (kind == QuantityKind::temperature_difference) return "5 K";
  if (takes_bare_numbers_only(si_unit)) return "1.144e9";
  const NamedDimension* dimension = named(declared(si_unit).dimension);
  return dimension ? dimension->example : fmt::format("1 {}", si_unit);
}

std::string described(std::string_view si_unit, QuantityKind kind) {
  const bool has_name = !takes_bare_numbers_only(si_unit) && named(declared(si_unit).dimension);
  const std::string noun =
      has_name ? with_article(dimension_name(si_unit, kind)) : fmt::format("a number in {}", si_unit);
  return fmt::format("{} such as {}", noun, example_of(si_unit, kind));
}

Conversion checked_si(double value, QuantityKind kind, std::string_view name) {
  if (!std::isfinite(value)) return failed(fmt::format("{} = {} is not a finite number", name, value));
  if (kind == QuantityKind::temperature && value < 0.0)
    return failed(fmt::format("{} = {} K is below absolute zero", name, shortest(value)));
  return {value, "", ""};
}

Conversion convert_to_si(std::string_view text, std::string_view si_unit, QuantityKind kind, std::string_view name) {
  text = trimmed(text);
  std::string_view rest = text;
  std::errc status{};
  const auto number = take_number(rest, status);
  if (!number)
    return failed(fmt::format("\"{}\" is not a number with a unit; {} needs {}", text, name, described(si_unit, kind)));
  if (status == std::errc::result_out_of_range)
    return failed(fmt::format("\"{}\" is too large or too small for a double; {} needs {}", text, name,
                              described(si_unit, kind)));
  if (!std::isfinite(*number)) return failed(fmt::format("{} = {} is not a finite number", name, text));
  const std::string_view unit_text = trimmed(rest);
  if (unit_text.empty()) return checked_si(*number, kind, name);
  return convert_unit(*number, unit_text, text, si_unit, kind, name);
}

double to_si(std::string_view text, std::string_view si_unit, QuantityKind kind) {
  const Conversion conversion = convert_to_si(text, si_unit, kind);
  if (!conversion) throw InputError(SourcePosition{}, conversion.error + ".", conversion.advice);
  return conversion.value;
}

double to_si(std::string_view text, std::string_view si_unit) { return to_si(text, si_unit, kind_of(si_unit)); }

}  // namespace rotordrop
