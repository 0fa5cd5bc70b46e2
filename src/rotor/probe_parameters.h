#pragma once
// rotor.probes.NAME: nodes of the rotor that have a clearance of their own.
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/parameters/section.h"
#include "rotor/geometry.h"

namespace rotordrop {

/// What happens where a probe's clearance is used up; without it the probe only watches.
struct ProbeContactParameters {
  double stiffness = 0;  ///< [N/m]
  double lambda = 0;     ///< damping [s/m]
  double friction_coefficient = 0;
  double regularisation_speed = 0;  ///< [m/s]
  std::optional<double> radius;     ///< of the rotor's surface [m]
};

/// A node and the clearance around it.
struct ProbeParameters {
  int node = 0;                    ///< numbered from 1
  double clearance = 0;            ///< radial [m]
  std::array<double, 2> centre{};  ///< of the clearance, along y and z [m]
  std::optional<ProbeContactParameters> contact;
};
using ProbeList = std::vector<std::pair<std::string, ProbeParameters>>;

[[nodiscard]] Section<ProbeParameters> probe_section();

/// Radius of the rotor's surface at a probe [m]: the contact's own, else that of the thickest element at the node.
[[nodiscard]] double probe_radius(const ProbeParameters& probe, const RotorGeometry& geometry);

/// Faults of probes that show once the geometry is known: node, name, radius.
/// @param rotor_table  the node of [rotor]
void check_probes(const ProbeList& probes, const RotorGeometry& geometry, const Node& rotor_table, Faults& faults);

}  // namespace rotordrop
