#include "python/own_parts.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/parameters/value_reader.h"
#include "base/units.h"
#include "python/values.h"

namespace rotordrop::python {
namespace py = pybind11;

bool KeyOfPart::operator==(const KeyOfPart& other) const {
  const auto text = [](const std::optional<Node>& node) { return node ? to_text(*node) : std::string(); };
  return name == other.name && unit == other.unit && fallback.has_value() == other.fallback.has_value() &&
         text(fallback) == text(other.fallback);
}

namespace {

void check_key(const KeyOfPart& key, const std::string& of, const std::vector<std::string>& taken, Faults& faults) {
  const bool is_name = !key.name.empty() && std::all_of(key.name.begin(), key.name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
  if (!is_name)
    faults.add({}, fmt::format("{}: a key cannot be called \"{}\".", of, key.name), "Use letters, digits, _ and -.");
  if (std::find(taken.begin(), taken.end(), key.name) != taken.end())
    faults.add({}, fmt::format("{}: the key \"{}\" is taken.", of, key.name),
               "Every table of [bearings] has it: choose another name.");
  if (!is_unit(key.unit))
    faults.add({}, fmt::format("{}: the unit \"{}\" of \"{}\" is not known.", of, key.unit, key.name),
               "Units are written as in \"N m\", \"W/(m K)\" or \"kg/m3\".");
  else if (key.fallback)
    static_cast<void>(read_quantity(*key.fallback, {.unit = key.unit}, of + "." + key.name, faults));
}

}  // namespace

std::vector<KeyOfPart> keys_of(const py::list& parameters, const std::string& of,
                               const std::vector<std::string>& taken) {
  std::vector<KeyOfPart> keys;
  Faults faults;
  for (const auto& one : parameters) {
    const auto [name, unit, fallback, help] = one.cast<std::tuple<std::string, std::string, py::object, std::string>>();
    keys.push_back({name, unit, help, {}});
    if (!fallback.is_none()) keys.back().fallback = to_node(fallback, name);
    check_key(keys.back(), of, taken, faults);
  }
  faults.throw_if_any();
  return keys;
}

bool replace_class(const KnownClasses& known, const std::string& type, const std::vector<KeyOfPart>& keys,
                   const py::object& part) {
  const auto found = known.find(type);
  if (found == known.end()) return false;
  if (found->second.keys != keys)
    throw py::value_error(
        fmt::format("the parameters of \"{}\" cannot change; start Python again, or give it another type", type));
  *found->second.part = part;
  return true;
}

namespace {

/// As an array of NumPy; null if it is none, or one of complex numbers.
py::array real_array(const py::handle& values) {
  auto array = py::array::ensure(values);
  if (!array) PyErr_Clear();
  if (array && array.dtype().kind() == 'c') return py::reinterpret_steal<py::array>(nullptr);
  return array;
}

}  // namespace

std::vector<StateEntry> state_entries_of(const py::handle& states) {
  std::vector<StateEntry> entries;
  for (const auto& one : states) {
    const auto [name, unit, scale] = one.cast<std::tuple<std::string, std::string, double>>();
    entries.push_back({name, unit, scale});
  }
  return entries;
}

std::vector<Observable> observables_of(const py::handle& series) {
  std::vector<Observable> list;
  for (const auto& one : series) {
    const auto [name, unit, meaning, columns] =
        one.cast<std::tuple<std::string, std::string, std::string, std::vector<std::string>>>();
    list.push_back({name, unit, meaning, std::max<std::size_t>(1, columns.size()), columns});
  }
  return list;
}

py::object array_of(std::span<const double> values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

void refuse_returned(const std::string& function, const std::string& expected, const py::handle& returned) {
  throw py::value_error(fmt::format("{} must return {}, and returned {}", function, expected,
                                    py::repr(returned)[py::slice(0, 60, 1)].cast<std::string>()));
}

namespace {

/// A list of real numbers. @param expected  in words
std::vector<double> list_of(const py::handle& values, const std::string& expected, const std::string& function) {
  const auto given = real_array(values);
  if (!given || given.ndim() != 1) refuse_returned(function, expected, values);
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(given);
  if (!array) {
    PyErr_Clear();
    refuse_returned(function, expected, values);
  }
  return {array.data(), array.data() + array.size()};
}

}  // namespace

std::vector<double> times_of(const py::handle& values, const std::string& function) {
  if (py::isinstance<py::sequence>(values) && py::len(values) == 0) return {};
  auto times = list_of(values, "a list of times [s]", function);
  for (const double t : times)
    if (!std::isfinite(t) || t < 0.)
      throw py::value_error(fmt::format("{} must return times of 0 s and later, and returned {}", function, t));
  return times;
}

std::vector<double> numbers_of(const py::handle& values, std::size_t n, const std::string& function) {
  const std::string expected = fmt::format("{} {}", n, n == 1 ? "number" : "numbers");
  const auto numbers = list_of(values, expected, function);
  if (numbers.size() != n)
    throw py::value_error(fmt::format("{} must return {}, and returned {}", function, expected, numbers.size()));
  return numbers;
}

double number_of(const py::handle& value, const std::string& function) {
  if (!real_array(value)) refuse_returned(function, "a number", value);
  try {
    return value.cast<double>();
  } catch (const py::cast_error&) {
    refuse_returned(function, "a number", value);
  }
}

}  // namespace rotordrop::python
