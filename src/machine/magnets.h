#pragma once
#include <array>
#include <span>
#include <vector>

#include "machine/machine.h"
#include "machine/machine_parameters.h"
#include "rotor/modal_rotor.h"

namespace rotordrop {

/// Makes the case's magnets where the list of supports has a gap for them, and bends the rotor in its initial state as its weight does between them and
/// the linear supports.
/// @param line   motion of the centre of gravity on the straight line through the rings' centres: where the magnets hold the rotor
/// @param parts  with one support, or a gap, for each bearing of the case, in their order
void add_magnets(const MachineParameters& parameters, const ModalRotor& rotor, const Motion& line,
                 Machine::Parts& parts);

/// Forces with which the case's magnets hold the rotor along y and z before they let go [N], in the order of the bearings: as given, and of the others
/// what balances the weight, other forces and their moments.
struct SideForce {
  double position = 0;            ///< along the rotor [m]
  std::array<double, 2> force{};  ///< on the rotor along y, z [N]
};
[[nodiscard]] std::vector<std::array<double, 2>> magnet_holding_forces(const MachineParameters& parameters,
                                                                       const RigidBody& body,
                                                                       std::span<const SideForce> others = {});

/// Faults of magnets that need the case around them.
void check_magnets(const MachineParameters& parameters, const Node& case_node, Faults& faults);

}  // namespace rotordrop
