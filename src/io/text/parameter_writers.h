#pragma once

#include "base/node.h"
#include "base/parameters/declaration.h"

#include <functional>
#include <string>
#include <vector>

/// Three texts from the declarations of all sections. A section's name is its table; a section without a name holds the
/// top level.
namespace rotordrop {

/// A TOML file with every parameter, its sentence, unit, range and source. Keys with a default are set to it; keys
/// without one, and tables that may be absent, are comments. The text is valid TOML.
std::string write_defaults(const std::vector<ErasedSection>& sections);

/// A JSON schema (draft 2020-12) of the input files, for editors and checkers. No key is required in it: a file may
/// have a base that gives it, and [bearings] may give it for all bearings. Descriptions say which keys must come from
/// somewhere.
std::string write_json_schema(const std::vector<ErasedSection>& sections);

/// The tree as read, completed with all defaults, as TOML that reads back to the same values; "# default" marks what
/// was not given. Defaults for all bearings are written out in each. Keys that no section declares are left out.
/// @param source_of  a line of text on where a given value is from, for a comment "# from ..." behind it; none: no such comments
std::string write_resolved(const std::vector<ErasedSection>& sections, const Node& tree,
                           const std::function<std::string(const SourcePosition&)>& source_of = {});

/// A value as TOML on one line; numbers read back to the same double. Throws std::invalid_argument for null, which TOML
/// has not.
std::string toml_value(const Node& node);

}  // namespace rotordrop
