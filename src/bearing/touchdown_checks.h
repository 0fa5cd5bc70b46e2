#pragma once

// Checks over several keys of a touchdown bearing.
#include <string>

#include "bearing/touchdown_parameters.h"

namespace rotordrop {

/// Whether balls, rings, housing and shoulders fit into one another.
/// @param path  name of the bearing's table, "bearings.TB1"
void check_geometry(const TouchdownParameters& bearing, const Node& table, const std::string& path, Faults& faults);

/// Checks that need both the bearing and [contact]; the tables give the places of faults.
void check_touchdown(const std::string& name, const TouchdownParameters& bearing, const ContactParameters& contact,
                     const Node& bearing_table, const Node& contact_table, Faults& faults);

}  // namespace rotordrop
