#pragma once

#include <string>
#include <vector>

#include "base/units.h"

namespace rotordrop {

/// Reads a list of an option, "0, 5 krpm, 10 krpm", into the unit that is named. Where some entries have a unit, those without one must be 0:
/// "5,10 krpm" would be 5 rad/s.
///
/// @param option  such as "--speeds"
/// @param name    how messages call an entry ("a speed")
/// @throws InputError with the faults of all entries
[[nodiscard]] std::vector<double> quantities_in(const std::string& text, const std::string& option,
                                                const std::string& si_unit, QuantityKind kind, const std::string& name);

/// The same list as it is probably meant: entries without a unit have that of the next entry with one, "5 krpm, 10 krpm" for "5,10 krpm"; 0 stays as it is.
[[nodiscard]] std::string list_with_units(const std::string& text);

}  // namespace rotordrop
