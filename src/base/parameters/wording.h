#pragma once

#include "base/errors.h"
#include "base/parameters/declaration.h"

#include <string>
#include <string_view>
#include <vector>

/// How messages and documentation describe what a key asks for.
namespace rotordrop {

/// "length, > 0 m", "integer, >= 1", "radial | equivalent": unit and range as documentation shows them.
std::string type_text(const Declaration& declaration);

namespace detail {
/// The words in quotes: `"a" | "b"` with the separator " | ".
std::string quoted(const std::vector<std::string>& words, std::string_view separator);
/// What a quantity must be: `a length such as "250 um" or a bare number in m`.
std::string needed_quantity(const Declaration&);
/// How many entries a list must have: "3", "at least 2", "any number of".
std::string count_text(const Declaration&);
/// The fault "NAME is an integer; it must be ...".
void add_type_fault(const Node&, const std::string& name, const std::string& needs, Faults&);
}  // namespace detail

}  // namespace rotordrop
