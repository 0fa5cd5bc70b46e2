#pragma once
#include <array>
#include <string>

namespace rotordrop {

/// A node of the rotor whose displacement is recorded, in a stationary part with its own radial clearance: magnet, seal, impeller.
struct Probe {
  std::string name;
  int node = 0;                    ///< of the rotor, numbered from 1
  double clearance = 0;            ///< radial [m]
  std::array<double, 2> centre{};  ///< y, z of the stationary part's axis [m]
};

}  // namespace rotordrop
