#pragma once
#include <memory>
#include <vector>

#include "machine/machine_parameters.h"
#include "model/probe.h"
#include "model/support.h"

namespace rotordrop {

/// The case's probes as the machine watches them.
[[nodiscard]] std::vector<Probe> probes_of(const RotorParameters& rotor);
/// Contacts of those probes that have one, with their nodes.
struct ProbeContactAtNode {
  int node = 0;
  std::unique_ptr<Support> contact;
};
[[nodiscard]] std::vector<ProbeContactAtNode> probe_contacts(const RotorParameters& rotor);

/// Largest radial displacement that the gaps of the touchdown bearings leave a straight rotor at a node [m]: for a node at x between, or outside,
/// bearings at x_1 and x_2 it is |x_2 - x| / |x_2 - x_1| of the first gap and |x - x_1| / |x_2 - x_1| of the second. The least over all pairs; the gap
/// of a single bearing; infinite without touchdown bearings. Bending, yielding rings and supports, and rings that hang in their balls add to it.
[[nodiscard]] double reachable_displacement(const MachineParameters& parameters, int node);

}  // namespace rotordrop
