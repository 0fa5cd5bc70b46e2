#pragma once
#include <string>

#include "io/text/parameter_writers.h"

namespace rotordrop {

/// Which parameters differ from their defaults, and where they are from: JSON with "values", each [name, value, default, origin, meaning] as
/// texts, and "n_defaults", the number of the others.
std::string given_values_json(const ResolvedParameters& parameters);

/// The digest of a resolved case, however its quantities are written, "3 s" or 3. @param text  such as parameters.toml; of no valid TOML: its own digest
std::string digest_of_parameters(const std::string& text);

/// What differs between two resolved cases, in SI, by dotted names, some of them if there are many: "limits.x.max (9000, now 5000)"; empty if
/// nothing does or one cannot be read.
std::string differing_parameters(const std::string& before, const std::string& now);

}  // namespace rotordrop
