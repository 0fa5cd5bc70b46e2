#pragma once
// What supports and thermal models written in Python share.
#include <pybind11/pybind11.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/node.h"
#include "model/observable.h"
#include "model/state_layout.h"

namespace rotordrop::python {

/// A key of a part in a case.
struct KeyOfPart {
  std::string name, unit, help;
  std::optional<Node> fallback;  ///< none: the key must be given
  bool operator==(const KeyOfPart& other) const;
};
/// From tuples (name, unit, default or None, help).
std::vector<KeyOfPart> keys_of(const pybind11::list& parameters);

/// From rotordrop.State: name, unit, scale.
std::vector<StateEntry> state_entries_of(const pybind11::handle& states);
/// From rotordrop.Series: name, unit, meaning, columns.
std::vector<Observable> observables_of(const pybind11::handle& series);

/// A copy for Python.
pybind11::object array_of(std::span<const double> values);
/// Numbers that a Python function has returned. @throws ValueError unless there are n of them
std::vector<double> numbers_of(const pybind11::handle& values, std::size_t n, const std::string& what);

}  // namespace rotordrop::python
