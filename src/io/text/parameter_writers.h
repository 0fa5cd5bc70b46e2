#pragma once

#include "base/node.h"
#include "base/parameters/declaration.h"

#include <optional>
#include <string>
#include <vector>

/// Texts from the declarations of all sections. A section's name is its table; a section without a name holds the
/// top level.
namespace rotordrop {

/// A TOML file with every parameter, its sentence, unit, range and source. Keys with a default are set to it; keys
/// without one, and tables that may be absent, are comments. The text is valid TOML.
std::string write_defaults(const std::vector<ErasedSection>& sections);

/// A JSON schema (draft 2020-12) of the input files, for editors and checkers. No key is required in it: a file may
/// have a base that gives it, and [bearings] may give it for all bearings. Descriptions say which keys must come from
/// somewhere.
std::string write_json_schema(const std::vector<ErasedSection>& sections);

/// A parameter that was given, rather than left at its declared default.
struct GivenParameter {
  std::string name;  ///< "bearings.TB1.node", "rotor.unbalance[0].me"
  Node value;
  std::string origin;            ///< as of origin_text(); of a value for all bearings with "[bearings], " before it
  std::optional<Node> fallback;  ///< declared; none if it must be given or may be absent
  std::string unit, help;        ///< declared
};

/// The parameters of a case: every value, and where each that was given is from.
struct ResolvedParameters {
  /// TOML that reads back to the same values, complete with all defaults; "# from ORIGIN" marks what was given, "# default" the others.
  /// Defaults for all bearings are written out in each. Keys that no section declares are left out.
  std::string text;
  std::vector<GivenParameter> given;
  std::size_t n_defaults = 0;  ///< parameters besides these
};
ResolvedParameters resolve(const std::vector<ErasedSection>& sections, const Node& tree);
/// The text with quantities as bare numbers: the same however they were written, "3 s" or 3.
std::string resolved_in_si(const std::vector<ErasedSection>& sections, const Node& tree);

/// A value as TOML on one line; numbers read back to the same double. Throws std::invalid_argument for null, which TOML
/// has not.
std::string toml_value(const Node& node);

}  // namespace rotordrop
