#pragma once
// Values of Python and of the program, into each other.
#include <pybind11/pybind11.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/node.h"
#include "io/text/toml_reader.h"

namespace rotordrop::python {

/// Tables become dictionaries in the same order, null becomes None.
pybind11::object to_python(const nlohmann::ordered_json& value);

/// Numbers, texts, booleans, lists, arrays of NumPy and dictionaries as values of a case. Their place is "given KEY", line 0.
/// @param key  of the value, such as "contact.air_gap"; empty for a whole case
/// @param depth  levels of lists and dictionaries above it
/// @throws InputError for anything else, and for lists and dictionaries that nest as deep as no file may
Node to_node(const pybind11::handle& value, const std::string& key, std::size_t depth = 0);

/// Dictionaries of parameters, such as {"contact.friction_coefficient": 0.05}, in the order in which they are laid over a case.
std::vector<Setting> to_settings(const std::vector<pybind11::dict>& layers);

/// How places of values that a program has given begin.
inline constexpr const char* given_mark = "given ";

}  // namespace rotordrop::python
