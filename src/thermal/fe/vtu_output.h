#pragma once
#include <string>

#include "thermal/fe/heat_operator.h"

namespace rotordrop {

/// A temperature field for ParaView: "temperature [K]" and "temperature rise [K]" over the initial one at the nodes, "body" by number in every cell; coordinates x, r [m].
/// @throws SolverError if the file cannot be written
void write_heat_vtu(const HeatOperator& problem, const HeatOperator::Vector& T, double time, const std::string& file);

}  // namespace rotordrop
