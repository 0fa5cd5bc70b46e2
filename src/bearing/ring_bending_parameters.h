#pragma once
// The keys of [bearings.NAME] that let rings bend.
#include <optional>
#include <string>

#include "bearing/touchdown_data.h"

namespace rotordrop {

void add_ring_bending_keys(Section<TouchdownParameters>& section);
void check_ring_bending(const TouchdownParameters& bearing, const Node& table, const std::string& path, Faults& faults);

/// Rings of a bearing that bend; none if they are rigid.
/// @param data  of the same bearing: rows, contact and air gap
std::optional<BentRings> bent_rings(const TouchdownParameters& bearing, const TouchdownBearingData& data,
                                    const TouchdownSurroundings& surroundings);

}  // namespace rotordrop
