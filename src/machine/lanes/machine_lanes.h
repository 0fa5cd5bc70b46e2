#pragma once
// Machines of several drops side by side in the lanes of vectors.
#include <memory>
#include <span>
#include <string>

#include "machine/machine.h"
#include "model/lane_system.h"

namespace rotordrop {

/// Why a machine does not run in lanes, in words; empty: it does. What does: a rotor in its modes without axial motion, touchdown bearings
/// that TouchdownBearing::runs_in_lanes() names, and lumped circuits.
[[nodiscard]] std::string why_not_in_lanes(const Machine& machine);

/// Whether states of one machine can be evaluated side by side. Its thermal models that follow may be of any kind: rates do not
/// depend on them, and for rows they are asked as they are.
[[nodiscard]] bool evaluates_in_lanes(const Machine& machine);

/// Whether two machines that run in lanes differ in nothing but numbers, so that they can run side by side.
[[nodiscard]] bool are_alike(const Machine& a, const Machine& b);

/// Machines side by side, compiled for this process's level of vectors; or one of them in all lanes.
/// @param machines  1 to LaneSystem::width, alike; must outlive what is returned
[[nodiscard]] std::unique_ptr<LaneSystem> make_lanes(std::span<const Machine* const> machines);

}  // namespace rotordrop
