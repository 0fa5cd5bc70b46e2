#include "python/values.h"

#include <fmt/format.h>

#include "io/text/input_file.h"

namespace rotordrop::python {
namespace py = pybind11;

py::object to_python(const nlohmann::ordered_json& value) {
  using Kind = nlohmann::ordered_json::value_t;
  switch (value.type()) {
    case Kind::boolean:
      return py::bool_(value.get<bool>());
    case Kind::number_integer:
    case Kind::number_unsigned:
      return py::int_(value.get<long long>());
    case Kind::number_float:
      return py::float_(value.get<double>());
    case Kind::string:
      return py::str(value.get<std::string>());
    case Kind::array: {
      py::list list;
      for (const auto& item : value) list.append(to_python(item));
      return list;
    }
    case Kind::object: {
      py::dict dict;
      for (const auto& [key, item] : value.items()) dict[py::str(key)] = to_python(item);
      return dict;
    }
    default:
      return py::none();
  }
}

namespace {

/// @throws InputError for one that no double holds
double number_of(const py::handle& value, const SourcePosition& where) {
  const double number = PyFloat_AsDouble(value.ptr());
  if (!PyErr_Occurred()) return number;
  PyErr_Clear();
  throw InputError(where,
                   fmt::format("{} is no number that a case can hold.", std::string(py::str(py::type::of(value)))));
}

/// @throws InputError for halves of characters
std::string text_of(const py::handle& value, const SourcePosition& where) {
  Py_ssize_t size = 0;
  if (const char* text = PyUnicode_AsUTF8AndSize(value.ptr(), &size)) return {text, static_cast<std::size_t>(size)};
  PyErr_Clear();
  throw InputError(where, "this text holds halves of characters (surrogates).");
}

}  // namespace

Node to_node(const py::handle& value, const std::string& key, std::size_t depth) {
  if (depth > deepest_input)  // its key is as long
    throw InputError(
        {}, fmt::format("lists or dictionaries are nested more than {} deep, or in themselves.", deepest_input));
  const SourcePosition where{given_mark + key, 0, 0};
  if (PyBool_Check(value.ptr())) return {value.cast<bool>(), where};
  if (PyLong_Check(value.ptr())) {
    int overflow = 0;
    const auto whole = PyLong_AsLongLongAndOverflow(value.ptr(), &overflow);
    if (overflow == 0) return {std::int64_t{whole}, where};
    return {number_of(value, where), where};
  }
  if (PyFloat_Check(value.ptr())) return {value.cast<double>(), where};
  if (PyUnicode_Check(value.ptr())) {
    auto text = text_of(value, where);
    if (text.find('\0') != std::string::npos) throw InputError(where, "this text holds a NUL character.");
    return {std::move(text), where};
  }
  if (PyMapping_Check(value.ptr()) && py::hasattr(value, "items")) {
    Node table = Node::table(where);
    for (const auto& item : value.attr("items")()) {
      const auto entry = item.cast<std::pair<py::object, py::object>>();
      if (!PyUnicode_Check(entry.first.ptr()))
        throw InputError(where, fmt::format("the key {} is no text.", std::string(py::repr(entry.first))),
                         "Names of parameters are texts, such as \"contact\".");
      const auto name = entry.first.cast<std::string>();
      const std::string path = key.empty() ? name : key + "." + name;
      table.set(name, to_node(entry.second, path, depth + 1), {given_mark + path, 0, 0});
    }
    return table;
  }
  if (py::hasattr(value, "tolist")) {  // of NumPy, pandas, xarray
    const py::object plain = value.attr("tolist")();
    if (!py::type::of(plain).is(py::type::of(value))) return to_node(plain, key, depth + 1);
    return {number_of(value, where), where};  // long doubles are their own lists
  }
  if (py::isinstance<py::sequence>(value) && !PyBytes_Check(value.ptr())) {
    Node::Array items;
    for (const auto& item : value) items.push_back(to_node(item, fmt::format("{}[{}]", key, items.size()), depth + 1));
    return Node::array(std::move(items), where);
  }
  if (py::hasattr(value, "__fspath__")) return {value.attr("__fspath__")().cast<std::string>(), where};
  throw InputError(where,
                   fmt::format("a value of type {} cannot be one of a case.",
                               std::string(py::str(py::type::of(value).attr("__name__")))),
                   "Give a number (SI), a text with a unit such as \"250 um\", True or False, a list or a dictionary.");
}

std::vector<Setting> to_settings(const std::vector<py::dict>& layers) {
  std::vector<Setting> settings;
  for (const auto& overrides : layers)
    for (const auto& [key, value] : overrides) {
      if (!PyUnicode_Check(key.ptr()))
        throw InputError({}, fmt::format("the key {} of the overrides is no text.", std::string(py::repr(key))),
                         "Write {\"contact.friction_coefficient\": 0.05}.");
      const auto name = key.cast<std::string>();
      settings.push_back({name, to_node(value, name)});
    }
  return settings;
}

}  // namespace rotordrop::python
