#include "python/own_parts.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <set>

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

namespace {

/// As an array of NumPy; null if it is none, or one of complex numbers.
py::array real_array(const py::handle& values) {
  auto array = py::array::ensure(values);
  if (!array) PyErr_Clear();
  if (array && array.dtype().kind() == 'c') return py::reinterpret_steal<py::array>(nullptr);
  return array;
}

/// Names of what a part brings along, each once.
class Names {
 public:
  explicit Names(std::string of) : of_(std::move(of)) {}
  void add(const std::string& name) {
    if (name.empty()) throw py::value_error(of_ + ": a name is empty");
    if (!known_.insert(name).second) throw py::value_error(fmt::format("{}: \"{}\" stands twice", of_, name));
  }
  /// Of a dataset.
  void add_path(const std::string& name) {
    const std::string path = "/" + name + "/";
    for (const char* part : {"//", "/./", "/../"})
      if (!name.empty() && path.find(part) != std::string::npos)
        throw py::value_error(fmt::format(
            "{}: \"{}\" cannot be the name of a dataset: no part may be empty, \".\" or \"..\"", of_, name));
    for (const std::string& known : known_) {
      const std::string other = "/" + known + "/";
      if (path.starts_with(other) != other.starts_with(path))
        throw py::value_error(
            fmt::format("{}: \"{}\" and \"{}\" cannot both be datasets: one would lie in the other", of_, known, name));
    }
    add(name);
  }

 private:
  std::string of_;
  std::set<std::string> known_;
};

}  // namespace

std::vector<StateEntry> state_entries_of(const py::handle& states, const std::string& of) {
  std::vector<StateEntry> entries;
  Names names(of);
  for (const auto& one : states) {
    const auto [name, unit, scale] = one.cast<std::tuple<std::string, std::string, double>>();
    names.add(name);
    if (!(scale > 0. && std::isfinite(scale)))
      throw py::value_error(fmt::format("{}: the scale of \"{}\" must be larger than 0 and is {}", of, name, scale));
    entries.push_back({name, unit, scale});
  }
  return entries;
}

std::vector<Observable> observables_of(const py::handle& series, const std::string& of) {
  std::vector<Observable> list;
  Names names(of);
  for (const auto& one : series) {
    const auto [name, unit, meaning, columns] =
        one.cast<std::tuple<std::string, std::string, std::string, std::vector<std::string>>>();
    names.add_path(name);
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

std::vector<double> numbers_of(const py::handle& values, std::size_t n, const std::string& function) {
  const std::string expected = fmt::format("{} {}", n, n == 1 ? "number" : "numbers");
  const auto given = real_array(values);
  if (!given || given.ndim() != 1) refuse_returned(function, expected, values);
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(given);
  if (!array) {
    PyErr_Clear();
    refuse_returned(function, expected, values);
  }
  std::vector<double> numbers(array.data(), array.data() + array.size());
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
