#pragma once
#include "bearing/touchdown_parameters.h"

namespace rotordrop {

/// Adds the keys of a cage, rolling or free.
void add_cage_keys(Section<TouchdownParameters>& section);

/// What a free cage is made of; none if balls roll. Takes what balls and cage have while they roll off the bearing's `ring_spin_inertia`.
/// @throws InputError if that leaves nothing for the ring
void set_free_cage(const TouchdownParameters& bearing, TouchdownBearingData& data);

}  // namespace rotordrop
