#pragma once
// One engine for each level of vectors: lane_engine.cpp is compiled for all of them, and nothing but its factory leaves it.
#include <memory>
#include <span>

#include "machine/machine.h"
#include "model/lane_system.h"

namespace rotordrop {

std::unique_ptr<LaneSystem> make_lanes_base(std::span<const Machine* const> machines);
std::unique_ptr<LaneSystem> make_lanes_v3(std::span<const Machine* const> machines);
std::unique_ptr<LaneSystem> make_lanes_v4(std::span<const Machine* const> machines);
std::unique_ptr<LaneSystem> make_lanes_v4_newton(std::span<const Machine* const> machines);

}  // namespace rotordrop
