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

/// Projects on what the ports excite: solutions of (K + s C) v = port for s between the settings' times (a rational Krylov space), of which
/// the directions of the largest Gramian are kept beside the uniform temperature of each body and node. For symmetric problems that is balanced
/// truncation, and a Galerkin projection at the same time: stable, and true to energy.
/// @throws SolverError if a property depends on temperature or a boundary is held
Reduction reduce_heat(const HeatOperator& problem, const ReductionSettings& settings);

}  // namespace rotordrop
