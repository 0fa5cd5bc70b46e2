#pragma once
#include <string>
#include <vector>

#include "base/errors.h"
#include "base/node.h"

namespace rotordrop {

/// Whether a value is from the catalogue's file of an entry, wherever its folder is.
[[nodiscard]] bool is_from_catalogue(const Node& value, const std::string& entry);

/// Makes sets of catalogue bearings: where a bearing has a `count`, what its catalogue entry says of one bearing becomes that of all: rows, width, mass
/// and inertia of the rings and C0 that many times, C by count^0.7 (ISO 281, rows of ball bearings). What the user gave himself stays as it is.
void make_sets(Node& tree, Faults& faults);

/// A layer that names a bearing of the catalogue without saying how many there are, over a bearing of more rows: a `count` at the place of the
/// name. Angular contact stays a set of as many rows; another bearing becomes one alone. look_for_single_entries() then tells it.
/// @param bearing  of the layer, with what the catalogue has
/// @param under    what the layers below say of it
void keep_set(Node& bearing, const Node& under);

/// Sets that keep_set() made or ended, and sets by `rows` alone: a warning where the catalogue's entry has fewer rows and its width, mass, inertia or rating stand,
/// and where a set is given those of one bearing of its entry.
void look_for_single_entries(const Node& tree, std::vector<Fault>& warnings);

}  // namespace rotordrop
