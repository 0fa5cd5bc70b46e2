#pragma once
#include "thermal/circuit/thermal_network.h"

namespace rotordrop {

/// The part of a network that heat from one place can reach without passing through the surroundings: its nodes with their resistors, growth, and all places
/// that sit on them.
struct NetworkPart {
  ThermalNetworkData data;
  std::size_t place = 0;  ///< of the place asked for, in `data`
};
/// @throws std::invalid_argument for unknown node names
NetworkPart part_around(const ThermalNetworkData& network, std::size_t place);

/// Every way to the surroundings `factor` times as conducting.
void scale_cooling(ThermalNetworkData& network, double factor);

}  // namespace rotordrop
