#pragma once
#include <vector>

#include "io/text/toml_reader.h"

namespace rotordrop {

/// Whether a setting is of one entry of a list: "rotor.unbalance[0].me".
bool names_entry(const Setting& setting);

/// Applies those settings that are of entries, in their order; one whose whole list a later setting gives is void. @throws InputError for an entry that the
/// list does not have
void set_entries(Node& tree, const std::vector<Setting>& settings);

}  // namespace rotordrop
