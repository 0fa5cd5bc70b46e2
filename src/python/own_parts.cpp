#include "python/own_parts.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "python/values.h"

namespace rotordrop::python {
namespace py = pybind11;

bool KeyOfPart::operator==(const KeyOfPart& other) const {
  const auto text = [](const std::optional<Node>& node) { return node ? to_text(*node) : std::string(); };
  return name == other.name && unit == other.unit && fallback.has_value() == other.fallback.has_value() &&
         text(fallback) == text(other.fallback);
}

std::vector<KeyOfPart> keys_of(const py::list& parameters) {
  std::vector<KeyOfPart> keys;
  for (const auto& one : parameters) {
    const auto [name, unit, fallback, help] = one.cast<std::tuple<std::string, std::string, py::object, std::string>>();
    keys.push_back({name, unit, help, {}});
    if (!fallback.is_none()) keys.back().fallback = to_node(fallback, name);
  }
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

std::vector<double> numbers_of(const py::handle& values, std::size_t n, const std::string& what) {
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(values);
  if (!array || array.ndim() != 1) {
    PyErr_Clear();
    throw py::value_error(fmt::format("{} must return {} numbers, and returned {}", what, n,
                                      py::repr(values).cast<std::string>().substr(0, 60)));
  }
  std::vector<double> numbers(array.data(), array.data() + array.size());
  if (numbers.size() != n)
    throw py::value_error(fmt::format("{} must return {} numbers, and returned {}", what, n, numbers.size()));
  return numbers;
}

}  // namespace rotordrop::python
