#pragma once
#include <filesystem>

#include "base/node.h"

namespace rotordrop {

/// The geometry of a rotor: a table (.csv), TOML (.toml) or JSON. @throws InputError, also for a rotor that ROSS saved, with what makes it a case
Node read_geometry(const std::filesystem::path& file);

}  // namespace rotordrop
