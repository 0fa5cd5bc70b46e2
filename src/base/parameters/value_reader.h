#pragma once

#include "base/errors.h"
#include "base/node.h"
#include "base/parameters/declaration.h"
#include "base/parameters/options.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/// Readers of single values: each returns the value in SI, or reports a fault and returns nothing. `name` is the full name for
/// messages ("run.gravity").
namespace rotordrop {

/// Reads one quantity; for custom readers.
std::optional<double> read_quantity(const Node& node, const Quantity& quantity, const std::string& name,
                                    Faults& faults);
/// Reads an array of quantities with min_count to max_count entries.
std::optional<std::vector<double>> read_quantities(const Node& node, const Quantity& quantity, std::size_t min_count,
                                                   std::size_t max_count, const std::string& name, Faults& faults);

namespace detail {
std::optional<double> read_quantity(const Node&, const Declaration&, const std::string& name, Faults&);
std::optional<int> read_integer(const Node&, const Declaration&, const std::string& name, Faults&);
std::optional<bool> read_boolean(const Node&, const std::string& name, Faults&);
std::optional<std::string> read_text(const Node&, const Declaration&, const std::string& name, Faults&);
std::optional<std::vector<double>> read_quantities(const Node&, const Declaration&, const std::string& name, Faults&);
std::optional<std::array<std::array<double, 2>, 2>> read_matrix(const Node&, const Declaration&,
                                                                const std::string& name, Faults&);
std::optional<std::vector<std::array<double, 2>>> read_function(const Node&, const Declaration&,
                                                                const std::string& name, Faults&);
}  // namespace detail

}  // namespace rotordrop
