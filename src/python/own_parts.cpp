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
  auto numbers = values.cast<std::vector<double>>();
  if (numbers.size() != n)
    throw py::value_error(fmt::format("{} must return {} numbers, and returned {}", what, n, numbers.size()));
  return numbers;
}

}  // namespace rotordrop::python
