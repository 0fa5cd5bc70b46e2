#pragma once

// The geometry of a rotor as a tree of values: a file of its own, or inline.
#include <string>

#include "base/errors.h"
#include "base/node.h"
#include "rotor/geometry.h"

namespace rotordrop {

/// Reads a geometry laid out as params/neisi2019-rotor.json and checks it; adds all faults. Without faults the result
/// is complete.
[[nodiscard]] RotorGeometry read_rotor_geometry(const Node& table, Faults& faults);

/// A fault if the rotor has no such node. `name` is the key's full name ("bearings.TB1.node").
void check_rotor_node(const RotorGeometry& geometry, int node, const SourcePosition& where, const std::string& name,
                      Faults& faults);

}  // namespace rotordrop
