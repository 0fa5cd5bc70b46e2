#pragma once
#include <filesystem>

#include "base/node.h"

namespace rotordrop {

/// A rotor's shaft as a table of sections (CSV): the same tree as of a geometry in JSON or TOML, with the places of its values.
///
/// The first line names the columns, with units in brackets: length, outer_diameter, bore, E, nu, rho, mass, Ip, Id, name. A row is a section, from left to
/// right; node k is the left end of section k and carries the mass of its row. A last row without length carries a mass at the right end. Lines that begin
/// with # are comments.
/// @throws InputError
Node read_shaft_table(const std::filesystem::path& file);

}  // namespace rotordrop
