#pragma once
#include <vector>

#include "model/reduced_heat.h"
#include "thermal/fe/heat_operator.h"

namespace rotordrop {

/// A problem on few modes, and the modes' fields: T = T_0 + sum_i field[i] (z_i - T_0) + sum_p residue[p] q_p.
struct Reduction {
  ReducedHeat data;
  std::vector<HeatOperator::Vector> fields;
  std::vector<HeatOperator::Vector>
      residues;  ///< of each port: what the modes leave out per watt [K/W]; none if all are kept
};

/// Projects on as few modes as the tolerance of the responses allows. They are chosen among solutions of (K + s C) v = load for s between the settings' times,
/// with the ports and the means of bodies and nodes as loads (a rational Krylov space), beside the uniform temperature of each body and node.
/// A Galerkin projection: stable, and true to energy. The error that is reported adds what few modes leave of that space's responses
/// in time (choose_modes()) and what the space leaves of the mesh's, at shifts between those that made it.
/// @throws SolverError if a property depends on temperature or a boundary is held
Reduction reduce_heat(const HeatOperator& problem, const ReductionSettings& settings);

}  // namespace rotordrop
