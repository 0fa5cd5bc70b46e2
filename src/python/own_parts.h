#pragma once
// What supports and thermal models written in Python share.
#include <pybind11/pybind11.h>

#include <exception>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/node.h"
#include "base/parameters/section.h"
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
/// @param of     "NAME.parameters" in messages
/// @param taken  keys that every part of its kind has
/// @throws InputError for names that a case cannot have, for units that are not known, and for defaults of another dimension
std::vector<KeyOfPart> keys_of(const pybind11::list& parameters, const std::string& of,
                               const std::vector<std::string>& taken = {});

/// Declares the keys in a section; their values, in SI, go into `values` of what it reads.
/// @param prefix  of their names in messages, "thermal.wall."
template <class P>
void declare_keys(Section<P>& section, const std::vector<KeyOfPart>& keys, const std::string& prefix = "") {
  for (const KeyOfPart& key : keys)
    section.custom(
        key.name,
        {.unit = key.unit, .accepts = key.unit, .fallback = key.fallback, .required = !key.fallback, .help = key.help},
        [key, prefix](const Node& node, P& target, Faults& faults) {
          if (const auto value = read_quantity(node, {.unit = key.unit}, prefix + key.name, faults))
            target.values[key.name] = *value;
        });
}

/// Python classes by the names that cases give them. They stay for ever: cases may still ask for them when Python has ended.
struct KnownClass {
  pybind11::object* part = nullptr;
  std::vector<KeyOfPart> keys;
};
using KnownClasses = std::map<std::string, KnownClass>;
/// A notebook's cell may run again: the class takes the place of the one that is known by this name.
/// @returns false if there is none @throws ValueError if that has other keys
bool replace_class(const KnownClasses& known, const std::string& type, const std::vector<KeyOfPart>& keys,
                   const pybind11::object& part);

/// From rotordrop.State: name, unit, scale. The machine checks them (machine/others/declared_parts.h).
std::vector<StateEntry> state_entries_of(const pybind11::handle& states);
/// From rotordrop.Series: name, unit, meaning, columns. Likewise.
std::vector<Observable> observables_of(const pybind11::handle& series);

/// A copy for Python.
pybind11::object array_of(std::span<const double> values);
/// @throws ValueError: `function` must return what is expected, and returned something else
[[noreturn]] void refuse_returned(const std::string& function, const std::string& expected,
                                  const pybind11::handle& returned);
/// Numbers that a Python function has returned. @throws ValueError unless there are n real ones
std::vector<double> numbers_of(const pybind11::handle& values, std::size_t n, const std::string& function);
/// A list of times since the release [s]. @throws pybind11::value_error
std::vector<double> times_of(const pybind11::handle& values, const std::string& function);
/// Likewise one number.
double number_of(const pybind11::handle& value, const std::string& function);

/// Ctrl-C while a part written in Python was running: no fault of the part, so nothing that goes on after faults catches it.
struct Interruption {
  std::exception_ptr raised;  ///< pybind11::error_already_set
};
/// Calls a part with Python's lock.
template <class Call>
auto with_python(const Call& call) {
  const pybind11::gil_scoped_acquire lock;
  try {
    return call();
  } catch (const pybind11::error_already_set& error) {
    if (error.matches(PyExc_KeyboardInterrupt)) throw Interruption{std::current_exception()};
    throw;
  }
}

}  // namespace rotordrop::python
