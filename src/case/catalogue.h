#pragma once
#include <filesystem>
#include <vector>

#include "base/errors.h"
#include "base/node.h"

namespace rotordrop {

/// Folders with bearings usable by name, in the order of search: ROTORDROP_PARAMS/bearings if that is set, `bearings` beside the case,
/// the program's own params/bearings.
std::vector<std::filesystem::path> catalogue_folders(const std::filesystem::path& case_file);

/// What the layers of a case are told while they are read.
struct LayerNotes {
  Faults faults;
  std::vector<Fault> warnings;
};

/// Puts the catalogue's data under each bearing of one layer that names them, so that they go before what a base says of that bearing.
/// A bearing that the catalogue does not have is a fault; data of another one then stand for it, so that other faults are found, too.
/// What the layers below changed of another entry of the catalogue goes with it: a warning lists it.
/// @param base  what the layer will be laid over
void load_catalogue_bearings(Node& tree, const std::filesystem::path& file, const Node& base, LayerNotes& notes);

/// Gives the `catalogue` and the `count` of [bearings] to every touchdown bearing that has none of its own, and puts that entry's data under what any
/// layer says of the bearing.
/// @param tree  of all layers  @param file  the case
void load_common_catalogue(Node& tree, const std::filesystem::path& file, Faults& faults);

}  // namespace rotordrop
